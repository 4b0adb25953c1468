#include "gsv/simulation/robots/agent_population.h"

#include <algorithm>
#include <cstdio>
#include <utility>

#include "gsv/world/station.h"

namespace gsv::simulation {

namespace {

// Removes the name of the called process from an error sentence. The sentence is recorded, and
// equal runs must have equal recordings.
std::string WithoutProcess(std::string sentence, const BehaviourPort& behaviour) {
  const std::string process = " on " + behaviour.place();
  if (const auto at = sentence.find(process); at != std::string::npos) {
    sentence.erase(at, process.size());
  }
  return sentence;
}

}  // namespace

void AgentPopulation::Add(const std::string& name, std::shared_ptr<const model::Model> model,
                          bool is_avatar, std::shared_ptr<BehaviourPort> behaviour) {
  const auto agent = std::make_shared<RobotAgent>(name, std::move(model), is_avatar, shared_);
  SetBehaviour(*agent, std::move(behaviour));
  agent->StartDevices();
  agents_.emplace(name, agent);
}

void AgentPopulation::SetBehaviour(RobotAgent& agent, std::shared_ptr<BehaviourPort> behaviour) {
  if (behaviour != nullptr && behaviour->local() != nullptr) has_hosted_ = true;
  agent.SetBehaviour(std::move(behaviour));
}

void AgentPopulation::Remove(const std::string& name) {
  const auto it = agents_.find(name);
  if (it == agents_.end()) return;
  RobotAgent* const agent = it->second.get();
  agent->MarkRemoved();
  shared_->sleepers.Remove(agent);
  shared_->turn_sleepers.Remove(agent);
  std::erase(shared_->commanded, agent);
  std::erase_if(shared_->drives, [&](const auto& drive) { return drive.agent == agent; });
  std::erase(shared_->ready, agent);
  std::erase(shared_->due, agent);
  if (const auto& behaviour = agent->behaviour(); behaviour != nullptr) {
    caller_.Post(name, [behaviour] {
      (void)behaviour->Stop();
      behaviour->Destroy();
    });
  }
  agents_.erase(it);
}

void AgentPopulation::AssignBodies(const world::Layout& layout) {
  for (const auto& [name, agent] : agents_) agent->SetBody(layout.Find(name));
}

AgentPopulation::AgentPtr AgentPopulation::Find(const std::string& name) const {
  const auto it = agents_.find(name);
  return it == agents_.end() ? nullptr : it->second;
}

std::vector<AgentPopulation::AgentPtr> AgentPopulation::WithBehaviour() const {
  std::vector<AgentPtr> agents;
  for (const auto& [name, agent] : agents_) {
    if (agent->behaviour() != nullptr) agents.push_back(agent);
  }
  return agents;
}

void AgentPopulation::CallAll(const char* what, base::Status (BehaviourPort::*call)()) {
  for (const AgentPtr& agent : WithBehaviour()) {
    caller_.Post(agent->robot(), [this, agent, behaviour = agent->behaviour(), what, call] {
      // If the call fails, the simulation is paused or resumed nevertheless. So the error is only
      // recorded as an event.
      if (const auto status = (behaviour.get()->*call)(); !status) {
        events_.Emit(
            "behaviour_silent", agent->robot(),
            std::string(what) + ": " + WithoutProcess(status.error().Sentence(), *behaviour));
      }
    });
  }
}

void AgentPopulation::End(std::string reason, bool is_stuck) {
  shared_->end_reason = std::move(reason);
  shared_->channels.CloseAll();
  for (const auto& [name, agent] : agents_) agent->wait_event()->Open();
  for (const AgentPtr& agent : WithBehaviour()) {
    // If a behaviour does not return from its turn, its Stop() would not return either.
    if (is_stuck && agent->in_turn_since()) continue;
    caller_.Post(agent->robot(), [behaviour = agent->behaviour()] { (void)behaviour->Stop(); });
  }
}

void AgentPopulation::DestroyBehaviours() {
  for (const AgentPtr& agent : WithBehaviour()) {
    caller_.Post(agent->robot(), [behaviour = agent->behaviour()] { behaviour->Destroy(); });
  }
}

void AgentPopulation::Reset() {
  shared_->sleepers.Clear();
  shared_->turn_sleepers.Clear();
  shared_->commanded.clear();
  shared_->drives.clear();
  shared_->given_up.clear();
  shared_->ready.clear();
  shared_->due.clear();
  shared_->end_reason.clear();
  for (const auto& [name, agent] : agents_) {
    agent->ResetClocks();
    agent->rack().Reset();
    agent->StartDevices();
  }
}

void AgentPopulation::ReportDeath(RobotAgent& agent, const std::string& detail) {
  agent.ReportDeath(detail);
  events_.Emit("agent_dead", agent.robot(), agent.DescribeInEvents() + ": " + detail);
  shared_->changed.notify_all();
}

void AgentPopulation::ReportIfFailed(RobotAgent& agent, const char* what,
                                     const base::Status& status) {
  if (status) return;
  const SimulationLock lock(*shared_);
  ReportDeath(agent, std::string(what) + " failed: " +
                         WithoutProcess(status.error().Sentence(), *agent.behaviour()));
}

void AgentPopulation::CheckForDeaths() {
  for (const auto& [name, agent] : agents_) {
    // A behaviour in this process lives as long as the process, so it is not checked.
    if (agent->is_hosted() || !agent->is_watched()) continue;
    if (!liveness_checks_.insert(name).second) continue;
    caller_.Post("watch " + name, [this, held = agent, behaviour = agent->behaviour()] {
      const bool is_dead = behaviour->IsDead();
      const SimulationLock lock(*shared_);
      liveness_checks_.erase(held->robot());
      if (is_dead && held->is_watched())
        ReportDeath(*held, "its process has ended or refuses connections");
    });
  }
}

std::vector<RobotStatus> AgentPopulation::Statuses(const world::Snapshot& snapshot,
                                                   SimTime stuck_after) const {
  std::vector<RobotStatus> statuses;
  statuses.reserve(agents_.size());
  const std::vector<int> partners = ContactPartners(snapshot);
  for (const auto& [name, agent] : agents_) {
    RobotStatus& status = statuses.emplace_back();
    agent->FillStatus(status);
    const int body = snapshot.layout->Find(name);
    if (body < 0) continue;
    status.is_station = world::IsStation(snapshot.layout->bodies[static_cast<std::size_t>(body)]);
    const world::BodyState& state = snapshot.state.bodies[static_cast<std::size_t>(body)];
    status.world_from_robot = state.world_from_model;
    status.distance = state.distance;
    status.collisions = state.collisions;
    status.motion = shared_->motions.Of(snapshot, body);
    status.motion.is_stuck = IsStuck(status.motion, stuck_after);
    const int partner = state.in_contact ? partners[static_cast<std::size_t>(body)] : -1;
    if (partner >= 0) {
      status.motion.contact = snapshot.layout->bodies[static_cast<std::size_t>(partner)].name;
    }
  }
  return statuses;
}

std::string AgentPopulation::WaitingFor() const {
  const WallTime now = WallNow();
  for (const auto& [name, agent] : agents_) {
    const bool is_waited_for = shared_->mode == Mode::kLockstep || agent->in_turn_since();
    if (!is_waited_for || !agent->IsAtWork()) continue;
    const double since = std::chrono::duration<double>(now - agent->running_since()).count();
    if (since <= 0.1) continue;
    char text[32];
    std::snprintf(text, sizeof text, " since %.1f s", since);
    return agent->Describe() + text;
  }
  return {};
}

}  // namespace gsv::simulation
