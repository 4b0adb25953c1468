#include "gsv/services/actuator_servants.h"

namespace gsv::services {
namespace {

using sensing::Reading;

constexpr unsigned kSwitchingRaises = orb::kNotRunning | orb::kEnded | orb::kFailed;

class LampServant final : public ActuatorServant<POA_sba::Lamp> {
 public:
  using ActuatorServant::ActuatorServant;
  void shine(CORBA::Double brightness, const sba::Rgb& colour) override {
    Act({{brightness, colour.red, colour.green, colour.blue}, {}});
  }
  void switch_off() override { Act({{0, 1, 1, 1}, {}}, kSwitchingRaises); }
  sba::LampReading look() override {
    const Reading reading = Read();
    const auto& v = reading.values;
    return {reading.time.count(), v.at(0), {v.at(1), v.at(2), v.at(3)}};
  }
};

class GripperServant final : public ActuatorServant<POA_sba::Gripper> {
 public:
  using ActuatorServant::ActuatorServant;
  void grip() override { Act({{0}, {}}, kSwitchingRaises); }
  void let_go() override { Act({{1}, {}}, kSwitchingRaises); }
  sba::GripperReading* feel() override {
    const Reading reading = Read();
    sba::GripperReading_var feeling = new sba::GripperReading;
    feeling->time_ns = reading.time.count();
    feeling->opening_m = reading.values.at(0);
    feeling->told_to_open = reading.values.at(1) != 0;
    feeling->held = reading.labels->at(0).c_str();
    return feeling._retn();
  }
};

class SpeakerServant final : public ActuatorServant<POA_sba::Speaker> {
 public:
  using ActuatorServant::ActuatorServant;
  void play(const char* sound, CORBA::Double frequency_hz, CORBA::Double duration_s,
            CORBA::Double volume) override {
    Act({{frequency_hz, duration_s, volume}, sound});
  }
  void silence() override { Act({{20, 0, 0}, "tone"}, kSwitchingRaises); }
  sba::SpeakerReading* playing() override {
    const Reading reading = Read();
    const auto& v = reading.values;
    sba::SpeakerReading_var playing = new sba::SpeakerReading;
    playing->time_ns = reading.time.count();
    playing->sound = reading.labels->at(0).c_str();
    playing->frequency_hz = v.at(0), playing->volume = v.at(1);
    playing->elapsed_s = v.at(2), playing->left_s = v.at(3);
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
