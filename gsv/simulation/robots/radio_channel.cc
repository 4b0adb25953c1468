#include "gsv/simulation/robots/radio_channel.h"

#include <algorithm>
#include <map>
#include <optional>

#include "gsv/sensing/radio_link.h"

namespace gsv::simulation {
namespace {

using sensing::Antenna;
using world::RadioState;

constexpr std::size_t kMostSendingsAStep = 64;

using Acts = std::vector<std::pair<std::string, RadioActs>>;
// By robot and sensor; none is null.
using SwitchedOn = std::map<std::pair<std::string, std::string>, world::RadioStatePtr>;

void Switch(const Acts& acts, SwitchedOn& radios) {
  for (const auto& [robot, done] : acts) {
    for (const RadioSwitch& change : done.switches) {
      const std::pair key(robot, change.sensor);
      if (change.setup == nullptr) {
        radios.erase(key);
      } else if (!radios.contains(key)) {
        auto radio = std::make_shared<RadioState>();
        radio->robot = robot;
        radio->sensor = change.sensor;
        radio->setup = change.setup;
        radios.emplace(key, std::move(radio));
      }
    }
  }
}

// The antenna of a robot's radio; nothing if the robot does not stand in the world.
std::optional<Antenna> AntennaOf(const world::Snapshot& now, const std::string& robot,
                                 const world::RadioSetup& setup) {
  const int body = now.layout->Find(robot);
  if (body < 0) return std::nullopt;
  const geometry::Pose world_from_antenna =
      world::LinkPose(now, body, setup.link) * setup.link_from_antenna;
  return Antenna{&setup, world_from_antenna.position, body};
}

void Hear(const world::RadioMessagePtr& message, double strength, RadioState& radio) {
  const std::size_t room = radio.setup->inbox;
  if (radio.inbox.size() >= room) {
    const auto surplus = static_cast<std::ptrdiff_t>(radio.inbox.size() - room + 1);
    radio.inbox.erase(radio.inbox.begin(), radio.inbox.begin() + surplus);
  }
  radio.inbox.push_back({message, ++radio.heard, strength});
}

// The radios that are on, while messages arrive at them.
class Receivers {
 public:
  Receivers(std::shared_ptr<const world::Snapshot> now, sensing::RaySceneCache& rays,
            base::ThreadTeam* team, SwitchedOn& radios)
      : now_(std::move(now)), rays_(rays), team_(team) {
    for (auto& [name, radio] : radios) {
      const auto antenna = AntennaOf(*now_, name.first, *radio->setup);
      if (antenna) all_.push_back({*antenna, &name.first, &radio, nullptr});
    }
  }

  world::Transmission Send(const std::string& robot, const RadioSending& sending) {
    world::RadioMessage message;
    message.sender = robot;
    message.radio = sending.sensor;
    message.receiver = sending.receiver;
    message.sent = now_->state.time;
    message.content = sending.content;
    world::Transmission transmission{world::Sealed(std::move(message)), {}};
    const auto from = AntennaOf(*now_, robot, *sending.setup);
    for (Receiver& to : all_) {
      const std::string& hearer = *to.robot;
      if (!from || hearer == robot) continue;
      if (!sending.receiver.empty() && hearer != sending.receiver) continue;
      const auto strength = sensing::HeardAt(
          *from, to.antenna, [this]() -> const sensing::RayScene& { return Scene(); });
      if (!strength) continue;
      Hear(transmission.message, *strength, Changed(to));
      if (transmission.heard_by.empty() || transmission.heard_by.back() != hearer) {
        transmission.heard_by.push_back(hearer);
      }
    }
    return transmission;
  }

 private:
  struct Receiver {
    Antenna antenna;
    const std::string* robot;  // in the map, as is the radio
    world::RadioStatePtr* radio;
    std::shared_ptr<RadioState> changed;  // the same, once it has heard something
  };

  static RadioState& Changed(Receiver& receiver) {
    if (receiver.changed == nullptr) {
      receiver.changed = std::make_shared<RadioState>(**receiver.radio);
      *receiver.radio = receiver.changed;
    }
    return *receiver.changed;
  }

  const sensing::RayScene& Scene() {
    if (scene_ == nullptr) scene_ = rays_.At(now_, team_);
    return *scene_;
  }

  const std::shared_ptr<const world::Snapshot> now_;
  sensing::RaySceneCache& rays_;
  base::ThreadTeam* const team_;
  std::vector<Receiver> all_;
  std::shared_ptr<const sensing::RayScene> scene_;  // null until walls matter
};

}  // namespace

base::Result<RadioSending> MakeSending(const MountedSensor& sensor, const std::string& receiver,
                                       std::string content, const RadioActs& before,
                                       const std::string& robot) {
  const std::string where = robot + "/" + sensor.name();
  const auto refuse = [&](const std::string& sentence) {
    return base::Fail(base::ErrorCode::kInvalidArgument, sentence, where);
  };
  const world::RadioSetupPtr setup = sensor.radio();
  if (setup == nullptr) return refuse("only a radio sends messages");
  if (content.size() > setup->max_size) {
    return refuse("a message of " + std::to_string(content.size()) +
                  " bytes is longer than the radio's max_size, " + std::to_string(setup->max_size));
  }
  if (receiver.size() > 128) return refuse("a robot's name has at most 128 characters");
  if (before.sendings.size() >= kMostSendingsAStep) {
    return refuse("a robot sends at most 64 messages in one step");
  }
  return RadioSending{sensor.name(), setup, receiver, std::move(content)};
}

std::vector<world::Transmission> Communicate(const std::shared_ptr<const world::Snapshot>& now,
                                             Acts acts, sensing::RaySceneCache& rays,
                                             base::ThreadTeam* team, world::State& state) {
  std::sort(acts.begin(), acts.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  SwitchedOn radios;
  if (state.radios != nullptr) {
    for (const world::RadioStatePtr& radio : *state.radios) {
      radios.emplace(std::pair(radio->robot, radio->sensor), radio);
    }
  }
  Switch(acts, radios);
  std::vector<world::Transmission> transmissions;
  Receivers receivers(now, rays, team, radios);
  for (const auto& [robot, done] : acts) {
    for (const RadioSending& sending : done.sendings) {
      transmissions.push_back(receivers.Send(robot, sending));
    }
  }
  auto after = std::make_shared<world::Radios>();
  after->reserve(radios.size());
  for (auto& [name, radio] : radios) after->push_back(std::move(radio));
  state.radios = std::move(after);
  return transmissions;
}

}  // namespace gsv::simulation
