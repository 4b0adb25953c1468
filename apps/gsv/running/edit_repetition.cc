#include "apps/gsv/running/edit_repetition.h"

#include <fmt/format.h>

#include "apps/gsv/process/exit_code.h"
#include "apps/gsv/running/run_population.h"
#include "apps/gsv/simulations/population.h"
#include "gsv/messages/cdr.h"
#include "gsv/messages/time.h"
#include "gsv/presentation/edit_message.h"
#include "gsv/presentation/topics.h"
#include "gsv/simulation/commands/argument_reader.h"
#include "gsv/simulation/commands/command_table.h"

namespace gsv::app {
namespace {

using simulation::Edit;
using simulation::Phase;
using simulation::Simulation;

base::Failure<base::Error> NotAgain(const std::string& file, const std::string& reason) {
  return base::Fail(base::ErrorCode::kInvalidArgument,
                    "cannot be simulated again: " + reason + "; replay it instead", file);
}

std::string AtInstant(base::SimTime time) {
  return fmt::format("at {:.3f} s", base::ToSeconds(time));
}

// Returns whether the event reports an edit. A recording of an older version has such events, but
// not the edits themselves, so its edits cannot be repeated.
bool IsEdit(const std::string& event) {
  return event == "body_placed" || event == "robot_removed" || event == "robot_added" ||
         event == "avatar_added";
}

bool IsInterruption(const std::string& event) {
  return event == "paused" || event == "resumed" || event == "factor_set";
}

class EditMaker {
 public:
  EditMaker(Runtime& runtime, Simulation& simulation, const RunOptions& options)
      : runtime_(runtime), simulation_(simulation), options_(options) {}

  base::Status Make(const Edit& edit) {
    switch (edit.kind) {
      case Edit::Kind::kAddRobot:
      case Edit::Kind::kAddAvatar:
        return AddRobot(edit);
      case Edit::Kind::kAddObject:
        return AddObject(edit);
      case Edit::Kind::kRemove:
        return IsRobot(edit.body) ? simulation_.RemoveRobot(edit.body)
                                  : simulation_.RemoveObject(edit.body);
      case Edit::Kind::kPlace:
        return simulation_.PlaceBody(edit.body, edit.world_from_body, edit.on_ground);
      case Edit::Kind::kCommand:
        return Apply(edit);
    }
    return {};
  }

 private:
  bool IsRobot(const std::string& name) const {
    const auto snapshot = simulation_.snapshot();
    const int body = snapshot->layout->Find(name);
    return body >= 0 && snapshot->layout->bodies[static_cast<std::size_t>(body)].is_robot();
  }

  base::Status Apply(const Edit& edit) {
    const simulation::Command* const command = simulation::FindCommand(edit.command);
    if (command == nullptr) {
      return base::Fail(base::ErrorCode::kNotFound, "there is no such command", edit.command);
    }
    const auto arguments = ReadArguments(*command, edit.arguments);
    return arguments ? command->apply(simulation_, *arguments)
                     : base::Status(base::Fail(arguments.error()));
  }

  base::Result<std::shared_ptr<const model::Model>> ReadModel(const std::string& model) {
    base::Problems problems;  // these were reported when the robot was first added
    return runtime_.host().library().ReadModel(model, problems,
                                               simulation_.specification().world->source);
  }

  // Returns the model of an added robot. If the recorded edit added a robot of the world again,
  // this is the model from the world. Otherwise, the model is read from its file.
  base::Result<std::shared_ptr<const model::Model>> ReadRobot(const Edit& edit) {
    const auto own = ModelInWorld(simulation_, edit.body);
    const bool is_own =
        own != nullptr && edit.model == (own->source.empty() ? own->name : own->source);
    if (is_own) return own;
    return ReadModel(edit.model);
  }

  base::Status AddRobot(const Edit& edit) {
    auto model = ReadRobot(edit);
    if (!model) return base::Fail(model.error());
    const scenario::RobotEntry entry{.name = edit.body, .behaviour = edit.behaviour};
    auto behaviour = LateBehaviour(runtime_, options_, entry, edit.time);
    if (!behaviour) return base::Fail(behaviour.error());
    simulation::RobotSpecification robot;
    robot.name = edit.body;
    robot.model = *std::move(model);
    robot.world_from_robot = edit.world_from_body;
    robot.on_ground = edit.on_ground;
    robot.behaviour = *behaviour;
    robot.is_avatar = edit.kind == Edit::Kind::kAddAvatar;
    robot.movement = edit.movement;
    robot.drive = edit.drive;
    const auto added = simulation_.AddRobot(std::move(robot));
    if (added) return {};
    if (*behaviour != nullptr) (*behaviour)->Destroy();
    return base::Fail(added.error());
  }

  base::Status AddObject(const Edit& edit) {
    std::shared_ptr<const model::Model> own;
    if (edit.copy_of.empty()) {
      auto model = ReadModel(edit.model);
      if (!model) return base::Fail(model.error());
      own = *std::move(model);
    }
    const auto added = simulation_.AddObject({.name = edit.body,
                                              .model = std::move(own),
                                              .copy_of = edit.copy_of,
                                              .world_from_object = edit.world_from_body,
                                              .on_ground = edit.on_ground});
    return added ? base::Status() : base::Fail(added.error());
  }

