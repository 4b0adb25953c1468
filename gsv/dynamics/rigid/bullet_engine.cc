#include "gsv/dynamics/rigid/bullet_engine.h"

#include <optional>

#include "gsv/dynamics/rigid/resting_state.h"
#include "gsv/dynamics/rigid/rigid_world.h"

namespace gsv::dynamics {
namespace {

class BulletEngine final : public RigidEngine {
 public:
  explicit BulletEngine(std::shared_ptr<base::ThreadTeam> team) : team_(std::move(team)) {}

  base::Status SetLayout(std::shared_ptr<const world::Layout> layout) override {
    resting_.Forget();
    if (auto ok = scene_.SetLayout(std::move(layout)); !ok) return ok;
    if (has_bodies() && !kit_) kit_.emplace(team_.get());
    return {};
  }

  bool has_bodies() const override { return scene_.has_bodies(); }

  void Step(base::SimTime step, const world::State& before, std::span<Push> pushes,
            world::State& state, std::vector<world::Contact>& contacts) override {
    const double seconds = base::ToSeconds(step);
    // While all rest, the contacts of the last step are those of this one.
    if (!pushes.empty() || !resting_.Holds(scene_, before, state, seconds)) {
      contacts_.Clear();
      RigidWorld world(*kit_, scene_, before, state, seconds);
      world.Run(pushes, contacts_);
      world.Store(state);
      resting_.Remember(scene_, before, state, seconds, world.MakeAreas());
    }
    contacts_.Store(contacts);
  }

  std::vector<world::Contact> OverlapsOf(const world::State& state, int body,
                                         double tolerance) override {
    return RigidWorld(*kit_, scene_, state, state, 0).OverlapsOf(body, tolerance);
  }

 private:
  std::shared_ptr<base::ThreadTeam> team_;  // may be null
  std::optional<BulletKit> kit_;            // made once there are rigid bodies
  RigidScene scene_;
  RigidContacts contacts_;
  RestingState resting_;
};

}  // namespace

std::unique_ptr<RigidEngine> MakeBulletEngine(std::shared_ptr<base::ThreadTeam> team) {
  return std::make_unique<BulletEngine>(std::move(team));
}

}  // namespace gsv::dynamics
