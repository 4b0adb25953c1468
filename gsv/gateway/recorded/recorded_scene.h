// A RecordedScene provides the scenes and models that are attached to a recording.
//
// Input    untrusted attachments.
// Threads  const members may run concurrently.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/gateway/foxglove/shared_bytes.h"
#include "gsv/recording/mcap/mcap_reader.h"

namespace gsv::gateway {

// Returns the GLB file of a model by its identifier, or kNotFound. Called from any thread.
using ModelSource = std::function<base::Result<SharedBytes>(const std::string& id)>;

// The scenes and models that are attached to a recording.
class RecordedScene {
 public:
  // Reads the scenes. problems() lists the invalid scenes. `reader` must outlive this. `models`
  // provides the models that are not attached; null: no such models are available.
  explicit RecordedScene(const recording::McapReader& reader, ModelSource models = nullptr);

  const base::Problems& problems() const { return problems_; }

  // Returns the attached scene for poses with this layout_version, or else the first scene. Fails
  // with kNotFound and a sentence if the recording has no scene.
  base::Result<SharedBytes> Scene(std::uint32_t layout_version) const;

  // Returns the index of each body's pose in gsv_msgs/Poses with this layout_version, by name of
  // the body.
  const std::map<std::string, std::size_t>& BodyPoses(std::uint32_t layout_version) const;

  // Whether a body of this name is a robot or an avatar in one of the scenes.
  bool IsRobot(const std::string& name) const { return robots_.contains(name) || IsAvatar(name); }
  bool IsAvatar(const std::string& name) const { return avatars_.contains(name); }
  bool IsStation(const std::string& name) const { return stations_.contains(name); }

  // Whether one of the scenes has a body of this name that is not static.
  bool HasBody(const std::string& name) const;

  // Returns the GLB file of a model, or kNotFound.
  base::Result<SharedBytes> Model(const std::string& id) const;

 private:
  // A scene of the recording.
  struct Entry {
    SharedBytes json;                               // the scene, as in GET …/scene
    std::map<std::string, std::size_t> body_poses;  // see BodyPoses()
  };

  // Reads an attached scene.
  base::Status Add(const recording::AttachmentIndexRecord& index);
  // Adds the error to the problems, as a warning.
  void Warn(const base::Error& error);

  const recording::McapReader& reader_;
  const ModelSource model_source_;  // provides models that are not attached; may be null
  std::set<std::string> robots_, avatars_, stations_;               // names in all scenes
  std::map<std::uint32_t, Entry> scenes_;                           // scenes by layout version
  std::map<std::string, recording::AttachmentIndexRecord> models_;  // by attachment name
  base::Problems problems_;
};

}  // namespace gsv::gateway
