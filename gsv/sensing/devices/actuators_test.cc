// Tests lamps, speakers and microphones: the commands that they accept, their readings, and the
// sounds that microphones hear.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "gsv/base/test_within.h"
#include "gsv/messages/gsv_msgs.h"
#include "gsv/sensing/device.h"
#include "gsv/sensing/devices/gripper.h"
#include "gsv/sensing/devices/gripper_state.h"
#include "gsv/sensing/devices/lamp.h"
#include "gsv/sensing/devices/microphone.h"
#include "gsv/sensing/devices/speaker.h"
#include "gsv/sensing/testing/test_snapshot.h"

namespace gsv::sensing {
namespace {

using namespace std::chrono_literals;
using geometry::PlanarPose;

model::SensorDescription Device(const std::string& type, model::Parameters parameters = {}) {
  model::SensorDescription description;
  description.name = description.type = type;
  description.parameters = std::move(parameters);
  return description;
}

std::unique_ptr<Sensor> MakeDevice(const SensorType& type, model::Parameters parameters = {}) {
  auto made = type.create(Device(type.name, std::move(parameters)));
  EXPECT_TRUE(made) << made.error().Sentence();
  return made ? *std::move(made) : nullptr;
}

// Applies a command to a device at the time `since`. Returns the new state of the device.
world::DeviceStatePtr Commanded(const Sensor& device, const std::string& robot,
                                const world::DeviceCommand& command,
                                const world::DeviceStatePtr& before = nullptr,
                                base::SimTime since = base::SimTime(0)) {
  EXPECT_TRUE(device.device()->Check(command));
  auto now = testing::MakeSnapshot({});
  now->state.time = since;
  RaySceneCache rays;
  std::vector<world::Transmission> transmissions;
  world::DeviceStep step{now, base::SimTime(0), *rays.At(now), now->state, transmissions};
  return device.device()->Apply(robot, before, command, step);
}

class ActuatorReadings : public ::testing::Test {
 protected:
  ActuatorReadings() {
    const auto body = testing::ModelOf(geometry::Sphere{0.1});
    snapshot_ = testing::MakeSnapshot({{"ear", body, PlanarPose(0, 0, 0, 0), false},
                                       {"far", body, PlanarPose(0, -10, 0, 0), false},
                                       {"near", body, PlanarPose(2, 0, 0, 0), false}});
  }
  void Publish(world::DeviceStates states) {
    snapshot_->state.devices = std::make_shared<const world::DeviceStates>(std::move(states));
  }
  Reading Sampled(const Sensor& sensor, const std::string& robot) {
    return *sensor.Sample(Sampling(snapshot_, snapshot_->layout->Find(robot), 1, rays_));
  }
  static std::vector<double> Values(const Reading& reading) {
    return {reading.values.begin(), reading.values.end()};
  }

  std::shared_ptr<world::Snapshot> snapshot_;
  RaySceneCache rays_;
};

TEST_F(ActuatorReadings, LampReturnsItsCommand) {
  const model::Parameters parameters = {{"colour", std::string("1 0.5 0")},
                                        {"brightness", 0.25},
                                        {"range", 4.0},
                                        {"angle", 1.0},
                                        {"intensity", 3.0},
                                        {"radius", 0.05}};
  const auto lamp = MakeDevice(LampType(), parameters);
  EXPECT_EQ(Values(Sampled(*lamp, "ear")), (std::vector<double>{0.25, 1, 0.5, 0}));
  EXPECT_EQ(lamp->device()->first()->values, (std::vector<double>{0.25, 1, 0.5, 0}));
  Publish({Commanded(*lamp, "ear", {{1, 0, 0, 1}, ""})});
  const Reading reading = Sampled(*lamp, "ear");
  EXPECT_EQ(Values(reading), (std::vector<double>{1, 0, 0, 1}));

  const auto bytes = lamp->Encode(reading, "ear/lamp");
  ASSERT_TRUE(bytes);
  const auto message = messages::Decode<messages::gsv_msgs::Lamp>(std::as_bytes(std::span(*bytes)));
  ASSERT_TRUE(message);
  EXPECT_EQ(message->brightness, 1);
  EXPECT_EQ(message->color.b, 1);
  EXPECT_EQ(message->range_m, 4);
  EXPECT_EQ(message->angle_rad, 1);
  EXPECT_EQ(message->intensity, 3);
  EXPECT_EQ(message->radius_m, 0.05);
}

TEST_F(ActuatorReadings, LampIsOffAtFirstUnlessItsFileTurnsItOn) {
  const auto lamp = MakeDevice(LampType());
  EXPECT_FALSE(lamp->device()->first());
  EXPECT_EQ(Values(Sampled(*lamp, "ear")), (std::vector<double>{0, 1, 1, 1}));
}

TEST_F(ActuatorReadings, InvalidParametersAreRejected) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [name, value] :
       std::vector<std::pair<std::string, model::ParameterValue>>{{"colour", std::string("1 2 0")},
                                                                  {"colour", std::string("red")},
                                                                  {"colour", 1.0},
                                                                  {"brightness", 2.0},
                                                                  {"range", nan},
                                                                  {"angle", 0.0},
                                                                  {"radius", -1.0}}) {
    const auto lamp = LampType().create(Device("lamp", {{name, value}}));
    ASSERT_FALSE(lamp) << name;
    EXPECT_NE(lamp.error().message.find(name), std::string::npos) << lamp.error().message;
  }
  const auto refused = [](const SensorType& type, const world::DeviceCommand& command) {
    return !MakeDevice(type)->device()->Check(command);
  };
  EXPECT_TRUE(refused(LampType(), {{}, ""}));
  EXPECT_TRUE(refused(LampType(), {{1.5, 1, 1, 1}, ""}));
  EXPECT_TRUE(refused(LampType(), {{1, 1, nan, 1}, ""}));
  EXPECT_TRUE(refused(SpeakerType(), {{5, 1, 1}, "tone"}));
  EXPECT_TRUE(refused(SpeakerType(), {{440, 1e9, 1}, "tone"}));
  EXPECT_TRUE(refused(SpeakerType(), {{440, 1, 1}, "song"}));
  EXPECT_FALSE(refused(SpeakerType(), {{440, 1, 1}, "chirp"}));
}

