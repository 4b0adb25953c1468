#include "gsv/services/actuator_servants.h"

namespace gsv::services {
namespace {

using sensing::Reading;

constexpr unsigned kSwitchingRaises = orb::kNotRunning | orb::kEnded | orb::kFailed;

class LampServant final : public ActuatorServant<POA_sba::Lamp> {
 public:
  using ActuatorServant::ActuatorServant;
  void shine(CORBA::Double brightness, const sba::Rgb& colour) override {
    CommandDevice({{brightness, colour.red, colour.green, colour.blue}, {}});
  }
  void switch_off() override { CommandDevice({{0, 1, 1, 1}, {}}, kSwitchingRaises); }
  sba::LampReading look() override {
    const Reading reading = Read();
    const auto [brightness, colour] = In<readings::Lamp>(reading);
    return {reading.time.count(), brightness, {colour.red, colour.green, colour.blue}};
  }
};

class GripperServant final : public ActuatorServant<POA_sba::Gripper> {
 public:
  using ActuatorServant::ActuatorServant;
  void grip() override { CommandDevice({{0}, {}}, kSwitchingRaises); }
  void let_go() override { CommandDevice({{1}, {}}, kSwitchingRaises); }
  sba::GripperReading* feel() override {
    const Reading reading = Read();
    sba::GripperReading_var feeling = new sba::GripperReading;
    feeling->time_ns = reading.time.count();
    const auto jaws = In<readings::Gripper>(reading);
    feeling->opening_m = jaws.opening;
    feeling->told_to_open = jaws.told_to_open;
    feeling->held = jaws.held.c_str();
    return feeling._retn();
  }
};

class SpeakerServant final : public ActuatorServant<POA_sba::Speaker> {
 public:
  using ActuatorServant::ActuatorServant;
  void play(const char* sound, CORBA::Double frequency_hz, CORBA::Double duration_s,
            CORBA::Double volume) override {
    CommandDevice({{frequency_hz, duration_s, volume}, sound});
  }
  void silence() override { CommandDevice({{20, 0, 0}, "tone"}, kSwitchingRaises); }
  sba::SpeakerReading* playing() override {
    const Reading reading = Read();
    const auto sound = In<readings::Speaker>(reading);
    sba::SpeakerReading_var playing = new sba::SpeakerReading;
    playing->time_ns = reading.time.count();
    playing->sound = sound.name.c_str();
    playing->frequency_hz = sound.frequency, playing->volume = sound.volume;
    playing->elapsed_s = sound.elapsed, playing->left_s = sound.left;
    return playing._retn();
  }
};

}  // namespace

PortableServer::ServantBase* MakeLampServant(std::shared_ptr<simulation::Agent> agent,
                                             model::SensorDescription description,
                                             std::shared_ptr<ServantGroup> group) {
  return MakeSensorServant<LampServant>(std::move(agent), std::move(description), std::move(group));
}

PortableServer::ServantBase* MakeGripperServant(std::shared_ptr<simulation::Agent> agent,
                                                model::SensorDescription description,
                                                std::shared_ptr<ServantGroup> group) {
  return MakeSensorServant<GripperServant>(std::move(agent), std::move(description),
                                           std::move(group));
}

PortableServer::ServantBase* MakeSpeakerServant(std::shared_ptr<simulation::Agent> agent,
                                                model::SensorDescription description,
                                                std::shared_ptr<ServantGroup> group) {
  return MakeSensorServant<SpeakerServant>(std::move(agent), std::move(description),
                                           std::move(group));
}

}  // namespace gsv::services
