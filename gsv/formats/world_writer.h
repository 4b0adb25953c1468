// Writes a changed world as SDFormat.
//
// The result is the text of the world's own file, with the present models and poses. So the result
// keeps parts that GSV does not simulate, such as plugins of Gazebo. An unchanged model keeps its
// element. A moved model gets an absolute <pose>. A removed model loses its element. An added model
// becomes an <include> of its file, or an inline <model> if it is a shape (sdf/shape_model.h) or
// was copied from an inline model. Some files are found only beside the world's file. Their names
// become model://NAME/REST if the model path has the files, else absolute paths, so that the text
// may be saved in any folder. A warning names an absolute path.
//
// Frames  ModelLibrary::ReadWorld() reads equal poses if roll, pitch and yaw can express them, as
//         for all poses that users set. Other poses are equal up to rounding.
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