TEST_F(ActuatorReadings, SpeakerReturnsItsSoundAndTheRemainingTime) {
  const auto speaker = MakeDevice(SpeakerType());
  EXPECT_EQ(Values(Sampled(*speaker, "ear")), (std::vector<double>{0, 0, 0, 0}));
  Publish({Commanded(*speaker, "ear", {{440, 2, 0.5}, "buzz"})});
  snapshot_->state.time = 500ms;
  const Reading reading = Sampled(*speaker, "ear");
  EXPECT_EQ(Values(reading), (std::vector<double>{440, 0.5, 0.5, 1.5}));
  EXPECT_EQ(reading.labels->front(), "buzz");
  snapshot_->state.time = 2s;
  EXPECT_EQ(Sampled(*speaker, "ear").labels->front(), "");
}

TEST_F(ActuatorReadings, SoundLastsForItsDuration) {
  const auto speaker = MakeDevice(SpeakerType(), {{"loudness", 70.0}});
  const auto state = Commanded(*speaker, "ear", {{440, 0.5, 0.8}, "tone"}, nullptr, 2s);
  const auto begun = state->SoundAt(2s);
  ASSERT_TRUE(begun);
  EXPECT_EQ(begun->elapsed, 0);
  EXPECT_EQ(begun->loudness, 70);
  const auto sound = state->SoundAt(2400ms);
  ASSERT_TRUE(sound);
  EXPECT_EQ(sound->name, "tone");
  EXPECT_EQ(sound->frequency, 440);
  EXPECT_EQ(sound->volume, 0.8);
  EXPECT_NEAR(sound->elapsed, 0.4, 1e-12);
  EXPECT_NEAR(sound->left, 0.1, 1e-12);
  EXPECT_FALSE(state->SoundAt(2500ms));
  EXPECT_FALSE(Commanded(*speaker, "ear", {{440, 0.5, 0}, "tone"}, nullptr, 2s)->SoundAt(2s));
}

TEST_F(ActuatorReadings, FingersMoveFromTheirPositionAtTheCommand) {
  const auto gripper = MakeDevice(GripperType(), {{"opening", 0.1}, {"closing_time", 0.5}});
  const auto opening = [](const world::DeviceStatePtr& state, base::SimTime now) {
    return dynamic_cast<const GripperState&>(*state).OpeningAt(now);
  };
  const auto closing = Commanded(*gripper, "ear", {{0}, ""}, nullptr, 1s);
  EXPECT_EQ(opening(closing, 1s), 0.1);
  EXPECT_NEAR(opening(closing, 1200ms), 0.06, 1e-12);
  EXPECT_EQ(opening(closing, 2s), 0);
  const auto opens = Commanded(*gripper, "ear", {{1}, ""}, closing, 1200ms);
  EXPECT_NEAR(opening(opens, 1300ms), 0.08, 1e-12);
  EXPECT_EQ(opening(opens, 2s), 0.1);
}

