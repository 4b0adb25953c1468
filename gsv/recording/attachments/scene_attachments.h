// What a replay needs to show a recording without the original files: the scene as JSON, and each
// model that stands in it as a GLB file.
//
// Attachments  `scene.json`, again whenever bodies or sensors change: of those with the same
//              layout_version the last one counts. `models/ID.glb`, ID as the scene gives it.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>

#include "gsv/recording/mcap/mcap_writer.h"
#include "gsv/recording/topics/simulation_feed.h"
#include "gsv/sensing/registry.h"

namespace gsv::recording {

inline constexpr std::string_view kSceneAttachment = "scene.json";
inline std::string ModelAttachment(const std::string& id) { return "models/" + id + ".glb"; }

using WriteGlb = std::function<base::Result<std::vector<std::uint8_t>>(const model::Model& model)>;

class SceneAttachments {
 public:
  // `writer` must outlive this.
  SceneAttachments(McapWriter& writer, std::shared_ptr<const sensing::SensorRegistry> types,
                   WriteGlb write_glb);

  // Attaches the scene if it differs from the last, and the models that are new. A model that
  // cannot be written is left out, and logged.
  void Attach(const world::Snapshot& snapshot, const SensorLists& sensors);

 private:
  std::string Identify(const std::shared_ptr<const model::Model>& model);
  // Of what it collides with; empty: nothing.
  std::string IdentifyCollisions(const std::shared_ptr<const model::Model>& model);
  void AttachModel(const model::Model& model, const std::string& id, base::SimTime time);

  McapWriter& writer_;
  const std::shared_ptr<const sensing::SensorRegistry> types_;
  const WriteGlb write_glb_;
  std::map<std::shared_ptr<const model::Model>, std::string> identities_, collisions_;
  std::set<std::string> attached_;               // models, by identity
  std::shared_ptr<const world::Layout> layout_;  // of the last scene
  std::set<std::string> sensors_;                // of the last scene
};

}  // namespace gsv::recording
