#include "gsv/dynamics/rigid/rigid_scene.h"

#include <algorithm>

#include "gsv/dynamics/rigid/shape_filter.h"

namespace gsv::dynamics {
namespace {

using geometry::Pose;

bool IsIdentity(const btTransform& transform) {
  constexpr double kRounding = 1e-14;
  const btMatrix3x3 &a = transform.getBasis(), &b = btMatrix3x3::getIdentity();
  return transform.getOrigin().length() < kRounding && (a[0] - b[0]).length() < kRounding &&
         (a[1] - b[1]).length() < kRounding && (a[2] - b[2]).length() < kRounding;
}

// Adds children to a compound and records their properties. A solid of one child needs no compound,
// which costs as much as its contacts.
class SolidBuilder {
 public:
  SolidBuilder(int body, btCompoundShape* compound) : compound_(compound) { solid_.body = body; }

  void Add(const btTransform& solid_from_shape, btCollisionShape* shape,
           const model::Surface& surface) {
    btVector3 low, high;
    shape->getAabb(btTransform::getIdentity(), low, high);
    const btVector3 half = (high - low) / 2;
    const double thickness = half[half.minAxis()];
    solid_.thickness = std::min(solid_.thickness, thickness);
    btVector3 centre;
    btScalar radius = 0;
    shape->getBoundingSphere(centre, radius);
    solid_.radius = std::max<double>(solid_.radius, (solid_from_shape * centre).length() + radius);
    compound_->addChildShape(solid_from_shape, shape);
    only_ = solid_.surfaces.empty() && IsIdentity(solid_from_shape) ? shape : nullptr;
    SetFilter(*shape, surface.filter);
    filter_ = Union(filter_, surface.filter);
    solid_.surfaces.push_back(surface);
  }

  Solid Finish() {
    SetFilter(*compound_, filter_);
    solid_.shape = only_ != nullptr ? only_ : compound_;
    return std::move(solid_);
  }

