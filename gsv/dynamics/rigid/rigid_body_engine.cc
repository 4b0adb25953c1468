#include "gsv/dynamics/rigid/rigid_body_engine.h"

#include "gsv/dynamics/rigid/resting_state.h"
#include "gsv/dynamics/rigid/rigid_step.h"

namespace gsv::dynamics {
namespace {

class RigidBodyEngine final : public RigidEngine {
 public:
  explicit RigidBodyEngine(std::shared_ptr<base::ThreadTeam> team) : team_(std::move(team)) {}

  base::Status SetLayout(std::shared_ptr<const world::Layout> layout) override {
    resting_.Forget();
    if (auto ok = scene_.SetLayout(std::move(layout)); !ok) return ok;
    if (!has_bodies()) return {};
    if (step_ == nullptr) step_ = std::make_unique<RigidStep>(team_.get());
    step_->SetScene(scene_);
    return {};
  }

  bool has_bodies() const override { return scene_.has_bodies(); }

  void Step(base::SimTime step, const world::State& before, std::span<Push> pushes,
            world::State& state, std::vector<world::Contact>& contacts) override {
    const double seconds = base::ToSeconds(step);
    // While all bodies are at rest, the contacts of the last step apply.
    if (!pushes.empty() || !resting_.Holds(scene_, before, state, seconds)) {
      contacts_.Clear();
      step_->Run(before, state, seconds, pushes, contacts_);
      step_->Store(state);
      resting_.Remember(scene_, before, state, seconds, step_->MakeAreas());
    }
    contacts_.Store(contacts);
  }

  std::vector<world::Contact> OverlapsOf(const world::State& state, int body,
                                         double tolerance) override {
    return step_->OverlapsOf(state, body, tolerance);
  }

 private:
  std::shared_ptr<base::ThreadTeam> team_;  // may be null
  RigidScene scene_;
  std::unique_ptr<RigidStep> step_;  // created when there are rigid bodies
  RigidContacts contacts_;
  RestingState resting_;
};

}  // namespace

std::unique_ptr<RigidEngine> MakeRigidEngine(std::shared_ptr<base::ThreadTeam> team) {
  return std::make_unique<RigidBodyEngine>(std::move(team));
}

}  // namespace gsv::dynamics
