// A RecordedView reconstructs the world at any instant of a recording, ready to render.
//
// Input    untrusted attachments and messages.
// Errors   kNotFound with a sentence if the recording has no scene or no poses.
// Threads  one thread at a time.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/gateway/recorded/recorded_scene.h"
#include "gsv/messages/gsv_msgs.h"
#include "gsv/recording/mcap/mcap_reader.h"
#include "gsv/view/drawn_scene.h"

namespace gsv::gateway {

// Reconstructs the world at any instant of a recording.
class RecordedView {
 public:
  // The world at one instant.
  struct Instant {
    std::shared_ptr<const world::Snapshot> snapshot;
    const view::DrawnScene* scene = nullptr;  // valid during the lifetime of the RecordedView
  };

  // `reader` and `scene` must outlive this.
  RecordedView(const recording::McapReader& reader, const RecordedScene& scene)
      : reader_(reader), scene_(scene) {}

  // Returns the world with the newest poses that are not after `time`. Before the first recorded
  // poses, it has the poses of the scene.
  base::Result<Instant> At(base::SimTime time);
  // Returns the world at the instant of a message.
  base::Result<Instant> At(const messages::gsv_msgs::Poses& poses);

 private:
  // A recorded message of poses, and its time.
  struct Timed {
    base::SimTime time{};
    messages::gsv_msgs::Poses poses;
  };
  // Returns the newest message of the channel that is not after `time`, or null.
  const messages::gsv_msgs::Poses* NewestAt(base::SimTime time, std::uint16_t channel);
  // Reads the poses of a block into poses_.
  void Load(const recording::MessageBlock& block, std::uint16_t channel);
  // Returns the model with this identifier, or null.
  std::shared_ptr<const model::Model> FindModel(const std::string& id);

  const recording::McapReader& reader_;
  const RecordedScene& scene_;
  std::map<std::uint32_t, view::DrawnScene> scenes_;                   // scenes by layout version
  std::map<std::string, std::shared_ptr<const model::Model>> models_;  // by identifier
  const recording::MessageBlock* loaded_ = nullptr;  // the block that contains the poses below
  std::vector<Timed> poses_;                         // by time
};

}  // namespace gsv::gateway
