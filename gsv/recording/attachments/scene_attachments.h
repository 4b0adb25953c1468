// Attaches the scene (bodies, sensors and models) to a recording as JSON, and each model as a GLB
// file. A replay then needs no other files.
//
// Attachments  `scene.json`, written at each change of the layout or the sensors. If several scenes
//              have the same layout_version, the last one is valid. `models/ID.glb` with the ID
//              that the scene uses.
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

// Writes a model as a GLB file. Returns the bytes of the file.
using WriteGlb = std::function<base::Result<std::vector<std::uint8_t>>(const model::Model& model)>;

// Attaches the scene and its models to one recording.
class SceneAttachments {
 public:
  // `writer` must outlive this object. If `write_glb` is empty, no models are attached.
  SceneAttachments(McapWriter& writer, std::shared_ptr<const sensing::SensorRegistry> types,
                   WriteGlb write_glb);

  // Attaches new models, and the scene if it differs from the last one. A model that cannot be
  // written is logged and skipped.
  void Attach(const world::Snapshot& snapshot, const SensorLists& sensors);

 private:
  std::string Identify(const std::shared_ptr<const model::Model>& model);
  // Returns the identifier of the model's collision shapes, or an empty text if it has none.
  std::string IdentifyCollisions(const std::shared_ptr<const model::Model>& model);
  void AttachModel(const model::Model& model, const std::string& id, base::SimTime time);

  McapWriter& writer_;
  const std::shared_ptr<const sensing::SensorRegistry> types_;
  const WriteGlb write_glb_;
  // Identifiers of models, and of their collision shapes, by model.
  std::map<std::shared_ptr<const model::Model>, std::string> identities_, collisions_;
  std::set<std::string> attached_;               // identifiers of the attached models
  std::shared_ptr<const world::Layout> layout_;  // layout of the last attached scene
  std::set<std::string> sensors_;                // sensors of the last attached scene
};

}  // namespace gsv::recording
