// From libsdformat's Model to ours.
#pragma once

#include <map>
#include <memory>
#include <string>

#include <sdf/Model.hh>

#include "gsv/formats/sdf/reading_context.h"
#include "gsv/model/model.h"

namespace gsv::formats {

// A model and the frames in it that others may refer to: links, joints, frames, nested models.
struct FramedModel {
  std::shared_ptr<const model::Model> model;
  std::map<std::string, geometry::Pose> model_from_frame;
};

// Fails when the model has no link, or one that is not finite; what else is wrong is appended to
// the context's problems. Model::default_pose counts the placement frame in.
base::Result<FramedModel> ReadModel(const sdf::Model& source, const ReadingContext& context);

}  // namespace gsv::formats
