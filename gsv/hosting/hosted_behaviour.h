// A gsv::Behaviour inside this process, driving one robot of one simulation: the same class that
// runs as a program of its own, with the same outcome.
//
// A Controller's turns are plain calls; any other behaviour has a fibre, which is left in each
// wait.
#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "gsv/hosting/fibre.h"
#include "gsv/hosting/local_robot.h"
#include "sdk/behaviour/behaviour.h"

namespace gsv::hosting {

class HostedBehaviour final : public simulation::LocalBehaviour {
 public:
  HostedBehaviour(std::string name, BehaviourFactory factory);
  ~HostedBehaviour() override;

  base::Status Init(const std::shared_ptr<simulation::Agent>& agent) override;
  base::Status Start() override;
  base::Status Stop() override;
  base::Status Pause() override;
  base::Status Resume() override;
  void Destroy() override;
  const std::string& name() const override { return name_; }
  const std::string& place() const override { return place_; }

  simulation::ClockId clock() const override { return clock_; }
  void TakeTurn(simulation::Turn& turn) override;

 private:
  void Run();
  void Control(simulation::Turn& turn);
  void EndTurn(simulation::Turn& turn);  // as the last
  // The behaviour finds that its run is over and returns.
  void EndRun();
  base::Status Guarded(const char* what, const std::function<base::Status()>& call);

  const std::string name_, place_;
  const BehaviourFactory factory_;

  std::mutex mutex_;  // guards what follows; held during a turn
  std::shared_ptr<simulation::Agent> agent_;
  std::unique_ptr<Behaviour> behaviour_;
  std::unique_ptr<LocalRobot> robot_;
  simulation::ClockId clock_ = 0;
  std::unique_ptr<Fibre> fibre_;      // of a started behaviour that needs one
  Controller* controller_ = nullptr;  // of a started behaviour that needs none
  std::optional<SimTime> next_;       // a controller's next instant
  std::vector<Reading> readings_;
  std::string failure_;  // what ended the run, if it was an error
};

}  // namespace gsv::hosting
