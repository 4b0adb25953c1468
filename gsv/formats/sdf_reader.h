// Reads worlds and robots: SDFormat 1.3 to 1.12, URDF.
//
// A ModelLibrary reads each model file once and hands out the same Model ever after; meshes and
// textures are shared between all models of one library.
//
// Frames   model::Model keeps every link in the model's frame; nested models are flattened to
//          "inner::link". Ground Plane and Sun are built in and need no file.
// Drives   come from plugin elements, see sdf_drive.h; that of a URDF without any is guessed from
//          its wheels, see model/drive_guess.h.
// Errors   kBadModel with one sentence when nothing usable could be read: no such file, malformed
//          XML, no world or model inside, includes that go round, a file too large. Everything
//          else is appended to `problems`: a warning for what can be lived with (a missing mesh, a
//          model on the web, a sensor of a type nobody knows, an element that is unknown or not
//          carried out), an error for what makes the
//          simulation unfaithful (a negative mass, an axis of length zero, inverted limits, a
//          sensor whose parameters are refused).
// Threads  all members may be called concurrently; one file is read at a time.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "gsv/base/error.h"
#include "gsv/formats/sdf/read_options.h"
#include "gsv/model/world_description.h"

namespace gsv::formats {

class ModelLibrary {
 public:
  explicit ModelLibrary(ReadOptions options = {});
  ~ModelLibrary();
  ModelLibrary(const ModelLibrary&) = delete;
  ModelLibrary& operator=(const ModelLibrary&) = delete;

  // `path` is a world file, or the file or folder of a model to be used as an environment: then the
  // world holds that model, a sun, and a ground plane unless the model has a plane to collide with.
  base::Result<model::WorldDescription> ReadWorld(const std::filesystem::path& path,
                                                  base::Problems& problems);

  // A model's file (SDFormat or URDF), its folder, or its name, which is looked for as model://NAME
  // from `named_in` (a file, or the current folder).
  base::Result<std::shared_ptr<const model::Model>> ReadModel(
      const std::string& name_or_path, base::Problems& problems,
      const std::filesystem::path& named_in = {});

 private:
  class Reader;
  std::unique_ptr<Reader> reader_;
};

}  // namespace gsv::formats