TEST_F(ActuatorReadings, GripperHoldsABodyUntilItOpens) {
  const auto gripper = MakeDevice(GripperType());
  const auto setup = std::make_shared<const GripperSetup>();
  const GripperState::Hold hold{{"post", PlanarPose(0.1, 0, 0, 0)}, 0.03};
  const world::DeviceStatePtr holding = std::make_shared<const GripperState>(
      world::DeviceMount{"ear", "gripper", 0, {}}, world::FollowedCommand{{{0}, ""}, 1s}, setup,
      setup->opening, hold);
  Publish({holding});
  snapshot_->state.time = 2s;
  const Reading reading = Sampled(*gripper, "ear");
  EXPECT_EQ(Values(reading), (std::vector<double>{0.03, 0}));
  EXPECT_EQ(reading.labels->front(), "post");
  const auto again = Commanded(*gripper, "ear", {{0}, ""}, holding, 3s);
  ASSERT_NE(again->grasp(), nullptr);
  EXPECT_EQ(*again->grasp(), hold.grasp);
  EXPECT_EQ(Commanded(*gripper, "ear", {{1}, ""}, holding, 3s)->grasp(), nullptr);
}

// Recordings contain hashes, so the order in which fields are hashed is part of their format.
TEST_F(ActuatorReadings, HashIncludesTheGraspedBody) {
  const auto setup = std::make_shared<const GripperSetup>();
  const geometry::Pose link_from_held{{1, 2, 3}, geometry::FromRollPitchYaw({0, 0, 0.5})};
  base::Hash hash, expected;
  GripperState({"ear", "gripper", 0, {}}, {{{0}, ""}, 7ns}, setup, 0.08,
               GripperState::Hold{{"post", link_from_held}, 0.03})
      .AddToHash(hash);
  expected.Add(std::string_view("ear"));
  expected.Add(std::string_view("gripper"));
  expected.Add(std::int64_t{7});
  expected.Add(std::uint64_t{1});
  expected.Add(0.0);
  expected.Add(std::string_view());
  expected.Add(0.08);
  expected.Add(std::string_view("post"));
  const geometry::Quaternion& q = link_from_held.orientation;
  for (const double value : {1.0, 2.0, 3.0, q.w, q.x, q.y, q.z, 0.03}) expected.Add(value);
  EXPECT_EQ(hash.Digest(), expected.Digest());
}

// The level is L = L1 + 20 lg(volume) - 20 lg(r / 1 m), and the levels of several sources add as
// powers.
TEST_F(ActuatorReadings, MicrophoneHearsByTheInverseSquareLaw) {
  const auto microphone = MakeDevice(MicrophoneType(), {{"ambient", -100.0}});
  const auto speaker = MakeDevice(SpeakerType(), {{"loudness", 85.0}});
  EXPECT_WITHIN(Sampled(*microphone, "ear").values[0], -100, 1e-9, "dB");
  EXPECT_EQ(Sampled(*microphone, "ear").values[1], 0);
  EXPECT_EQ(Sampled(*microphone, "ear").labels->front(), "");

  const auto near = Commanded(*speaker, "near", {{440, 2, 0.5}, "tone"});
  const auto far = Commanded(*speaker, "far", {{1000, 2, 1}, "tone"});
  const double near_level = 85 + 20 * std::log10(0.5) - 20 * std::log10(2.0);
  const double far_level = 85 - 20;
  Publish({near});
  EXPECT_WITHIN(Sampled(*microphone, "ear").values[0], near_level, 1e-9, "dB");
  Publish({far});
  EXPECT_WITHIN(Sampled(*microphone, "ear").values[0], far_level, 1e-9, "dB");
  Publish({far, near});
  const Reading both = Sampled(*microphone, "ear");
  EXPECT_WITHIN(both.values[0],
                10 * std::log10(std::pow(10, near_level / 10) + std::pow(10, far_level / 10)), 1e-9,
                "dB");
  EXPECT_EQ(both.values[1], 440);
  EXPECT_EQ(both.labels->front(), "near/speaker");
  // The distance to the speaker of the microphone's own robot counts as at least 0.1 m.
  Publish({Commanded(*speaker, "ear", {{440, 2, 1}, "tone"})});
  EXPECT_WITHIN(Sampled(*microphone, "ear").values[0], 85 + 20, 1e-9, "dB");
}

TEST_F(ActuatorReadings, SoundsBelowTheAmbientLevelAreNotReported) {
  const auto microphone = MakeDevice(MicrophoneType(), {{"ambient", 80.0}});
  const auto speaker = MakeDevice(SpeakerType());
  Publish({Commanded(*speaker, "far", {{440, 2, 1}, "tone"})});
  const Reading reading = Sampled(*microphone, "ear");
  EXPECT_NEAR(reading.values[0], 10 * std::log10(1e8 + std::pow(10, 6.5)), 1e-9);
  EXPECT_EQ(reading.values[1], 0);
  EXPECT_EQ(reading.labels->front(), "");
}

}  // namespace
}  // namespace gsv::sensing
