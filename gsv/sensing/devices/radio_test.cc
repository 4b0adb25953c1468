// Compares radio links with the Friis equation, and tests the received messages of a radio.
#include "gsv/sensing/devices/radio.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "gsv/base/test_within.h"
#include "gsv/messages/gsv_msgs.h"
#include "gsv/sensing/devices/radio_state.h"
#include "gsv/sensing/testing/test_snapshot.h"

namespace gsv::sensing {
namespace {

using geometry::Box;
using geometry::PlanarPose;

// Two robots are 8 m apart along x, each with its antenna at its centre. Bodies may be between
// them.
class RadioLink : public ::testing::Test {
 protected:
  void Stand(std::vector<testing::Placed> between = {}) {
    between.push_back(
        {"a", testing::ModelOf(geometry::Sphere{0.2}), PlanarPose(0, 0, 1, 0), false});
    between.push_back(
        {"b", testing::ModelOf(geometry::Sphere{0.2}), PlanarPose(8, 0, 1, 0), false});
    snapshot_ = testing::MakeSnapshot(between);
  }
  Antenna AntennaOf(const std::string& robot, const world::RadioSetup& setup) const {
    const int body = snapshot_->layout->Find(robot);
    return {std::make_shared<const world::RadioSetup>(setup),
            snapshot_->state.bodies[body].world_from_model.position, body};
  }
  std::optional<double> Heard() {
    if (snapshot_ == nullptr) Stand();
    const auto scene = rays_.At(snapshot_);
    return HeardAt(AntennaOf("a", from_), AntennaOf("b", to_), *scene);
  }
  static testing::Placed Wall(const std::string& name, double x, double thickness = 0.1) {
    return {name, testing::ModelOf(Box{{thickness, 4, 4}}), PlanarPose(x, 0, 1, 0), true};
  }

