// Applies the faults of a scenario, and undoes their moves. See scenario/fault.h.
//
// Threads  any, with SharedState::mutex (simulation_mutex) and the world's lock (world_mutex) as
//          declared.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "gsv/simulation/editing/world_editor.h"
#include "gsv/simulation/faults/fault_schedule.h"
#include "gsv/simulation/robots/agent_population.h"

namespace gsv::simulation {

// Applies the faults of a scenario during a run.
class FaultInjector {
 public:
  FaultInjector(std::vector<scenario::Fault> faults, std::shared_ptr<SharedState> shared,
                EventLog& events, AgentPopulation& agents, SimulatedWorld& world,
                WorldEditor& editor)
      : schedule_(std::move(faults)),
        shared_(std::move(shared)),
        events_(events),
        agents_(agents),
        world_(world),
        editor_(editor) {}

  // Fails if a fault names a body or joint that does not exist, or if its robot or behaviour is
  // missing. Sensors are not checked, because a behaviour may create them later.
  base::Status Check() const GSV_REQUIRES(simulation_mutex);
  FaultSchedule& schedule() GSV_REQUIRES(simulation_mutex) { return schedule_; }
  const FaultSchedule& schedule() const GSV_REQUIRES(simulation_mutex) { return schedule_; }

  // Applies a fault. Emits an event even if the fault cannot be applied.
  base::Status Inject(const scenario::Fault& fault) GSV_REQUIRES(world_mutex)
      GSV_EXCLUDES(simulation_mutex);
  // Sets the initial poses of static bodies back to their poses before the faults. The next reset
  // of the world moves the bodies there.
  base::Status UndoMoves() GSV_REQUIRES(world_mutex);

 private:
  // Checks one fault, see Check().
  base::Status CheckOne(const scenario::Fault& fault, const world::Layout& layout) const
      GSV_REQUIRES(simulation_mutex);
  // Apply() applies a fault of any kind. The other functions apply one kind each. If the fault
  // cannot be applied, they return the reason.
  base::Status Apply(const scenario::Fault& fault) GSV_REQUIRES(world_mutex);
  // Applies kSensorSilent or kSensorError.
  base::Status FailSensor(const scenario::Fault& fault, RobotAgent& agent);
  base::Status MoveBody(const scenario::Fault& fault) GSV_REQUIRES(world_mutex);
  base::Status MoveJoint(const scenario::Fault& fault) GSV_REQUIRES(world_mutex);

  FaultSchedule schedule_ GSV_GUARDED_BY(simulation_mutex);
  const std::shared_ptr<SharedState> shared_;  // state shared by the parts of the simulation
  EventLog& events_;
  AgentPopulation& agents_;
  SimulatedWorld& world_;
  WorldEditor& editor_;
  // The poses that static bodies had before faults moved them.
  std::map<std::string, geometry::Pose> moved_from_ GSV_GUARDED_BY(world_mutex);
};

}  // namespace gsv::simulation
