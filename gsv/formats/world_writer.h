// Writes a changed world as SDFormat.
//
// The result is the text of the world's own file, with the present models and poses. So the result
// keeps parts that GSV does not simulate, such as plugins of Gazebo. An unchanged model keeps its
// element. A moved model gets an absolute <pose>. A removed model loses its element. An added model
// becomes an <include> of its file, or an inline <model> if it is a shape (sdf/shape_model.h) or
// was copied from an inline model.
//
// The text may be saved in any folder. So file names that are relative to the world's folder are
// replaced: by model://NAME/REST if the file is in a folder of the model path, else by file:// and
// the absolute path. One warning counts the absolute paths in the text, and gives one of them.
//
// Frames  If ModelLibrary::ReadWorld() reads the text, the models have exactly the poses that were
//         written if roll, pitch and yaw can express these poses. This is so for all poses that
//         users set. Other poses are equal up to rounding.
// Errors  kBadModel if the file of the world cannot be read any more. Models that cannot be written
//         are left out, each with a problem.
#pragma once

#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/formats/sdf/read_options.h"
#include "gsv/model/world_description.h"

namespace gsv::formats {

// Returns the text. `original` is the world as ReadWorld() returned it. `models` are all models
// that are in the world now.
base::Result<std::string> WriteWorld(const model::WorldDescription& original,
                                     const std::vector<model::PlacedModel>& models,
                                     const geometry::Vector3& gravity, const ReadOptions& options,
                                     base::Problems& problems);

}  // namespace gsv::formats
