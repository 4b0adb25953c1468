// Makes the faults of a scenario happen, and undoes what they moved. See scenario/fault.h.
//
// Threads  "mutex" is SharedState::mutex, "world" the world's lock.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "gsv/simulation/editing/world_editor.h"
#include "gsv/simulation/faults/fault_schedule.h"
#include "gsv/simulation/robots/agent_population.h"

namespace gsv::simulation {

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

  // Needs the mutex. Fails if a fault cannot happen to who stands in the world now.
  base::Status Check() const;
  // Needs the mutex.
  FaultSchedule& schedule() { return schedule_; }
  const FaultSchedule& schedule() const { return schedule_; }

  // Needs the world; takes the mutex itself. Emits an event in either case.
  base::Status Inject(const scenario::Fault& fault);
  // Needs the world. Static bodies will start where faults found them.
  base::Status UndoMoves();

 private:
  base::Status CheckOne(const scenario::Fault& fault, const world::Layout& layout) const;
  base::Status Apply(const scenario::Fault& fault);
  base::Status FailSensor(const scenario::Fault& fault, RobotAgent& agent);
  base::Status MoveBody(const scenario::Fault& fault);
  base::Status MoveJoint(const scenario::Fault& fault);

  FaultSchedule schedule_;  // guarded by SharedState::mutex
  const std::shared_ptr<SharedState> shared_;
  EventLog& events_;
  AgentPopulation& agents_;
  SimulatedWorld& world_;
  WorldEditor& editor_;
  // Where static bodies stood that faults have moved; guarded by the world's lock.
  std::map<std::string, geometry::Pose> moved_from_;
};

}  // namespace gsv::simulation
