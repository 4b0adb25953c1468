#include "gsv/dynamics/world_engine.h"

#include <algorithm>

#include "gsv/base/check.h"
#include "gsv/dynamics/motion/attached_layout.h"
#include "gsv/dynamics/planar/planar_joints.h"
#include "gsv/dynamics/planar/planar_mover.h"
#include "gsv/dynamics/rigid/rigid_engine.h"

namespace gsv::dynamics {
namespace {

class WorldEngine final : public Engine {
 public:
  explicit WorldEngine(std::shared_ptr<base::ThreadTeam> team)
      : planar_(MakePlanarMover(std::move(team))) {}

  base::Status SetLayout(std::shared_ptr<const world::Layout> layout) override {
    attached_.Reset(layout);
    return UseLayout(std::move(layout));
  }

  base::Status Attach(const Attachment& attachment, const world::State& state) override {
    return attached_.Attach(attachment, state);
  }

  void Detach(int held_body) override { attached_.Detach(held_body); }

  void Step(base::SimTime step, world::State& state,
            std::vector<world::Contact>& contacts) override {
    UseAttachments();
    MoveBodies(step, state, contacts);
    MovePlanarJoints(*layout_, base::ToSeconds(step), state);
  }

  std::vector<world::Contact> Overlaps(const world::State& state, double tolerance) override {
    UseAttachments();
    return planar_->Overlaps(state, tolerance);
  }

  std::vector<world::Contact> OverlapsOf(const world::State& state, int body,
                                         double tolerance) override {
    UseAttachments();
    std::vector<world::Contact> contacts = planar_->OverlapsOf(state, body, tolerance);
    if (layout_->bodies[body].is_robot()) return contacts;
    const std::vector<world::Contact> further = rigid_.OverlapsOf(state, body, tolerance);
    contacts.insert(contacts.end(), further.begin(), further.end());
    return contacts;
  }

 private:
  base::Status UseLayout(std::shared_ptr<const world::Layout> layout) {
    if (auto ok = planar_->SetLayout(layout); !ok) return ok;
    layout_ = layout;
    return rigid_.SetLayout(std::move(layout));
  }

  void UseAttachments() {
    // Both took the same bodies before.
    if (auto layout = attached_.TakeChanged()) GSV_CHECK(UseLayout(std::move(layout)));
  }

  void MoveBodies(base::SimTime step, world::State& state, std::vector<world::Contact>& contacts) {
    if (!rigid_.has_bodies()) {
      planar_->Step(step, state, contacts);
      return;
    }
    before_ = state;
    planar_->Step(step, state, contacts);
    if (rigid_.Move(step, before_, contacts, state)) {
      PutPlanarBack(state);
      planar_->Step(step, state, contacts);
      rigid_.GoOn(step, before_, state);
    }
    rigid_.AddContacts(before_, state, contacts);
  }

  void PutPlanarBack(world::State& state) const {
    for (std::size_t i = 0; i < layout_->bodies.size(); ++i) {
      const world::Body& body = layout_->bodies[i];
      if (!body.is_planar()) continue;
      state.bodies[i] = before_.bodies[i];
      const auto joints = static_cast<std::ptrdiff_t>(body.model->joints.size());
      const auto put_back = [&](const std::vector<double>& from, std::vector<double>& to) {
        std::copy_n(from.begin() + body.first_joint, joints, to.begin() + body.first_joint);
      };
      put_back(before_.joint_positions, state.joint_positions);
      put_back(before_.joint_velocities, state.joint_velocities);
    }
  }

  AttachedLayout attached_;
  std::shared_ptr<const world::Layout> layout_;  // with what is attached
  std::unique_ptr<PlanarMover> planar_;
  RigidEngine rigid_;
  world::State before_;
};

}  // namespace

std::unique_ptr<Engine> MakeWorldEngine(std::shared_ptr<base::ThreadTeam> team) {
  return std::make_unique<WorldEngine>(std::move(team));
}

}  // namespace gsv::dynamics