  std::shared_ptr<world::Snapshot> snapshot_;
  RaySceneCache rays_;
  world::RadioSetup from_, to_;
};

TEST_F(RadioLink, FollowsTheFriisEquationInFreeSpace) {
  // In watts: P_r = P_t G_t G_r (lambda / 4 pi d)^2.
  from_.power = 14.5, from_.gain = 2.5, to_.gain = 6;
  const double watts = 1e-3 * std::pow(10, 1.45);
  const double wavelength = 299'792'458 / 2.442e9;
  const double received = watts * std::pow(10, 0.25) * std::pow(10, 0.6) *
                          std::pow(wavelength / (4 * std::numbers::pi * 8), 2);
  ASSERT_TRUE(Heard());
  EXPECT_WITHIN(*Heard(), 10 * std::log10(received / 1e-3), 1e-9, "dB");
}

TEST_F(RadioLink, PathLossFollowsTheExponent) {
  const double square = *Heard();
  from_.path_loss_exponent = 3.5;
  EXPECT_WITHIN(square - *Heard(), 10 * 1.5 * std::log10(8), 1e-9, "dB");
}

TEST_F(RadioLink, EndsAtTheReceiversSensitivity) {
  const double strength = *Heard();
  to_.sensitivity = strength;
  EXPECT_TRUE(Heard());
  to_.sensitivity = std::nextafter(strength, 0);
  EXPECT_FALSE(Heard());
}

TEST_F(RadioLink, EndsAtTheSendersRange) {
  from_.range = 8;
  EXPECT_TRUE(Heard());
  from_.range = 7.999;
  EXPECT_FALSE(Heard());
  // the receiver's range limits only the messages that the receiver sends
  from_.range = 0, to_.range = 1;
  EXPECT_TRUE(Heard());
}

TEST_F(RadioLink, NeedsTheSameNetworkAndFrequency) {
  from_.network = "red";
  EXPECT_FALSE(Heard());
  to_.network = "red";
  EXPECT_TRUE(Heard());
  to_.frequency = 2.412e9;
  EXPECT_FALSE(Heard());
}

TEST_F(RadioLink, LosesPowerAtEachWall) {
  const double in_the_open = *Heard();
  from_.wall_loss = 12;
  Stand({Wall("one", 2), Wall("two", 3), Wall("thick", 5, 1.5)});
  EXPECT_WITHIN(*Heard(), in_the_open - 3 * 12, 1e-9, "dB");
}

TEST_F(RadioLink, IgnoresBodiesBesideTheLinkAndTheRobotsThemselves) {
  const double in_the_open = *Heard();
  Stand({{"beside", testing::ModelOf(Box{{0.1, 4, 4}}), PlanarPose(4, 3, 1, 0), true},
         {"floor", testing::ModelOf(geometry::Plane{}), {}, true}});
  EXPECT_EQ(*Heard(), in_the_open);
}

TEST_F(RadioLink, IsBlockedByAnAbsorbingWall) {
  from_.wall_loss = 1000;
  Stand({Wall("one", 2)});
  EXPECT_FALSE(Heard());
  from_.wall_loss = 0;
  EXPECT_TRUE(Heard());
}

TEST_F(RadioLink, IsFiniteForTwoAntennasAtOnePlace) {
  EXPECT_NEAR(ArrivingStrength(from_, to_, 0, 0), ArrivingStrength(from_, to_, 0.01, 0), 1e-12);
}

model::SensorDescription RadioOf(model::Parameters parameters = {}) {
  model::SensorDescription description;
  description.name = "radio";
  description.type = "radio";
  description.link_from_sensor = PlanarPose(0.1, 0, 0.5, 0);
  description.parameters = std::move(parameters);
  return description;
}

base::Result<std::unique_ptr<Sensor>> MakeRadio(model::Parameters parameters = {}) {
  return RadioType().create(RadioOf(std::move(parameters)));
}

RadioState SwitchedOn(const Sensor& radio) {
  return dynamic_cast<const RadioState&>(*radio.device()->SwitchedOn("robot"));
}

TEST(Radio, ReadsTheParametersOfSdformat) {
  const auto radio = MakeRadio({{"essid", std::string("net")},
                                {"frequency", 5000.0},
                                {"power", 10.0},
                                {"gain", 1.0},
                                {"sensitivity", -80.0},
                                {"range", 25.0},
                                {"wall_loss", 3.0},
                                {"inbox", 4.0},
                                {"max_size", 100.0}});
  ASSERT_TRUE(radio);
  const RadioState state = SwitchedOn(**radio);
  const world::RadioSetup* const setup = &state.setup();
  EXPECT_EQ(setup->network, "net");
  EXPECT_EQ(setup->frequency, 5e9);
  EXPECT_EQ(setup->power, 10);
  EXPECT_EQ(setup->gain, 1);
  EXPECT_EQ(setup->sensitivity, -80);
  EXPECT_EQ(setup->range, 25);
  EXPECT_EQ(setup->wall_loss, 3);
  EXPECT_EQ(setup->inbox, 4u);
  EXPECT_EQ(setup->max_size, 100u);
  EXPECT_EQ(state.mount().link_from_device.position.z, 0.5);
}

TEST(Radio, RejectsInvalidParameters) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const auto& [name, value] : std::vector<std::pair<std::string, double>>{{"inbox", 0},
                                                                               {"inbox", 1e6},
                                                                               {"max_size", 0},
                                                                               {"range", -1},
                                                                               {"power", nan},
                                                                               {"frequency", 0},
                                                                               {"wall_loss", -3}}) {
    const auto radio = MakeRadio({{name, value}});
    ASSERT_FALSE(radio) << name;
    EXPECT_NE(radio.error().message.find(name), std::string::npos) << radio.error().message;
  }
}

