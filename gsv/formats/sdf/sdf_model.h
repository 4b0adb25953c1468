// Converts models from libsdformat.
#pragma once

#include <map>
#include <memory>
#include <string>

#include <sdf/Model.hh>

#include "gsv/formats/sdf/reading_context.h"
#include "gsv/model/model.h"

namespace gsv::formats {

// A model, and the frames in it to which other elements may refer: links, joints, frames, nested
// models.
struct FramedModel {
  std::shared_ptr<const model::Model> model;
  std::map<std::string, geometry::Pose> model_from_frame;  // by the frame's name
  std::string placement_frame;  // the frame in the file by which the model is placed, or empty
};

// Converts a model. Fails if the model has no link, or a link with non-finite values. Appends all
// other problems to the problems of the context. Model::default_pose includes the placement frame.
base::Result<FramedModel> ReadModel(const sdf::Model& source, const ReadingContext& context);

}  // namespace gsv::formats