  Runtime& runtime_;
  Simulation& simulation_;
  const RunOptions& options_;
};

// Waits until the simulation neither starts nor runs. Returns false if a signal ended the wait.
bool AwaitHalt(Simulation& simulation, Signals& signals) {
  for (;;) {
    const Phase phase = simulation.WaitForPhase({Phase::kPaused, Phase::kFinished, Phase::kFailed},
                                                std::chrono::milliseconds(50));
    if (phase != Phase::kStarting && phase != Phase::kRunning) return true;
    if (signals.WaitFor(0) != 0) return false;
  }
}

// Runs the simulation to the instant of the edit and pauses there.
base::Status GoTo(const Edit& edit, Simulation& simulation) {
  const simulation::SimulationStatus status = simulation.status();
  if (edit.moment == Edit::Moment::kAfterTurns) return simulation.RunThrough(edit.time);
  return edit.time > status.time ? simulation.RunUntil(edit.time) : base::Status();
}

bool IsOfOneHalt(const Edit& a, const Edit& b) {
  return a.time == b.time && a.moment == b.moment && a.halt == b.halt;
}

bool IsOver(const Simulation& simulation) {
  const Phase phase = simulation.status().phase;
  return phase != Phase::kCreated && phase != Phase::kPaused;
}

}  // namespace

base::Result<RecordedUserActions> ReadUserActions(const recording::McapReader& reader,
                                                  const std::string& file, bool by_commands) {
  using messages::gsv_msgs::LifecycleEvent;
  const recording::Summary& summary = reader.summary();
  RecordedUserActions actions;
  std::vector<LifecycleEvent> told;  // the events that describe edits
  bool has_finished = false;
  recording::MessageCursor cursor = reader.Messages();
  for (;;) {
    const auto record = cursor.Next();
    if (!record) return base::Fail(record.error());
    if (!*record) break;
    const auto channel = summary.channels.find((*record)->channel_id);
    if (channel == summary.channels.end()) continue;
    if (channel->second.topic == presentation::topics::kEdits.name) {
      const auto message = messages::Decode<messages::gsv_msgs::Edit>((*record)->data);
      if (!message) return base::Fail(message.error());
      auto edit = presentation::EditFrom(*message);
      if (!edit) return base::Fail(edit.error());
      actions.edits.push_back(*std::move(edit));
    } else if (channel->second.topic == presentation::topics::kEvents.name) {
      auto message = messages::Decode<LifecycleEvent>((*record)->data);
      if (!message) return base::Fail(message.error());
      actions.was_interrupted = actions.was_interrupted || IsInterruption(message->event);
      has_finished = has_finished || message->event == "finished";
      actions.has_verdicts = actions.has_verdicts || message->event.starts_with("expectation_");
      if (IsEdit(message->event)) told.push_back(*std::move(message));
    }
  }
  actions.was_interrupted = actions.was_interrupted || !has_finished;
  if (actions.edits.empty() && !told.empty()) {
    return NotAgain(file, "a viewer edited the world (" + told[0].event + " " + told[0].robot +
                              " " + AtInstant(messages::ToSimTime(told[0].stamp)) +
                              "), and this recording does not contain the edits");
  }
  for (const Edit& edit : actions.edits) {
    if (by_commands || edit.moment != Edit::Moment::kAmidTurns) continue;
    return NotAgain(file, "\"" + (edit.body.empty() ? edit.command : edit.body) + "\" was edited " +
                              AtInstant(edit.time) +
                              " while behaviours ran, so it is unknown which of them ran before "
                              "the edit. Use --commands to repeat their recorded commands");
  }
  return actions;
}

base::Result<int> RunWithEdits(Runtime& runtime, Simulation& simulation, const RunOptions& options,
                               Signals& signals) {
  EditMaker maker(runtime, simulation, options);
  const Edit* last = nullptr;
  for (const Edit& edit : options.edits) {
    if (edit.time >= options.specification.duration) break;
    const auto cannot = [&](const base::Error& error) {
      (void)simulation.Stop();
      return base::Fail(error.code, "the edit " + AtInstant(edit.time) +
                                        " cannot be repeated: " + error.Sentence());
    };
    if (last == nullptr || !IsOfOneHalt(*last, edit)) {
      if (auto ok = GoTo(edit, simulation); !ok) return cannot(ok.error());
    }
    last = &edit;
    if (!AwaitHalt(simulation, signals)) {
      (void)simulation.Stop();
      return kInterrupted;
    }
    if (IsOver(simulation)) return kOk;
    if (auto ok = maker.Make(edit); !ok) return cannot(ok.error());
  }
  const bool has_begun = simulation.status().phase != Phase::kCreated;
  if (auto ok = has_begun ? simulation.Resume() : simulation.Start(); !ok) {
    return base::Fail(ok.error());
  }
  return kOk;
}

}  // namespace gsv::app
