// Reads worlds and robots: SDFormat 1.3 to 1.12, URDF.
//
// A ModelLibrary reads each model file once and returns the same Model for every later request. All
// models of one library share meshes and textures.
//
// Frames   model::Model has every link in the model's frame; nested models are flattened to
//          "inner::link". Ground Plane and Sun are built in and need no file.
// Drives   come from plugin elements, see sdf_drive.h. The drive of a URDF without such elements is
//          guessed from its wheels, see model/drive_guess.h.
// Errors   kBadModel with one sentence if nothing could be read: no such file, malformed XML, no
//          world or model inside, cyclic includes, a file too large. All other problems are
//          appended to `problems`. A problem is a warning if the simulation is useful without the
//          part (a missing mesh, a model on the web, a sensor of unknown type, an element that is
//          unknown or not supported). It is an error if it makes the simulation unfaithful (a
//          negative mass, an axis of length zero, inverted limits, invalid parameters of a
//          sensor).
// Threads  all members may be called concurrently; one file is read at a time.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/formats/sdf/named_pose.h"
#include "gsv/formats/sdf/read_options.h"
#include "gsv/model/world_description.h"

namespace gsv::formats {

// Reads worlds and models from files.
class ModelLibrary {
 public:
  explicit ModelLibrary(ReadOptions options = {});
  ~ModelLibrary();
  ModelLibrary(const ModelLibrary&) = delete;
  ModelLibrary& operator=(const ModelLibrary&) = delete;

  // Reads a world. `path` is a world file, or the file or folder of a model. For a model, makes a
  // world with the model and a sun. This world also has a ground plane, unless the model has a
  // plane as collision shape.
  base::Result<model::WorldDescription> ReadWorld(const std::filesystem::path& path,
                                                  base::Problems& problems);

  // Reads the <frame> elements of a world from its file again, with their poses at the start. A
  // world that was made for a single model has none.
  base::Result<std::vector<NamedPose>> ReadNamedPoses(const model::WorldDescription& world);

  // Reads a model by its file (SDFormat or URDF), its folder, or its name. A name is found as
  // model://NAME from `named_in` (a file; default: the current folder). A name "shape:…" is a box,
  // a wall, a cylinder or a sphere, see sdf/shape_model.h.
  base::Result<std::shared_ptr<const model::Model>> ReadModel(
      const std::string& name_or_path, base::Problems& problems,
      const std::filesystem::path& named_in = {});

 private:
  class Reader;
  std::unique_ptr<Reader> reader_;
};

}  // namespace gsv::formats
