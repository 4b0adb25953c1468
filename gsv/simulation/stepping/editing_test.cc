// Tests that objects are added, removed and rotated while the simulation is paused, and that the
// same edits can be repeated in another run.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "gsv/simulation/testing/test_simulation.h"

namespace gsv::simulation {
namespace {

using geometry::Vector3;

std::shared_ptr<const model::Model> Crate(double size = 0.4, bool is_static = false) {
  auto model = std::make_shared<model::Model>();
  model->name = "crate";
  model->is_static = is_static;
  model->links.resize(1);
  model->links[0].collisions.push_back({"box", {}, geometry::Box{{size, size, size}}, {}});
  return model;
}

// A world with a floor, a wall of 0.2 m thickness in the plane x = 3, and a crate at (0, -2).
Specification Room(SimTime duration) {
  Specification specification = Lockstep(duration);
  auto world = std::make_shared<model::WorldDescription>(*specification.world);
  auto floor = std::make_shared<model::Model>();
  floor->name = "floor";
  floor->is_static = true;
  floor->links.resize(1);
  floor->links[0].collisions.push_back({"plane", {}, geometry::Plane{}, {}});
  world->models.push_back({"floor", floor, {}, true});
  world->models.push_back({"crate", Crate(), PlanarPose(0, -2, 0.2, 0), false});
  specification.world = world;
  return specification;
}

ObjectSpecification Thing(std::shared_ptr<const model::Model> model, double x, double y,
                          std::string name = {}) {
  ObjectSpecification object;
  object.name = std::move(name);
  object.model = std::move(model);
  object.world_from_object = PlanarPose(x, y, 0, 0);
  return object;
}

int Find(const Simulation& simulation, const std::string& name) {
  return simulation.snapshot()->layout->Find(name);
}

void PauseAt(Simulation& simulation, SimTime instant) {
  ASSERT_TRUE(simulation.RunUntil(instant));
  ASSERT_EQ(simulation.WaitForPhase({Phase::kPaused}, kTimeout), Phase::kPaused);
}

void PauseThrough(Simulation& simulation, SimTime instant) {
  ASSERT_TRUE(simulation.RunThrough(instant));
  ASSERT_EQ(simulation.WaitForPhase({Phase::kPaused}, kTimeout), Phase::kPaused);
}

std::vector<Edit> EditsOf(const Simulation& simulation) {
  std::vector<Edit> edits;
  for (const Event& event : simulation.events(0)) {
    if (event.edit != nullptr) edits.push_back(*event.edit);
  }
  return edits;
}

TEST(Editing, AddedObjectIsPlacedOnTheFloorWithAFreeName) {
  auto simulation = Make(Room(0s));
  const auto name = simulation->AddObject(Thing(Crate(0.6), 1, 1));
  ASSERT_TRUE(name) << name.error().Sentence();
  EXPECT_EQ(*name, "crate_2");
  EXPECT_NEAR(PoseOf(*simulation, *name).position.z, 0.3, 1e-6);
  EXPECT_EQ(EditsOf(*simulation).back().kind, Edit::Kind::kAddObject);
}

TEST(Editing, AnObjectPlacedInTheAirFalls) {
  auto simulation = Make(Room(2s));
  ObjectSpecification crate = Thing(Crate(), 0, 0, "high");
  crate.world_from_object.position.z = 1.2;
  crate.on_ground = false;
  ASSERT_TRUE(simulation->AddObject(crate));
  PauseAt(*simulation, 300ms);
  // The object falls freely. The tolerance allows for steps of up to a millisecond.
  EXPECT_NEAR(PoseOf(*simulation, "high").position.z, 1.2 - 9.8 * 0.3 * 0.3 / 2, 9.8 * 0.3 * 1e-3);
  ASSERT_TRUE(simulation->Resume());
  ASSERT_EQ(simulation->WaitForPhase({Phase::kFinished}, kTimeout), Phase::kFinished);
  EXPECT_NEAR(PoseOf(*simulation, "high").position.z, 0.2, 1e-3);
}

TEST(Editing, RotatedObjectIsPlacedOnItsLowestPoint) {
  auto simulation = Make(Room(0s));
  geometry::Pose tilted = PlanarPose(0, -2, 0, 0);
  tilted.orientation = geometry::FromAxisAngle({1, 0, 0}, std::numbers::pi / 4);
  ASSERT_TRUE(simulation->PlaceBody("crate", tilted, true));
  EXPECT_NEAR(PoseOf(*simulation, "crate").position.z, 0.2 * std::numbers::sqrt2, 1e-6);
}

TEST(Editing, RemovedObjectCanBeRestored) {
  auto simulation = Make(Room(1s));
  PauseAt(*simulation, 100ms);
  ASSERT_TRUE(simulation->RemoveObject("crate"));
  EXPECT_EQ(Find(*simulation, "crate"), -1);
  ObjectSpecification again;
  again.name = "crate";
  again.copy_of = "crate";
  again.world_from_object = PlanarPose(0, 2, 0, 0);
  ASSERT_TRUE(simulation->AddObject(again));
  EXPECT_GE(Find(*simulation, "crate"), 0);
  ASSERT_TRUE(simulation->Resume());
  ASSERT_EQ(simulation->WaitForPhase({Phase::kFinished}, kTimeout), Phase::kFinished);
  EXPECT_NEAR(PoseOf(*simulation, "crate").position.y, 2, 1e-6);
}

TEST(Editing, AStaticObjectThatWasAddedCanBeMovedAndRemoved) {
  auto simulation = Make(Room(0s));
  ASSERT_TRUE(simulation->AddObject(Thing(Crate(0.5, true), 1, 1, "shelf")));
  ASSERT_TRUE(simulation->PlaceBody("shelf", PlanarPose(1, -1, 0, 0), true));
  EXPECT_NEAR(PoseOf(*simulation, "shelf").position.y, -1, 1e-12);
  // At the object's new place there is not enough space for a robot. At its old place there is.
  EXPECT_FALSE(simulation->AddRobot(Robot("robot", 1, -1)));
  EXPECT_TRUE(simulation->AddRobot(Robot("robot", 1, 1)));
  EXPECT_TRUE(simulation->RemoveObject("shelf"));
  EXPECT_FALSE(simulation->RemoveObject("wall"));
}

TEST(Editing, OverlappingObjectIsRejected) {
  auto simulation = Make(Room(0s));
  ASSERT_TRUE(simulation->AddRobot(Robot("robot", 1, 1)));
  const auto refusal = [&](double x, double y) {
    const auto added = simulation->AddObject(Thing(Crate(), x, y, "new"));
    return added ? "" : added.error().Sentence();
  };
  EXPECT_NE(refusal(3, 0).find("there is no room at (3, 0): it would overlap \"wall\""),
            std::string::npos);
  EXPECT_NE(refusal(0.1, -2).find("\"crate\""), std::string::npos);
  EXPECT_NE(refusal(1.1, 1).find("\"robot\""), std::string::npos);
  EXPECT_EQ(Find(*simulation, "new"), -1);
  EXPECT_FALSE(simulation->PlaceBody("crate", PlanarPose(3, 0, 0, 0), true));
  EXPECT_FALSE(simulation->AddObject(Thing(Crate(0.5, true), 0.1, -2, "new")));
  // The objects touch side by side, and this is allowed.
  EXPECT_EQ(refusal(0.4, -2), "");
}

TEST(Editing, ImpossibleEditIsRejectedWithASentence) {
  auto simulation = Make(Room(0s));
  const auto refusal = [&](ObjectSpecification object) {
    const auto added = simulation->AddObject(std::move(object));
    return added ? "" : added.error().Sentence();
  };
  EXPECT_NE(refusal(Thing(Crate(), 1, 1, "crate")).find("there is already"), std::string::npos);
  EXPECT_NE(refusal(Thing(Crate(), 1, 1, "a/b")).find("no \"/\""), std::string::npos);
  EXPECT_NE(refusal(Thing(Disc(0.2), 1, 1)).find("as a robot"), std::string::npos);
  EXPECT_NE(refusal(Thing(Crate(), 1 / 0.0, 1)).find("not finite"), std::string::npos);
  ObjectSpecification copy = Thing(nullptr, 1, 1);
  copy.copy_of = "unicorn";
  EXPECT_NE(refusal(copy).find("unicorn"), std::string::npos);
  ASSERT_TRUE(simulation->Start());
  const auto running = simulation->AddObject(Thing(Crate(), 1, 1));
  ASSERT_FALSE(running);
  EXPECT_EQ(running.error().code, base::ErrorCode::kNotRunning);
  EXPECT_EQ(simulation->RemoveObject("crate").error().code, base::ErrorCode::kNotRunning);
  EXPECT_TRUE(simulation->Stop());
}

TEST(Editing, RunThroughTakesTheTurnsOfItsInstantWithoutAStep) {
  auto simulation = Make(Lockstep(1s));
  std::atomic<int> turns = 0;
  const auto counts = std::make_shared<ThreadBehaviour>([&](Agent& agent, ClockId clock) {
    do ++turns;
    while (SleepFor(agent, clock, 100ms));
  });
  ASSERT_TRUE(simulation->AddRobot(Robot("robot", 0, 0, counts)));
  PauseThrough(*simulation, 0ms);
  EXPECT_EQ(turns, 1);
  EXPECT_EQ(simulation->status().step, 0);
  PauseAt(*simulation, 100ms);
  EXPECT_EQ(turns, 1);
  PauseThrough(*simulation, 100ms);
  EXPECT_EQ(turns, 2);
  EXPECT_EQ(simulation->status().step, 10);
  EXPECT_FALSE(simulation->RunThrough(50ms));
  EXPECT_TRUE(simulation->Stop());
}

TEST(Editing, RecordsWhetherAllBehavioursHadTheirTurnBeforeTheEdit) {
  auto simulation = Make(Room(1s));
  ASSERT_TRUE(simulation->AddRobot(Robot("robot", 0, 0, Drives(0.1))));
  EXPECT_FALSE(simulation->was_edited());
  PauseAt(*simulation, 100ms);
  ASSERT_TRUE(simulation->RemoveObject("crate"));
  EXPECT_TRUE(simulation->was_edited());
  PauseThrough(*simulation, 100ms);
  ASSERT_TRUE(simulation->PlaceBody("robot", PlanarPose(1, 1, 0, 0), true));
  const std::vector<Edit> edits = EditsOf(*simulation);
  ASSERT_EQ(edits.size(), 3u);
  EXPECT_EQ(edits[0].behaviour, "test");
  EXPECT_EQ(edits[1].moment, Edit::Moment::kBeforeTurns);
  EXPECT_EQ(edits[1].step, 10);
  EXPECT_EQ(edits[2].moment, Edit::Moment::kAfterTurns);
  EXPECT_EQ(edits[2].time, 100ms);
  EXPECT_TRUE(simulation->Stop());
}

// Returns the hash of a run with edits during two pauses. At the instant `first`, the agents have
// not had their turns yet. At the instant `second`, they have had them.
std::string HashOfAnEditedRun(SimTime first, SimTime second) {
  auto simulation = Make(Room(1s));
  EXPECT_TRUE(simulation->AddRobot(Robot("robot", 0, 0, Drives(0.3))));
  PauseAt(*simulation, first);
  EXPECT_TRUE(simulation->AddObject(Thing(Crate(0.2), 0.8, 0.05, "hurdle")));
  EXPECT_TRUE(simulation->AddRobot(Robot("late", 0, 1, Drives(0.2))));
  PauseThrough(*simulation, second);
  EXPECT_TRUE(simulation->PlaceBody("crate", PlanarPose(0.8, 1, 0, 0.4), true));
  EXPECT_TRUE(simulation->SetGravity(-3.7));
  EXPECT_TRUE(simulation->Resume());
  EXPECT_EQ(simulation->WaitForPhase({Phase::kFinished}, kTimeout), Phase::kFinished);
  return simulation->state_hash();
}

TEST(Editing, GravityAppliesFromTheInstantAtWhichItIsSet) {
  auto simulation = Make(Room(0s));
  ObjectSpecification crate = Thing(Crate(), 0, 0, "high");
  crate.world_from_object.position.z = 3;
  crate.on_ground = false;
  ASSERT_TRUE(simulation->AddObject(crate));
  ASSERT_TRUE(simulation->AddRobot(Robot("robot", 0, 1)));
  PauseAt(*simulation, 200ms);
  ASSERT_TRUE(simulation->SetGravity(-1.62));
  PauseAt(*simulation, 500ms);
  // The height is z0 + v0 t + g t² / 2 before and after the change, with steps of at most a
  // millisecond.
  const double then = 3 - 9.8 * 0.2 * 0.2 / 2;
  const double now = then - 9.8 * 0.2 * 0.3 - 1.62 * 0.3 * 0.3 / 2;
  EXPECT_NEAR(PoseOf(*simulation, "high").position.z, now, 9.8 * 0.5 * 1e-3);
  EXPECT_EQ(PoseOf(*simulation, "robot").position, (Vector3{0, 1, 0}));
  const Edit edit = EditsOf(*simulation).back();
  EXPECT_EQ(edit.kind, Edit::Kind::kCommand);
  EXPECT_EQ(edit.command, "set_gravity");
  EXPECT_EQ(edit.arguments, (std::map<std::string, std::string>{{"z", "-1.62"}}));
  EXPECT_EQ(edit.time, 200ms);
  EXPECT_TRUE(simulation->was_edited());
}

TEST(Editing, ChangedGravityIsPartOfTheHash) {
  auto simulation = Make(Room(0s));
  const std::string own = simulation->state_hash();
  ASSERT_TRUE(simulation->SetGravity(-1.62));
  const std::string moon = simulation->state_hash();
  EXPECT_NE(moon, own);
  ASSERT_TRUE(simulation->SetGravity(-9.8));
  EXPECT_EQ(simulation->state_hash(), own);
  ASSERT_TRUE(simulation->SetGravity(-1.62));
  ASSERT_TRUE(simulation->Reset());
  EXPECT_EQ(simulation->state_hash(), moon);
  ASSERT_TRUE(simulation->SetGravity(std::nullopt));
  EXPECT_EQ(simulation->state_hash(), own);
  EXPECT_FALSE(simulation->SetGravity(std::nan("")));
}

TEST(Editing, GravityIsNotSetWhileTheSimulationRuns) {
  auto simulation = Make(Room(0s));
  ASSERT_TRUE(simulation->Start());
  const base::Status refused = simulation->SetGravity(-1.62);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, base::ErrorCode::kNotRunning);
  EXPECT_TRUE(simulation->Stop());
}

TEST(Editing, TheSameEditsAtTheSameStepsGiveTheSameHash) {
  const std::string once = HashOfAnEditedRun(200ms, 600ms);
  EXPECT_EQ(once, HashOfAnEditedRun(200ms, 600ms));
  EXPECT_NE(once, HashOfAnEditedRun(210ms, 600ms));
}

}  // namespace
}  // namespace gsv::simulation
