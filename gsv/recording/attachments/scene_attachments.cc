#include "gsv/recording/attachments/scene_attachments.h"

#include <utility>

#include "gsv/base/log.h"
#include "gsv/presentation/model_identity.h"
#include "gsv/presentation/scene_json.h"
#include "gsv/presentation/state_messages.h"

namespace gsv::recording {
namespace {

// Returns a text for each sensor in the scene: its name, its type and its link. If these texts
// change, a new scene must be attached.
std::set<std::string> Names(const SensorLists& lists) {
  std::set<std::string> names;
  for (const auto& [robot, list] : lists) {
    for (const model::SensorDescription& sensor : list) {
      names.insert(presentation::FrameOf(robot, sensor.name) + " " + sensor.type + " " +
                   std::to_string(sensor.link));
    }
  }
  return names;
}

}  // namespace

SceneAttachments::SceneAttachments(McapWriter& writer,
                                   std::shared_ptr<const sensing::SensorRegistry> types,
                                   WriteGlb write_glb)
    : writer_(writer), types_(std::move(types)), write_glb_(std::move(write_glb)) {}

void SceneAttachments::Attach(const world::Snapshot& snapshot, const SensorLists& sensors) {
  std::set<std::string> names = Names(sensors);
  if (snapshot.layout == layout_ && names == sensors_) return;
  layout_ = snapshot.layout;
  sensors_ = std::move(names);
  const auto sensors_of = [&](const std::string& robot) {
    const auto found = sensors.find(robot);
    return found == sensors.end() ? std::vector<model::SensorDescription>() : found->second;
  };
  const auto identify = [this](const std::shared_ptr<const model::Model>& model) {
    return Identify(model);
  };
  const auto identify_collisions = [this](const std::shared_ptr<const model::Model>& model) {
    return IdentifyCollisions(model);
  };
  const std::string scene =
      presentation::SceneJson({snapshot, *types_, sensors_of, identify, identify_collisions});
  const base::SimTime time = snapshot.state.time;
  writer_.Attach({time,
                  {},
                  std::string(kSceneAttachment),
                  "application/json",
                  std::as_bytes(std::span(scene))});
  for (const world::Body& body : layout_->bodies) {
    const std::string id = Identify(body.model);
    if (attached_.insert(id).second) AttachModel(*body.model, id, time);
    const std::string collisions = IdentifyCollisions(body.model);
    if (!collisions.empty() && attached_.insert(collisions).second) {
      AttachModel(presentation::CollisionModel(*body.model), collisions, time);
    }
  }
}

std::string SceneAttachments::Identify(const std::shared_ptr<const model::Model>& model) {
  std::string& id = identities_[model];
  if (id.empty()) id = presentation::ModelIdentity(*model);
  return id;
}

std::string SceneAttachments::IdentifyCollisions(const std::shared_ptr<const model::Model>& model) {
  if (!presentation::HasCollisions(*model)) return {};
  std::string& id = collisions_[model];
  if (id.empty()) id = presentation::ModelIdentity(presentation::CollisionModel(*model));
  return id;
}

void SceneAttachments::AttachModel(const model::Model& model, const std::string& id,
                                   base::SimTime time) {
  if (!write_glb_) return;
  const auto glb = write_glb_(model);
  if (!glb) {
    spdlog::warn("the recording will not contain the model {}: {}", model.name,
                 glb.error().Sentence());
    return;
  }
  writer_.Attach(
      {time, {}, ModelAttachment(id), "model/gltf-binary", std::as_bytes(std::span(*glb))});
}

}  // namespace gsv::recording
