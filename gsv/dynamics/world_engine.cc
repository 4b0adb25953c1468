#include "gsv/dynamics/world_engine.h"

#include <algorithm>
#include <tuple>

#include "gsv/base/check.h"
#include "gsv/dynamics/motion/attached_layout.h"
#include "gsv/dynamics/motion/joint_control.h"
#include "gsv/dynamics/people/actor_mover.h"
#include "gsv/dynamics/people/crowd.h"
#include "gsv/dynamics/planar/planar_joints.h"
#include "gsv/dynamics/planar/planar_mover.h"
#include "gsv/dynamics/planar/planar_pushes.h"
#include "gsv/dynamics/rigid/rigid_body_engine.h"

namespace gsv::dynamics {
namespace {

class WorldEngine final : public Engine {
 public:
  WorldEngine(std::shared_ptr<base::ThreadTeam> team, std::unique_ptr<RigidEngine> rigid)
      : crowd_(team), planar_(MakePlanarMover(team)), rigid_(std::move(rigid)) {}

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
    crowd_.Decide(step, state);
    if (rigid_->has_bodies()) {
      IntegrateErrors(*layout_, base::ToSeconds(step), state);
      MoveAll(step, state, contacts);
    } else {
      actors_.Move(step, state, nullptr);
      planar_->Step(step, state, contacts);
    }
    if (has_followers_ || !state.joint_commands.empty()) {
      MovePlanarJoints(*layout_, base::ToSeconds(step), state);
    }
  }

  bool StepMany(base::SimTime step, int count, world::State& state,
                std::vector<world::Contact>& contacts, MotionFollower& follower) override {
    UseAttachments();
    if (rigid_->has_bodies() || has_people_ || has_followers_ || !state.joint_commands.empty()) {
      return false;
    }
    return planar_->StepMany(step, count, state, contacts, follower);
  }

  std::vector<world::Contact> Overlaps(const world::State& state, double tolerance) override {
    UseAttachments();
    return planar_->Overlaps(state, tolerance);
  }

  std::vector<world::Contact> OverlapsOf(const world::State& state, int body,
                                         double tolerance) override {
    UseAttachments();
    std::vector<world::Contact> contacts = planar_->OverlapsOf(state, body, tolerance);
    if (layout_->bodies[body].is_robot() || !rigid_->has_bodies()) return contacts;
    const std::vector<world::Contact> further = rigid_->OverlapsOf(state, body, tolerance);
    contacts.insert(contacts.end(), further.begin(), further.end());
    return contacts;
  }

 private:
  base::Status UseLayout(std::shared_ptr<const world::Layout> layout) {
    if (auto ok = planar_->SetLayout(layout); !ok) return ok;
    layout_ = layout;
    has_people_ = std::any_of(layout->bodies.begin(), layout->bodies.end(), [](const auto& body) {
      return body.is_actor() || body.is_pedestrian();
    });
    has_followers_ =
        std::any_of(layout->bodies.begin(), layout->bodies.end(), [](const world::Body& body) {
          const auto& joints = body.model->joints;
          return body.is_planar() &&
                 std::any_of(joints.begin(), joints.end(),
                             [](const model::Joint& joint) { return joint.mimic.has_value(); });
        });
    actors_.SetLayout(layout);
    crowd_.SetLayout(layout);
    if (auto ok = pushes_.SetLayout(layout); !ok) return ok;
    return rigid_->SetLayout(std::move(layout));
  }

  void UseAttachments() {
    // Every attached body was accepted before, so this cannot fail.
    if (auto layout = attached_.TakeChanged()) GSV_CHECK(UseLayout(std::move(layout)));
  }

  // Actors move first, because nothing stops them. Then planar bodies move, with the rigid bodies
  // as static obstacles. Then rigid bodies move. A planar body that a rigid body has stopped pushes
  // it. If there are such pushes, all planar bodies go back to the start of the step and move
  // again, with the rigid bodies at their new poses.
  void MoveAll(base::SimTime step, world::State& state, std::vector<world::Contact>& contacts) {
    before_ = state;
    actors_.Move(step, state, &before_);
    planar_->Step(step, state, contacts);
    const std::span<Push> pushes = pushes_.Find(step, before_, state, contacts);
    rigid_->Step(step, before_, pushes, state, rigid_contacts_);
    if (!pushes.empty()) {
      PutPlanarBack(state);
      planar_->Step(step, state, contacts);
      pushes_.LimitSpeeds(step, before_, state);
      pushes_.SetImpulses(contacts);
    }
    AddRigidContacts(state, contacts);
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

  // Adds the contacts of the rigid bodies to the contacts of the planar bodies. Updates in_contact
  // and the count of collisions of each rigid body.
  void AddRigidContacts(world::State& state, std::vector<world::Contact>& contacts) const {
    contacts.insert(contacts.end(), rigid_contacts_.begin(), rigid_contacts_.end());
    for (std::size_t i = 0; i < layout_->bodies.size(); ++i) {
      if (layout_->bodies[i].is_rigid()) state.bodies[i].in_contact = false;
    }
    for (world::Contact& contact : contacts) {
      if (contact.supports) continue;
      for (const int index : {contact.first, contact.second}) {
        if (!layout_->bodies[index].is_rigid()) continue;
        world::BodyState& body = state.bodies[index];
        contact.began = contact.began || !before_.bodies[index].in_contact;
        if (contact.began) ++body.collisions;
        body.in_contact = true;
      }
    }
    std::sort(contacts.begin(), contacts.end(), [](const auto& a, const auto& b) {
      return std::tie(a.first, a.second, a.supports) < std::tie(b.first, b.second, b.supports);
    });
  }

  AttachedLayout attached_;
  std::shared_ptr<const world::Layout> layout_;  // the layout with the attached bodies
  bool has_people_ = false;                      // whether there are actors or pedestrians
  bool has_followers_ = false;                   // whether a planar robot has a mimic joint
  ActorMover actors_;
  Crowd crowd_;
  std::unique_ptr<PlanarMover> planar_;
  std::unique_ptr<RigidEngine> rigid_;
  PlanarPushes pushes_;
  world::State before_;
  std::vector<world::Contact> rigid_contacts_;
};

}  // namespace

std::unique_ptr<Engine> MakeWorldEngine(std::shared_ptr<base::ThreadTeam> team,
                                        std::unique_ptr<RigidEngine> rigid) {
  if (team == nullptr) team = std::make_shared<base::ThreadTeam>(1);
  if (rigid == nullptr) rigid = MakeRigidEngine(team);
  return std::make_unique<WorldEngine>(std::move(team), std::move(rigid));
}

}  // namespace gsv::dynamics
