// recording_victim FILE MICROSECONDS: records a simulation until the process is killed. Each cycle
// of the robot's behaviour takes MICROSECONDS longer. For each snapshot that the recorder has
// taken, the program writes a HandOver to stdout.
#include <csignal>
#include <cstdlib>

#include <sys/prctl.h>
#include <unistd.h>

#include "gsv/recording/simulation_recorder.h"
#include "gsv/recording/testing/hand_over.h"
#include "gsv/recording/testing/test_simulation.h"

namespace gsv::recording {
namespace {

class HandOverWriter final : public simulation::Observer {
 public:
  void OnSnapshot(const std::shared_ptr<const world::Snapshot>& snapshot) override {
    const HandOver hand_over{snapshot->state.time.count(), WallNow()};
    if (write(STDOUT_FILENO, &hand_over, sizeof hand_over) != sizeof hand_over) _exit(1);
  }
  void OnEvent(const simulation::Event&) override {}
};

int Run(const char* path, std::chrono::microseconds dawdling) {
  const auto simulation = MakeSimulation(0s, Drives(0.1, dawdling));
  RecorderOptions options;
  options.write_glb = [](const model::Model&) {
    return base::Result<std::vector<std::uint8_t>>(std::vector<std::uint8_t>(100));
  };
  const auto recorder = SimulationRecorder::Start(simulation, path, std::move(options));
  if (!recorder) return 1;
  // This observer was added after the recorder, so it is called after the recorder.
  simulation->AddObserver(std::make_shared<HandOverWriter>());
  if (!simulation->Start()) return 1;
  for (;;) pause();
}

}  // namespace
}  // namespace gsv::recording

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  return gsv::recording::Run(argv[1], std::chrono::microseconds(std::atoi(argv[2])));
}
