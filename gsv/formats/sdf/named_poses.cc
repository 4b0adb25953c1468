#include "gsv/formats/sdf/named_poses.h"

#include <string>

#include "gsv/formats/sdf/world_frames.h"

namespace gsv::formats {

std::vector<NamedPose> NamedPosesIn(const tinyxml2::XMLElement& element,
                                    const model::WorldDescription& world) {
  WorldFrames frames;
  for (const model::PlacedModel& model : world.models) {
    frames.Add(model.name, {model.world_from_model, {}});
  }
  std::vector<std::string> names;
  for (const auto* frame = element.FirstChildElement("frame"); frame != nullptr;
       frame = frame->NextSiblingElement("frame")) {
    const char* const name = frame->Attribute("name");
    const auto at = ReadFramePose(*frame);
    if (name == nullptr || !at) continue;
    frames.Add(name, *at);
    names.emplace_back(name);
  }
  std::vector<NamedPose> poses;
  for (std::string& name : names) {
    if (const auto pose = frames.WorldFrom(name)) poses.push_back({std::move(name), *pose});
  }
  return poses;
}

}  // namespace gsv::formats
