#include "gsv/world/device_state.h"

#include <functional>

#include <gtest/gtest.h>

#include "gsv/world/actuator_state.h"

namespace gsv::world {
namespace {

using namespace std::chrono_literals;

DeviceStatePtr Commanded(std::string robot, std::string device, FollowedCommand followed = {}) {
  return std::make_shared<const ActuatorState>(
      DeviceMount{std::move(robot), std::move(device), 0, {}}, std::move(followed));
}

// A device without commands. It adds only the name of its robot to the hash.
class Listener final : public DeviceState {
 public:
  using DeviceState::DeviceState;
  void AddToHash(base::Hash& hash) const override { hash.Add(std::string_view(robot())); }
};

TEST(FindDevice, FindsByRobotAndName) {
  const DeviceStates all = {Commanded("a", "lamp"), Commanded("a", "siren"),
                            Commanded("b", "lamp")};
  EXPECT_EQ(FindDevice(&all, "a", "siren"), all[1].get());
  EXPECT_EQ(FindDevice(&all, "b", "lamp"), all[2].get());
  EXPECT_EQ(FindDevice(&all, "b", "siren"), nullptr);
  EXPECT_EQ(FindDevice(nullptr, "a", "lamp"), nullptr);
}

TEST(DeviceHash, DependsOnEachFieldOfACommand) {
  const auto hash_of = [](const std::string& robot, const std::string& device,
                          const FollowedCommand& followed) {
    base::Hash hash;
    AddToHash({Commanded(robot, device, followed)}, hash);
    return hash.Digest();
  };
  const FollowedCommand followed{{{1, 0.5}, "word"}, 0s};
  const std::uint64_t digest = hash_of("robot", "lamp", followed);
  EXPECT_NE(hash_of("other", "lamp", followed), digest);
  EXPECT_NE(hash_of("robot", "other", followed), digest);
  for (const auto& change : std::vector<std::function<void(FollowedCommand&)>>{
           [](auto& f) { f.command.values[1] = 0.25; },
           [](auto& f) { f.command.values.push_back(0); }, [](auto& f) { f.command.word = ""; },
           [](auto& f) { f.since = 1ns; }}) {
    FollowedCommand changed = followed;
    change(changed);
    EXPECT_NE(hash_of("robot", "lamp", changed), digest);
  }
}

TEST(DeviceHash, DependsOnTheOwnValuesOfAnActuatorType) {
  class Winch final : public ActuatorState {
   public:
    explicit Winch(double length) : ActuatorState({"robot", "winch", 0, {}}, {}), length_(length) {}

   private:
    void AddRestToHash(base::Hash& hash) const override { hash.Add(length_); }
    const double length_;
  };
  const auto hash_of = [](double length) {
    base::Hash hash;
    AddToHash({std::make_shared<const Winch>(length)}, hash);
    return hash.Digest();
  };
  EXPECT_EQ(hash_of(1), hash_of(1));
  EXPECT_NE(hash_of(1), hash_of(2));
}

// Recordings contain hashes, so the order in which fields are hashed is part of their format.
TEST(DeviceHash, IncludesDevicesWithoutACommand) {
  base::Hash hash, expected;
  AddToHash({Commanded("a", "lamp", {{{0.5}, "w"}, 7ns}),
             std::make_shared<const Listener>(DeviceMount{"b", "radio", 0, {}})},
            hash);
  for (const char* text : {"b", "a", "lamp"}) expected.Add(std::string_view(text));
  expected.Add(std::int64_t{7});
  expected.Add(std::uint64_t{1});
  expected.Add(0.5);
  expected.Add(std::string_view("w"));
  expected.Add(0.0);                                                     // opening of a gripper
  expected.Add(std::string_view());                                      // name of the grasped body
  for (const double value : {0, 0, 0, 1, 0, 0, 0}) expected.Add(value);  // pose of that body,
  expected.Add(0.0);                                                     // and its width
  EXPECT_EQ(hash.Digest(), expected.Digest());
}

}  // namespace
}  // namespace gsv::world
