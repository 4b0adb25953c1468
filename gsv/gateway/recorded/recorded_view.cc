#include "gsv/gateway/recorded/recorded_view.h"

#include <algorithm>
#include <utility>

#include "gsv/base/log.h"
#include "gsv/base/sorting.h"
#include "gsv/formats/gltf/glb_reader.h"
#include "gsv/presentation/topics.h"

namespace gsv::gateway {

using messages::gsv_msgs::Poses;

base::Result<RecordedView::Instant> RecordedView::At(base::SimTime time) {
  const auto& channels = reader_.summary().channels;
  const auto found = std::find_if(channels.begin(), channels.end(), [](const auto& each) {
    return each.second.topic == presentation::topics::kPoses.name;
  });
  if (found == channels.end()) {
    return base::Fail(base::ErrorCode::kNotFound,
                      "the recording has no poses (topic /gsv/poses), so the world cannot be "
                      "drawn; record this topic too");
  }
  const Poses* const poses = NewestAt(time, found->first);
  return At(poses != nullptr ? *poses : Poses());
}

base::Result<RecordedView::Instant> RecordedView::At(const Poses& poses) {
  auto drawn = scenes_.find(poses.layout_version);
  if (drawn == scenes_.end()) {
    const auto json = scene_.Scene(poses.layout_version);
    if (!json) {
      return base::Fail(base::ErrorCode::kNotFound,
                        "the recording has no scene (attachment scene.json), so the world cannot "
                        "be drawn");
    }
    auto made = view::DrawnScene::Make(json->view(),
                                       [this](const std::string& id) { return FindModel(id); });
    if (!made) return base::Fail(made.error());
    drawn = scenes_.emplace(poses.layout_version, *std::move(made)).first;
  }
  return Instant{drawn->second.At(poses), &drawn->second};
}

const Poses* RecordedView::NewestAt(base::SimTime time, std::uint16_t channel) {
  std::vector<const recording::MessageBlock*> blocks;
  for (const recording::MessageBlock& block : reader_.summary().blocks) {
    const bool may_hold =
        block.channels.empty() ||
        std::find(block.channels.begin(), block.channels.end(), channel) != block.channels.end();
    if (may_hold && block.start <= time) blocks.push_back(&block);
  }
  // The search begins with the block that ends last, and takes the newest pose in the first block
  // that has one. This is the newest pose of all, unless blocks overlap in time, which is rare.
  base::Sort(blocks, [](const auto* a, const auto* b) { return a->end > b->end; });
  for (const recording::MessageBlock* block : blocks) {
    if (block != loaded_) Load(*block, channel);
    const auto after = std::upper_bound(poses_.begin(), poses_.end(), time,
                                        [](auto t, const Timed& each) { return t < each.time; });
    if (after != poses_.begin()) return &std::prev(after)->poses;
  }
  return nullptr;
}

void RecordedView::Load(const recording::MessageBlock& block, std::uint16_t channel) {
  poses_.clear();
  loaded_ = &block;
  const auto content = reader_.Messages(block);
  if (!content) {
    spdlog::warn("{}", content.error().Sentence());
    return;
  }
  for (const recording::MessageRecord& message : content->messages) {
    if (message.channel_id != channel) continue;
    auto poses = messages::Decode<Poses>(message.data);
    if (poses) poses_.push_back({message.log_time, *std::move(poses)});
  }
  base::Sort(poses_, [](const Timed& a, const Timed& b) { return a.time < b.time; });
}

std::shared_ptr<const model::Model> RecordedView::FindModel(const std::string& id) {
  const auto [it, is_new] = models_.try_emplace(id);
  if (!is_new) return it->second;
  const auto glb = scene_.Model(id);
  const auto bytes = glb ? glb->view() : std::string_view();
  auto model =
      formats::ReadGlb({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, id);
  if (model) {
    it->second = std::make_shared<const model::Model>(*std::move(model));
  } else {
    spdlog::warn("a body is not drawn: {}", (glb ? model.error() : glb.error()).Sentence());
  }
  return it->second;
}

}  // namespace gsv::gateway
