// A behaviour for tests that fails in the requested way.
#include <csignal>
#include <stdexcept>

#include <unistd.h>

#include <CLI/CLI.hpp>

#include "sdk/serve.h"

namespace {

using namespace gsv;

class BadBehaviour final : public Behaviour {
 public:
  explicit BadBehaviour(std::string fault) : fault_(std::move(fault)) {}

  base::Status Init(Robot& robot) override {
    if (fault_ == "throw-in-init") throw std::runtime_error("no thank you");
    if (fault_ == "flood") {
      auto sonar = robot.OpenSonar("sonar_00");
      if (!sonar) return base::Fail(sonar.error());
      sonar_ = *std::move(sonar);
    }
    return {};
  }
  void Run(Robot& robot) override {
    robot.Drive(0.1, 0);
    if (fault_ == "never-wait") {
      // The behaviour is busy and never calls the simulation.
      while (robot.IsRunning()) usleep(1000);
    }
    // The behaviour does not end, even after the end of the run.
    while (fault_ == "never-end") usleep(1000);
    while (fault_ == "flood" && robot.IsRunning()) (void)sonar_->Range();
    const bool goes_on = robot.SleepFor(200ms);
    if (goes_on && fault_ == "die") raise(SIGKILL);
    if (goes_on && fault_ == "throw") throw std::runtime_error("out of ideas");
    while (robot.SleepFor(50ms)) {
    }
  }

 private:
  const std::string fault_;
  std::unique_ptr<Sonar> sonar_;
};

BehaviourFactory Configure(CLI::App& app) {
  const auto fault = std::make_shared<std::string>();
  app.add_option("--fault", *fault)->required();
  return [fault] { return std::make_unique<BadBehaviour>(*fault); };
}

}  // namespace

int main(int argc, char** argv) {
  return gsv::ServeBehaviour(argc, argv,
                             {gsv::kBehaviourInterface, "bad", "Goes wrong.", Configure});
}
