#include "gsv/simulation/stepping/stepping_simulation.h"

#include <future>

#include "gsv/dynamics/world_engine.h"
#include "gsv/simulation/testing/test_simulation.h"

namespace gsv::simulation {
namespace {

// Wraps the world's engine and calls a function before each new layout.
class ObservedEngine final : public dynamics::Engine {
 public:
  base::Status SetLayout(std::shared_ptr<const world::Layout> layout) override {
    if (before_layout) before_layout();
    return engine_->SetLayout(std::move(layout));
  }
  base::Status Attach(const dynamics::Attachment& attachment, const world::State& state) override {
    return engine_->Attach(attachment, state);
  }
  void Detach(int held_body) override { engine_->Detach(held_body); }
  void Step(base::SimTime step, world::State& state,
            std::vector<world::Contact>& contacts) override {
    engine_->Step(step, state, contacts);
  }
  std::vector<world::Contact> Overlaps(const world::State& state, double tolerance) override {
    return engine_->Overlaps(state, tolerance);
  }
  std::vector<world::Contact> OverlapsOf(const world::State& state, int body,
                                         double tolerance) override {
    return engine_->OverlapsOf(state, body, tolerance);
  }

  std::function<void()> before_layout;

 private:
  const std::unique_ptr<dynamics::Engine> engine_ = dynamics::MakeWorldEngine();
};

TEST(SteppingSimulation, AnswersAgentsWhileItsEngineLoadsALayout) {
  Specification specification = Lockstep(0s);
  specification.step = 10ms;
  auto layout = world::MakeLayout(1, {}, specification.world);
  auto owned = std::make_unique<ObservedEngine>();
  ObservedEngine& engine = *owned;
  ASSERT_TRUE(engine.SetLayout(layout));
  auto sensors = std::make_shared<sensing::SensorRegistry>();
  sensing::AddBuiltInSensors(*sensors);
  SteppingSimulation simulation(std::move(specification), std::move(sensors),
                                std::make_shared<base::ThreadTeam>(1), std::move(owned),
                                std::move(layout));
  ASSERT_TRUE(simulation.AddRobot(Robot("stays", 0, 0)));
  ASSERT_TRUE(simulation.AddRobot(Robot("goes", 1, 0)));
  const auto agent = simulation.agent("stays");
  int answers = 0;
  engine.before_layout = [&] {
    auto now = std::async(std::launch::async, [&] { return agent->Now(); });
    EXPECT_EQ(now.wait_for(kTimeout), std::future_status::ready);
    ++answers;
  };
  ASSERT_TRUE(simulation.RemoveRobot("goes"));
  EXPECT_GT(std::exchange(answers, 0), 0);
  ASSERT_TRUE(simulation.AddRobot(Robot("comes", 1, 0)));
  EXPECT_GT(std::exchange(answers, 0), 0);
  ASSERT_TRUE(simulation.PlaceBody("comes", PlanarPose(2, 0, 0, 0), true));
  EXPECT_GT(answers, 0);
}

}  // namespace
}  // namespace gsv::simulation