TEST(Radio, ReturnsReceivedMessages) {
  const auto snapshot =
      testing::MakeSnapshot({{"robot", testing::ModelOf(geometry::Sphere{0.2}), {}, false}});
  const auto radio = MakeRadio({{"inbox", 1.0}});
  ASSERT_TRUE(radio);
  RaySceneCache rays;
  EXPECT_TRUE((*radio)->Sample(Sampling(snapshot, 0, 1, rays))->values.empty());

  auto state = std::make_shared<RadioState>(SwitchedOn(**radio));
  const std::string content("a\0b\xff", 4);
  const auto message = world::WithDigest({"other", "r", "", base::SimTime(1'500'000'000), content});
  for (int i = 0; i < 7; ++i) state->Hear(message, -41.5);
  snapshot->state.devices = std::make_shared<const world::DeviceStates>(world::DeviceStates{state});
  const auto reading = (*radio)->Sample(Sampling(snapshot, 0, 1, rays));
  EXPECT_EQ(std::vector<double>(reading->values.begin(), reading->values.end()),
            (std::vector<double>{7, 1.5, -41.5}));
  EXPECT_EQ(*reading->labels, (std::vector<std::string>{"other", "YQBi/w=="}));

  const auto bytes = (*radio)->Encode(*reading, "robot/radio");
  ASSERT_TRUE(bytes);
  const auto decoded =
      messages::Decode<messages::gsv_msgs::Radio>(std::as_bytes(std::span(*bytes)));
  ASSERT_TRUE(decoded);
  ASSERT_EQ(decoded->messages.size(), 1u);
  EXPECT_EQ(decoded->messages[0].sender, "other");
  EXPECT_EQ(decoded->messages[0].number, 7u);
  EXPECT_EQ(decoded->messages[0].sent.sec, 1);
  EXPECT_EQ(decoded->messages[0].sent.nanosec, 500'000'000u);
  EXPECT_EQ(decoded->messages[0].content, (std::vector<std::uint8_t>{'a', 0, 'b', 0xff}));
}

// Recordings contain hashes, so the order of fields is part of their format.
TEST(Radio, HashIncludesReceivedMessages) {
  const auto radio = MakeRadio();
  ASSERT_TRUE(radio);
  RadioState state = SwitchedOn(**radio);
  const auto message = world::WithDigest({"other", "r", "", base::SimTime(5), "hello"});
  state.Hear(message, -41.5);
  base::Hash hash, expected;
  state.AddToHash(hash);
  expected.Add(std::string_view("robot"));
  expected.Add(std::string_view("radio"));
  expected.Add(std::uint64_t{1});  // how many messages were received
  expected.Add(std::uint64_t{1});  // the sequence number of the message in the inbox
  expected.Add(-41.5);
  expected.Add(message->digest);
  EXPECT_EQ(hash.Digest(), expected.Digest());
}

// Robot "a", and optionally robot "c", sends one message in each step. Strengths() returns the
// strengths (dBm) of the messages that "b" receives.
class RadioOnTheAir : public RadioLink {
 protected:
  std::vector<double> Strengths(const RadioErrors& errors, int messages, bool c_sends = false) {
    Stand({{"c", testing::ModelOf(geometry::Sphere{0.2}), PlanarPose(0, 3, 1, 0), false}});
    to_.inbox = 256;
    auto setup = std::make_shared<const world::RadioSetup>(to_);
    world::DeviceStatePtr state =
        std::make_shared<const RadioState>(world::DeviceMount{"b", "radio", 0, {}}, setup, errors);
    std::vector<double> strengths;
    for (int i = 0; i < messages; ++i) {
      snapshot_->state.step = i;
      std::vector<world::Transmission> sent;
      for (const char* robot : {"a", "c"}) {
        if (robot[0] == 'c' && !c_sends) continue;
        world::RadioMessage message;
        message.sender = robot;
        message.content = std::to_string(i);
        sent.push_back({world::WithDigest(std::move(message)), AntennaOf(robot, from_), {}});
      }
      world::DeviceStep step{
          snapshot_, base::SimTime(0), *rays_.At(snapshot_), snapshot_->state, sent, 1};
      const auto next = state->BeforeStep(step);
      if (next == nullptr) continue;
      strengths.push_back(dynamic_cast<const RadioState&>(*next).inbox().back().strength);
    }
    return strengths;
  }
};

TEST_F(RadioOnTheAir, LosesTheConfiguredFractionOfMessages) {
  RadioErrors errors;
  errors.loss_probability = 0.3;
  const double share = static_cast<double>(Strengths(errors, 2000).size()) / 2000;
  EXPECT_WITHIN_3_SIGMA(share, 0.7, std::sqrt(0.3 * 0.7 / 2000));
}

TEST_F(RadioOnTheAir, FadesWithTheConfiguredDeviation) {
  const double still = Strengths({}, 1).at(0);
  RadioErrors errors;
  errors.fading = 4;
  double squares = 0;
  const std::vector<double> heard = Strengths(errors, 2000);
  ASSERT_EQ(heard.size(), 2000u);
  for (const double strength : heard) squares += (strength - still) * (strength - still);
  EXPECT_WITHIN_3_SIGMA(std::sqrt(squares / 2000), 4, 4 / std::sqrt(4000.0));
}

TEST_F(RadioOnTheAir, ReceivesNeitherOfTwoSignalsOfSimilarPower) {
  RadioErrors errors;
  errors.capture_ratio = 6;  // in dB
  EXPECT_EQ(Strengths(errors, 5).size(), 5u);
  EXPECT_EQ(Strengths(errors, 5, /*c_sends=*/true).size(), 0u);
  errors.capture_ratio = 0;
  EXPECT_EQ(Strengths(errors, 5, /*c_sends=*/true).size(), 5u);
}

}  // namespace
}  // namespace gsv::sensing
