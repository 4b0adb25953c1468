#include "gsv/gateway/replay/replay_operations.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "gsv/gateway/replay/replay_player.h"
#include "gsv/simulation/commands/command_table.h"

namespace gsv::gateway {
namespace {

using base::ErrorCode;
using foxglove::PlaybackState;
using simulation::Arguments;
using simulation::Phase;

std::vector<CommandServices::Service> ServicesOf(ReplayPlayer& player) {
  const auto service = [](std::string_view name, auto run) {
    return CommandServices::Service{*simulation::FindCommand(name), run};
  };
  const auto rewind = [&player](const Arguments&) {
    player.Rewind();
    return std::string();
  };
  return {service("start", [&](const Arguments&) { return NoMessage(player.Start()); }),
          service("pause", [&](const Arguments&) { return NoMessage(player.Pause()); }),
          service("resume", [&](const Arguments&) { return NoMessage(player.Resume()); }),
          service("stop", rewind),
          service("reset", rewind),
          service("step", [&](const Arguments& given) {
            return NoMessage(player.Step(given.Get<std::int64_t>("count")));
          })};
}

PlaybackState::Status StatusOf(Phase phase) {
  if (phase == Phase::kRunning) return PlaybackState::Status::kPlaying;
  return phase == Phase::kFinished ? PlaybackState::Status::kEnded : PlaybackState::Status::kPaused;
}

// Makes the replay play, whatever its phase is.
base::Status Play(ReplayPlayer& player) {
  switch (player.clock().phase()) {
    case Phase::kCreated:
      return player.Start();
    case Phase::kPaused:
      return player.Resume();
    default:
      return {};
  }
}

base::Status Pause(ReplayPlayer& player) {
  return player.clock().is_playing() ? player.Pause() : base::Status();
}

}  // namespace

ReplayOperations::ReplayOperations(ReplayPlayer& player)
    : player_(player), services_(ServicesOf(player)) {}

void ReplayOperations::Call(const foxglove::ServiceCall& call, Answer answer) {
  const auto command = services_.Prepare(call);
  if (!command) return answer(base::Fail(command.error()));
  answer((*command)());
}

std::vector<foxglove::Parameter> ReplayOperations::parameters() const {
  const ReplayClock clock = player_.clock();
  return {{"/gsv/name", player_.name()},
          {"/gsv/start_s", base::ToSeconds(clock.start())},
          {"/gsv/end_s", base::ToSeconds(clock.end())},
          {"/gsv/phase", std::string(ToString(clock.phase()))},
          {"/gsv/speed", clock.speed()},
          {"/gsv/loop", clock.loop()}};
}

base::Status ReplayOperations::Set(const foxglove::Parameter& parameter) {
  const auto* number = std::get_if<double>(&parameter.value);
  const auto* flag = std::get_if<bool>(&parameter.value);
  if (parameter.name == "/gsv/speed" && number != nullptr) return player_.SetSpeed(*number);
  if (parameter.name == "/gsv/loop" && flag != nullptr) {
    player_.SetLoop(*flag);
    return {};
  }
  return base::Fail(ErrorCode::kInvalidArgument,
                    "the parameter '" + parameter.name.substr(0, 100) +
                        "' cannot be set to this; a replay has the parameters /gsv/speed (a "
                        "number) and /gsv/loop (true or false)");
}

std::optional<PlaybackState> ReplayOperations::playback() const {
  const ReplayClock clock = player_.clock();
  return PlaybackState{StatusOf(clock.phase()), base::NanosecondsOf(clock.position()),
                       static_cast<float>(clock.speed()), false, std::string()};
}

base::Status ReplayOperations::Control(const foxglove::PlaybackControl& request) {
  if (const base::Status set = player_.SetSpeed(request.speed); !set) return set;
  if (request.seek_ns) {
    constexpr std::uint64_t kMaxTime = std::numeric_limits<std::int64_t>::max();
    player_.Seek(base::SimTime(static_cast<std::int64_t>(std::min(*request.seek_ns, kMaxTime))));
  }
  return request.play ? Play(player_) : Pause(player_);
}

}  // namespace gsv::gateway
