// gateway_dev_server: the gateway with a scripted simulation, for developing and testing viewers.
// Prints its address, and serves until it is interrupted or its standard input ends.
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include <pthread.h>

#include <CLI/CLI.hpp>

#include "gsv/base/log.h"
#include "gsv/gateway/gateway.h"
#include "gsv/gateway/testing/scripted_simulation.h"
#include "gsv/gateway/testing/simulation_list.h"

namespace {

using gsv::gateway::testing::ScriptedSimulation;
using gsv::gateway::testing::SimulationList;

constexpr std::int64_t kStepsBetweenMeetings = 50;

// While the simulation runs, advances its time, and makes two robots touch twice per second.
void Drive(const std::shared_ptr<ScriptedSimulation>& simulation, std::stop_token stop) {
  const auto step = std::chrono::milliseconds(10);
  auto next = std::chrono::steady_clock::now();
  while (!stop.stop_requested()) {
    next += step;
    std::this_thread::sleep_until(next);
    const gsv::simulation::SimulationStatus status = simulation->status();
    if (status.phase != gsv::simulation::Phase::kRunning) continue;
    if (status.robots.size() > 1 && status.step % kStepsBetweenMeetings == 0) {
      simulation->Meet("robot_0", "avatar");
    } else {
      simulation->Advance(step);
    }
  }
}

void WaitForSignal() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  int received = 0;
  sigwait(&signals, &received);
}

void BlockSignals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &signals, nullptr);
}

}  // namespace

int main(int argc, char** argv) {
  gsv::gateway::GatewayOptions options;
  int robots = 3;
  std::string web_root;
  CLI::App app{"The gateway with robots that drive in circles"};
  app.add_option("--host", options.host, "Address to listen on");
  app.add_option("--port", options.port, "Port; 0: the system chooses");
  app.add_option("--web", web_root, "Directory of the viewer's files");
  app.add_option("--robots", robots, "How many")->check(CLI::Range(0, 1000));
  app.add_option("--allow-host", options.allowed_hosts, "Further Host names");
  app.add_option("--allow-origin", options.allowed_origins, "Further origins of pages");
  CLI11_PARSE(app, argc, argv);
  options.web_root = web_root;
  BlockSignals();
  gsv::base::InitLogging(spdlog::level::info);

  const auto simulation = std::make_shared<ScriptedSimulation>("arena", robots);
  const auto directory = std::make_shared<SimulationList>();
  directory->Add(simulation);
  const auto gateway = gsv::gateway::Gateway::Start(options, directory);
  if (!gateway) {
    std::fprintf(stderr, "%s\n", gateway.error().Sentence().c_str());
    return 5;
  }
  if (!simulation->Start()) return 5;
  for (int i = 0; i < robots; ++i) {
    simulation->SetDriveState("robot_" + std::to_string(i), ScriptedSimulation::CommandOf(i), {});
  }
  std::printf("%s\n", (*gateway)->url().c_str());
  std::fflush(stdout);
  const std::jthread driver([&](std::stop_token stop) { Drive(simulation, stop); });
  WaitForSignal();
  return 0;
}
