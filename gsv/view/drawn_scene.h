// The scene of a recording, prepared for rendering. The poses of its bodies come from the
// recording's messages.
//
// Links   if a link moves relative to its body, it is a separate body in the snapshots, because
//         recordings contain the poses of links and not the positions of joints.
// Lamps   the light of robots' lamps is not in a scene, and is not rendered.
// Input   untrusted: bodies with an unknown model are left out. If a pose is missing or not finite,
//         the pose of the scene is used.
// Threads const members may run concurrently.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/messages/gsv_msgs.h"
#include "gsv/view/camera.h"
#include "gsv/world/snapshot.h"

namespace gsv::view {

// Returns the model with this identifier, or null if there is none.
using FindModel = std::function<std::shared_ptr<const model::Model>(const std::string& id)>;

// The bodies, models and lights of a recorded scene.
class DrawnScene {
 public:
  // `json` must have the form that presentation::SceneJson() writes (docs/formats/live.md).
  static base::Result<DrawnScene> Make(std::string_view json, const FindModel& find_model);

  // Returns the world at the instant of a message, which must have this scene's layout.
  std::shared_ptr<const world::Snapshot> At(const messages::gsv_msgs::Poses& poses) const;

  // Returns an object that finds bodies and cameras of the scene by name, at the instant of
  // `snapshot`, which must be a result of At(). The returned object is valid during the lifetime of
  // this object and of `snapshot`. Its default view uses the poses of the scene, so it does not move
  // with the bodies.
  SceneLookup LookupAt(const world::Snapshot& snapshot) const;

 private:
  // A sensor of the scene.
  struct Camera {
    std::string body;  // name of the body in the snapshot: the robot, or one of its links
    geometry::Pose body_from_sensor;
    double horizontal_fov = 0;  // rad; 0: the sensor is not a camera
  };
  // Reads the JSON of a scene.
  class Reader;
  DrawnScene() = default;

  std::shared_ptr<const world::Layout> layout_;
  world::State state_;                // the state with the scene's own poses
  std::vector<int> bodies_of_poses_;  // for each pose of a message: the index of its body, or -1
  std::map<std::pair<std::string, std::string>, Camera> sensors_;  // by robot and name
};

}  // namespace gsv::view
