#include "gsv/gateway/recorded/recorded_scene.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include "gsv/recording/attachments/scene_attachments.h"

namespace gsv::gateway {
namespace {

using Json = nlohmann::json;

constexpr std::uint64_t kMaxSceneBytes = std::uint64_t{64} << 20;
constexpr std::uint64_t kMaxModelBytes = std::uint64_t{1} << 30;

std::string_view TextOf(const recording::Bytes& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

const Json& MemberOf(const Json& object, const char* name) {
  static const Json kNull;
  const auto found = object.is_object() ? object.find(name) : object.end();
  return object.is_object() && found != object.end() ? *found : kNull;
}

// Adds the names of the bodies that have this flag.
void AddBodiesOf(const Json& scene, const char* flag, std::set<std::string>& names) {
  const Json& bodies = MemberOf(scene, "bodies");
  if (!bodies.is_array()) return;
  for (const Json& body : bodies) {
    const Json& name = MemberOf(body, "name");
    if (MemberOf(body, flag) == true && name.is_string()) names.insert(name.get<std::string>());
  }
}

// Returns the index of each body's pose in the list "poses", by name of the body. The list also has
// the poses of links, which are left out.
std::map<std::string, std::size_t> BodyPosesOf(const Json& scene) {
  std::map<std::string, std::size_t> places;
  const Json& bodies = MemberOf(scene, "bodies");
  const Json& poses = MemberOf(scene, "poses");
  if (!bodies.is_array() || !poses.is_array()) return places;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Json& body = MemberOf(poses[i], "body");
    if (!body.is_number_unsigned() || body.get<std::uint64_t>() >= bodies.size()) continue;
    const Json& name = MemberOf(bodies[body.get<std::size_t>()], "name");
    if (name.is_string() && MemberOf(poses[i], "link").is_null())
      places[name.get<std::string>()] = i;
  }
  return places;
}

}  // namespace

RecordedScene::RecordedScene(const recording::McapReader& reader, ModelSource models)
    : reader_(reader), model_source_(std::move(models)) {
  for (const recording::AttachmentIndexRecord& index : reader.summary().attachments) {
    if (index.name != recording::kSceneAttachment) {
      models_[index.name] = index;
    } else if (const base::Status added = Add(index); !added) {
      Warn(added.error());
    }
  }
  if (scenes_.empty()) Warn(Scene(0).error());
}

base::Status RecordedScene::Add(const recording::AttachmentIndexRecord& index) {
  if (index.data_size > kMaxSceneBytes) {
    return base::Fail(
        base::ErrorCode::kCorrupt,
        "the scene is larger than the limit of " + std::to_string(kMaxSceneBytes) + " bytes",
        index.name);
  }
  const auto attachment = reader_.Read(index);
  if (!attachment) return base::Fail(attachment.error());
  const std::string_view text = TextOf(attachment->data);
  const Json scene = Json::parse(text, nullptr, false);
  const Json& version = MemberOf(scene, "layout_version");
  if (!version.is_number_unsigned()) {
    return base::Fail(base::ErrorCode::kCorrupt,
                      "this attachment is not a scene: layout_version is missing", index.name);
  }
  AddBodiesOf(scene, "is_robot", robots_);
  AddBodiesOf(scene, "is_avatar", avatars_);
  AddBodiesOf(scene, "is_station", stations_);
  scenes_[version.get<std::uint32_t>()] = {SharedBytes(std::string(text)), BodyPosesOf(scene)};
  return {};
}

void RecordedScene::Warn(const base::Error& error) {
  problems_.push_back({base::Problem::Severity::kWarning, error.message, error.where});
}

base::Result<SharedBytes> RecordedScene::Scene(std::uint32_t layout_version) const {
  if (scenes_.empty()) {
    return base::Fail(base::ErrorCode::kNotFound,
                      "the recording has no scene (attachment scene.json), so the 3D view is "
                      "empty; its messages can be shown");
  }
  const auto found = scenes_.find(layout_version);
  return found == scenes_.end() ? scenes_.begin()->second.json : found->second.json;
}

const std::map<std::string, std::size_t>& RecordedScene::BodyPoses(
    std::uint32_t layout_version) const {
  static const std::map<std::string, std::size_t> kNone;
  const auto found = scenes_.find(layout_version);
  return found == scenes_.end() ? kNone : found->second.body_poses;
}

bool RecordedScene::HasBody(const std::string& name) const {
  return std::any_of(scenes_.begin(), scenes_.end(),
                     [&](const auto& scene) { return scene.second.body_poses.contains(name); });
}

base::Result<SharedBytes> RecordedScene::Model(const std::string& id) const {
  const auto found = models_.find(recording::ModelAttachment(id));
  if (found == models_.end()) {
    if (model_source_) return model_source_(id);
    return base::Fail(base::ErrorCode::kNotFound,
                      "the recording has no model '" + id.substr(0, 64) + "'");
  }
  if (found->second.data_size > kMaxModelBytes) {
    return base::Fail(
        base::ErrorCode::kCorrupt,
        "the model is larger than the limit of " + std::to_string(kMaxModelBytes) + " bytes", id);
  }
  auto attachment = reader_.Read(found->second);
  if (!attachment) return base::Fail(attachment.error());
  return SharedBytes(std::move(attachment->data));
}

}  // namespace gsv::gateway