 private:
  btCompoundShape* compound_;
  btCollisionShape* only_ = nullptr;  // the only child, if it has the solid's frame
  model::CollisionFilter filter_ = model::kMeetsNothing;
  Solid solid_;
};

Solid SolidOf(const Part& part, const model::Model& model, int body, RigidShapes& shapes) {
  SolidBuilder builder(body, shapes.Compound());
  const Pose part_from_model = Inverse(part.model_from_part);
  for (const int l : part.links) {
    for (const model::Collision& collision : model.links[l].collisions) {
      const Pose pose =
          part_from_model * model.links[l].model_from_link * collision.link_from_collision;
      for (btCollisionShape* shape : shapes.Moving(collision.shape)) {
        builder.Add(ToBullet(pose), shape, collision.surface);
      }
    }
  }
  return builder.Finish();
}

}  // namespace

bool Solid::bounces() const {
  return std::any_of(surfaces.begin(), surfaces.end(),
                     [](const model::Surface& surface) { return surface.restitution > 0; });
}

bool IsNear(const Solid& planar, const world::State& before, const world::State& after,
            const std::vector<Area>& areas) {
  if (planar.surfaces.empty()) return false;
  const geometry::Vector3& at = before.bodies[planar.body].world_from_model.position;
  const geometry::Vector3& to = after.bodies[planar.body].world_from_model.position;
  const double reach = planar.radius;
  return std::any_of(areas.begin(), areas.end(), [&](const Area& area) {
    return std::max(at.x, to.x) + reach > area.low.x() &&
           std::min(at.x, to.x) - reach < area.high.x() &&
           std::max(at.y, to.y) + reach > area.low.y() &&
           std::min(at.y, to.y) - reach < area.high.y();
  });
}

base::Status RigidScene::AddRigid(int index) {
  const world::Body& body = layout_->bodies[index];
  RigidBody rigid;
  rigid.body = index;
  rigid.model = body.model.get();
  rigid.articulation = MakeArticulation(*body.model);
  rigid.first_joint = body.first_joint;
  for (const Part& part : rigid.articulation.parts) {
    rigid.solids.push_back(SolidOf(part, *body.model, index, shapes_));
    rigid.solids.back().wheel =
        WheelOf(*body.model, rigid.articulation, part, Norm(layout_->description->gravity));
  }
  if (body.model->drive && body.model->drive->kind != model::DriveKind::kNone) {
    auto kinematics = DriveKinematics::Create(*body.model);
    if (!kinematics) return base::Fail(kinematics.error());
    rigid.kinematics = *std::move(kinematics);
  }
  rigid.media = MakeMedium(*layout_, body, rigid.articulation);
  bodies_.push_back(std::move(rigid));
  return {};
}

void RigidScene::AddStanding(int index) {
  const model::Model& model = *layout_->bodies[index].model;
  SolidBuilder builder(index, shapes_.Compound());
  for (const model::Link& link : model.links) {
    for (const model::Collision& collision : link.collisions) {
      const Pose pose = link.model_from_link * collision.link_from_collision;
      btCollisionShape* shape = shapes_.Standing(collision.shape, collision.surface.filter);
      if (shape == nullptr) continue;
      if (std::holds_alternative<geometry::Plane>(collision.shape)) {
        // Without end, it would make a compound's tree useless.
        SetFilter(*shape, collision.surface.filter);
        standing_.push_back({{index, shape, {collision.surface}}, pose});
      } else {
        builder.Add(ToBullet(pose), shape, collision.surface);
      }
    }
  }
  if (Solid solid = builder.Finish(); !solid.surfaces.empty()) {
    standing_.push_back({std::move(solid), {}});
  }
}

void RigidScene::AddPlanar(int index) {
  const world::Body& body = layout_->bodies[index];
  const Footprint footprint = MakeFootprint(*body.model, {});
  const double climb = footprint.heights.low + ClimbHeight(*body.model, footprint);
  SolidBuilder builder(index, shapes_.Compound());
  for (const Footprint::Piece& piece : footprint.pieces) {
    const double low = std::max(piece.heights.low, climb);
    if (!(piece.heights.high > low)) continue;
    btTransform model_from_shape;
    btCollisionShape* shape = shapes_.Prism(piece, low, model_from_shape);
    if (shape == nullptr) continue;
    model::Surface surface;
    surface.filter = piece.filter;
    builder.Add(model_from_shape, shape, surface);
  }
  planar_.push_back(builder.Finish());
}

void RigidScene::AddActor(int index) {
  SolidBuilder builder(index, shapes_.Compound());
  for (const model::Link& link : layout_->bodies[index].model->links) {
    for (const model::Collision& collision : link.collisions) {
      const Pose pose = link.model_from_link * collision.link_from_collision;
      for (btCollisionShape* shape : shapes_.Moving(collision.shape)) {
        builder.Add(ToBullet(pose), shape, collision.surface);
      }
    }
  }
  planar_.push_back(builder.Finish());
}

base::Status RigidScene::SetLayout(std::shared_ptr<const world::Layout> layout) {
  layout_ = std::move(layout);
  bodies_.clear();
  standing_.clear();
  planar_.clear();
  shapes_.NextLayout();
  const auto& bodies = layout_->bodies;
  // Without rigid bodies, there is nothing to create.
  if (std::none_of(bodies.begin(), bodies.end(), [](const auto& body) { return body.is_rigid(); }))
    return {};
  for (int i = 0; i < static_cast<int>(bodies.size()); ++i) {
    if (bodies[i].is_rigid()) {
      if (auto ok = AddRigid(i); !ok) return ok;
    } else if (bodies[i].is_planar()) {
      AddPlanar(i);
    } else if (bodies[i].is_actor()) {
      AddActor(i);
    } else {
      AddStanding(i);
    }
  }
  return {};
}

}  // namespace gsv::dynamics
