#include "apps/gsv/simulations/world_saving.h"

#include <gmock/gmock.h>

#include "gsv/base/test_folder.h"
#include "gsv/formats/sdf_reader.h"
#include "gsv/scenario/scenario_file.h"
#include "gsv/sensing/devices/built_in.h"

namespace gsv::app {
namespace {

using namespace std::chrono_literals;
using simulation::Phase;
using simulation::Simulation;

constexpr char kWorld[] = R"(<?xml version='1.0'?>
<sdf version='1.9'><world name='room'>
  <model name='floor'><static>true</static><link name='l'><collision name='c'><geometry><plane/>
    </geometry></collision></link></model>
  <model name='crate'><pose>1 0 0.25 0 0 0.3</pose><link name='l'>
    <inertial><mass>3</mass></inertial>
    <collision name='c'><geometry><box><size>0.5 0.5 0.5</size></box></geometry></collision>
  </link></model>
  <model name='barrel'><pose>-2 1 0.5 0 0 0</pose><link name='l'>
    <inertial><mass>3</mass></inertial>
    <collision name='c'><geometry><cylinder><radius>0.2</radius><length>1</length></cylinder>
    </geometry></collision></link></model>
</world></sdf>)";

class WorldSavingTest : public testing::Test {
 protected:
  std::shared_ptr<Simulation> Open(const std::filesystem::path& file) {
    base::Problems problems;
    auto world = library_.ReadWorld(file, problems);
    if (!world) {
      ADD_FAILURE() << world.error().Sentence();
      return nullptr;
    }
    simulation::Specification specification;
    specification.world = std::make_shared<const model::WorldDescription>(*std::move(world));
    specification.mode = simulation::Mode::kLockstep;
    specification.step = 2ms;
    auto made = Simulation::Create(specification, sensors_);
    EXPECT_TRUE(made) << (made ? "" : made.error().Sentence());
    return made.value_or(nullptr);
  }

  std::shared_ptr<const model::Model> Model(const std::string& name) {
    base::Problems problems;
    return library_.ReadModel(name, problems).value_or(nullptr);
  }

  static std::string HashAfter(Simulation& simulation, int steps) {
    EXPECT_TRUE(simulation.Step(steps));
    EXPECT_EQ(simulation.WaitForPhase({Phase::kPaused}, 20s), Phase::kPaused);
    return simulation.state_hash();
  }

  base::testing::TestFolder folder_;
  formats::ModelLibrary library_;
  std::shared_ptr<const sensing::SensorRegistry> sensors_ = [] {
    const auto registry = std::make_shared<sensing::SensorRegistry>();
    sensing::AddBuiltInSensors(*registry);
    return registry;
  }();
};

TEST_F(WorldSavingTest, SavedWorldSimulatesToTheSameHash) {
  const auto edited = Open(folder_.Write("room.sdf", kWorld));
  ASSERT_NE(edited, nullptr);
  ASSERT_TRUE(edited->PlaceBody(
      "crate", {{0.5, 0.5, 1.5}, geometry::FromRollPitchYaw({0.4, 0.2, -1})}, false));
  ASSERT_TRUE(edited->RemoveObject("barrel"));
  ASSERT_TRUE(edited->AddObject({.name = "",
                                 .model = Model("shape:box?size=0.4,0.4,0.4&mass=8"),
                                 .copy_of = "",
                                 .world_from_object = geometry::PlanarPose(2, 2, 0, 0.7)}));
  ASSERT_TRUE(edited->AddObject({.name = "second",
                                 .model = nullptr,
                                 .copy_of = "crate",
                                 .world_from_object = geometry::PlanarPose(-2, 2, 0, 0.2)}));
  const auto saved = SaveWorld(*edited, "again.sdf", {});
  ASSERT_TRUE(saved) << saved.error().Sentence();
  EXPECT_THAT(saved->warnings, testing::IsEmpty());
  const auto again = Open(folder_.Write("again.sdf", saved->sdf));
  ASSERT_NE(again, nullptr);
  const auto& before = edited->snapshot()->layout->bodies;
  const auto& after = again->snapshot()->layout->bodies;
  ASSERT_EQ(after.size(), before.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(after[i].name, before[i].name);
    EXPECT_EQ(after[i].kind, before[i].kind);
    EXPECT_EQ(after[i].initial_pose, before[i].initial_pose) << before[i].name;
  }
  EXPECT_EQ(again->state_hash(), edited->state_hash());
  EXPECT_EQ(HashAfter(*again, 500), HashAfter(*edited, 500));  // the crate falls and tumbles
}

TEST_F(WorldSavingTest, ScenarioNamesTheWorldAndAddsWhatSdformatCannotExpress) {
  const auto simulation = Open(folder_.Write("room.sdf", kWorld));
  ASSERT_NE(simulation, nullptr);
  simulation::RobotSpecification avatar;
  avatar.name = "me";
  avatar.model = Model("avatar");
  ASSERT_NE(avatar.model, nullptr);
  avatar.world_from_robot = geometry::PlanarPose(0, -2, 0, 0.5);
  avatar.is_avatar = true;
  ASSERT_TRUE(simulation->AddRobot(avatar));
  const auto saved = SaveWorld(*simulation, "again.sdf", {});
  ASSERT_TRUE(saved) << saved.error().Sentence();
  EXPECT_THAT(saved->sdf, testing::Not(testing::HasSubstr("\"me\"")));
  EXPECT_THAT(saved->warnings, testing::ElementsAre(testing::HasSubstr("in the scenario only")));
  base::Problems problems;
  const auto scenario = scenario::ParseScenario(saved->scenario, "s.yaml", problems);
  ASSERT_TRUE(scenario) << scenario.error().Sentence();
  EXPECT_TRUE(problems.empty());
  EXPECT_EQ(scenario->world, "again.sdf");
  ASSERT_EQ(scenario->avatars.size(), 1u);
  EXPECT_EQ(scenario->avatars[0].start->x, 0);
  EXPECT_EQ(scenario->avatars[0].start->y, -2);
}

}  // namespace
}  // namespace gsv::app
