// A ModelStore reads model files and caches them, so that each file is read once.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "gsv/base/error.h"
#include "gsv/formats/files/resource_finder.h"
#include "gsv/formats/meshes/mesh_reader.h"
#include "gsv/formats/sdf/included_files.h"
#include "gsv/formats/sdf/reading_context.h"
#include "gsv/formats/sdf/sdf_model.h"
#include "gsv/formats/sdf/sdf_xml.h"
#include "gsv/model/world_description.h"

namespace gsv::formats {

// The content of an included file: a model, or a single light.
struct StoredFile {
  FramedModel framed;  // its model is null if the file contains a light
  std::optional<model::Light> light;
  geometry::Pose world_from_light;  // pose of the light in the file
  base::Problems problems;          // problems that were found while the file was read
  base::Problems broken_rules;      // see ReadOptions::check_rules
};

// Reads model files, each once.
class ModelStore {
 public:
  explicit ModelStore(const ReadOptions& options)
      : finder_(options.model_path, options.allow_absolute_paths),
        limits_(options.limits),
        check_rules_(options.check_rules),
        check_sensor_(options.check_sensor),
        textures_(limits_),
        meshes_(limits_, textures_) {}

  // Reads a file. `plugins` is the text of <plugin> elements that an <include> adds to the model.
  base::Result<std::shared_ptr<const StoredFile>> Read(const std::filesystem::path& file,
                                                       const std::string& plugins = {});

  // Reads a model from XML that was parsed already, and caches it. `problems` are the problems
  // found so far.
  base::Result<std::shared_ptr<const StoredFile>> Take(XmlFile xml, base::Problems problems);

  // Returns and clears the problems of the last file that Read() or Take() refused. They contain
  // the reasons for the refusal.
  base::Problems TakeProblemsOfRefused() { return std::exchange(problems_of_refused_, {}); }

  bool checks_rules() const { return check_rules_; }
  const ResourceFinder& finder() const { return finder_; }
  const ReadLimits& limits() const { return limits_; }
  ReadingContext ContextFor(const std::filesystem::path& file, base::Problems& problems) {
    return {finder_, limits_, textures_, meshes_, problems, check_sensor_, file};
  }

 private:
  // Reads the model of a file.
  base::Status ReadUncached(XmlFile& xml, const std::string& plugins, StoredFile& stored);
  // Returns the stored file. If it was not read before, calls `read` and stores the result.
  base::Result<std::shared_ptr<const StoredFile>> ReadOnce(
      const std::filesystem::path& file, const std::string& plugins,
      const std::function<base::Status(StoredFile&)>& read);
  // Adds the parts that libsdformat does not read: <mimic>, <ros2_control>, and the guessed drive
  // of a robot description.
  static void Complete(const tinyxml2::XMLElement& element, const std::filesystem::path& file,
                       bool is_robot, StoredFile& stored);
  // Reads the model or light in a text with libsdformat.
  base::Status FromText(const SdfText& text, const IncludedFiles& includes, StoredFile& stored);

  ResourceFinder finder_;
  ReadLimits limits_;
  bool check_rules_;
  SensorCheck check_sensor_;
  TextureReader textures_;
  MeshReader meshes_;
  base::Problems problems_of_refused_;  // see TakeProblemsOfRefused()
  // The files that were read, by path and `plugins`.
  std::map<std::pair<std::filesystem::path, std::string>, std::shared_ptr<const StoredFile>> files_;
  // The files of files_ by their paths as given to Read(), so that each path is resolved once.
  std::map<std::pair<std::string, std::string>, std::shared_ptr<const StoredFile>> by_name_;
};

}  // namespace gsv::formats
