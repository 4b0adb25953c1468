// Adds, removes and moves the bodies of a simulated world, and sets its gravity. A failed change
// leaves the world unchanged.
//
// Threads  any, with the world's lock (world_mutex). The history of snapshots is restarted with
//          each change.
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "gsv/simulation/history/event_log.h"
#include "gsv/simulation/robots/shared_state.h"
#include "gsv/simulation/simulation.h"
#include "gsv/simulation/world/simulated_world.h"

namespace gsv::simulation {

// Changes the bodies and the gravity of a simulated world.
class WorldEditor {
 public:
  WorldEditor(SimulatedWorld& world, std::shared_ptr<SharedState> shared, EventLog& events)
      : world_(world), shared_(std::move(shared)), events_(events) {}

  // Adds all of the robots, or none of them. Chooses missing names, and moves robots out of
  // overlaps with other bodies.
  base::Status AddRobots(std::vector<RobotSpecification>& robots) GSV_REQUIRES(world_mutex);
  // Adds an object and returns its name.
  base::Result<std::string> AddObject(const ObjectSpecification& object) GSV_REQUIRES(world_mutex);
  base::Status RemoveObject(const std::string& name) GSV_REQUIRES(world_mutex);
  // Removes bodies of any kind; unknown names are ignored.
  base::Status Remove(const std::vector<std::string>& names) GSV_REQUIRES(world_mutex);
  // Moves a body that is not fixed to the world.
  base::Status Place(const std::string& name, const geometry::Pose& world_from_body, bool on_ground)
      GSV_REQUIRES(world_mutex);
  // Moves a body of any kind, by its index.
  base::Status PlaceAny(int body, const geometry::Pose& world_from_body, bool on_ground)
      GSV_REQUIRES(world_mutex);
  // Sets the gravity. The bodies do not change.
  base::Status SetGravity(const geometry::Vector3& gravity) GSV_REQUIRES(world_mutex);
  // Sets the initial poses of bodies for the next reset. Unknown names are ignored.
  base::Status SetInitialPoses(const std::map<std::string, geometry::Pose>& poses)
      GSV_REQUIRES(world_mutex);

 private:
  // Returns `pose` with the height at which the model stands on the surface below. `own` is the
  // index of the model's own body, which is ignored, or -1 if the model has no body yet.
  geometry::Pose StandingPose(const model::Model& model, geometry::Pose pose, int own = -1) const
      GSV_REQUIRES(world_mutex);
  // `placed` are the names of bodies that are new or moved. These bodies are at their initial
  // poses.
  base::Status ChangeBodies(std::vector<world::Body> bodies, const std::vector<std::string>& placed)
      GSV_REQUIRES(world_mutex);
  // Like ChangeBodies(), with another description of the world.
  base::Status ChangeWorld(std::vector<world::Body> bodies,
                           std::shared_ptr<const model::WorldDescription> description,
                           const std::vector<std::string>& placed) GSV_REQUIRES(world_mutex);
  // Passes the changed world to the sensors.
  void TakeChange(const std::vector<std::string>& placed) GSV_REQUIRES(world_mutex);
  // Moves new or moved bodies out of overlaps with other bodies. Emits an event for each robot
  // whose pose this changes.
  base::Status Resolve(const world::Layout& layout, const std::vector<std::string>& placed,
                       world::State& state) GSV_REQUIRES(world_mutex);
  // Returns the index of the body, or an error with the reason why it cannot be moved.
  base::Result<int> FindMovable(const std::string& name) const GSV_REQUIRES(world_mutex);
  // Returns the body that an object specification describes.
  base::Result<world::Body> BodyOf(const ObjectSpecification& object) const
      GSV_REQUIRES(world_mutex);
  // Returns the requested name of an object, or a free one. Fails if the name is taken.
  base::Result<std::string> NameOf(const ObjectSpecification& object,
                                   const model::Model& model) const GSV_REQUIRES(world_mutex);

  SimulatedWorld& world_;
  const std::shared_ptr<SharedState> shared_;  // state shared by the parts of the simulation
  EventLog& events_;
  // Objects that were removed, ordered from the oldest to the newest. Copies of them can be added.
  std::deque<world::Body> removed_ GSV_GUARDED_BY(world_mutex);
};

}  // namespace gsv::simulation
