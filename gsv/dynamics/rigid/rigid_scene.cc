#include "gsv/dynamics/rigid/rigid_scene.h"

#include <algorithm>

namespace gsv::dynamics {
namespace {

using geometry::Pose;

void SetKind(Piece& piece) {
  const btCollisionShape& shape = *piece.shape;
  switch (shape.getShapeType()) {
    case SPHERE_SHAPE_PROXYTYPE: {
      const double radius = static_cast<const btSphereShape&>(shape).getRadius();
      piece.kind = Piece::Kind::kSphere;
      piece.half = {radius, radius, 0};
      break;
    }
    case BOX_SHAPE_PROXYTYPE:
      piece.kind = Piece::Kind::kBox;
      piece.half = FromBullet(static_cast<const btBoxShape&>(shape).getHalfExtentsWithMargin());
      break;
    case CYLINDER_SHAPE_PROXYTYPE:
      piece.kind = Piece::Kind::kCylinder;
      piece.half =
          FromBullet(static_cast<const btCylinderShape&>(shape).getHalfExtentsWithMargin());
      break;
    case CAPSULE_SHAPE_PROXYTYPE: {
      const auto& capsule = static_cast<const btCapsuleShape&>(shape);
      piece.kind = Piece::Kind::kCapsule;
      piece.half = {capsule.getRadius(), capsule.getRadius(), capsule.getHalfHeight()};
      break;
    }
    case STATIC_PLANE_PROXYTYPE:
      piece.kind = Piece::Kind::kPlane;
      piece.normal = FromBullet(static_cast<const btStaticPlaneShape&>(shape).getPlaneNormal());
      break;
    case TRIANGLE_MESH_SHAPE_PROXYTYPE:
      piece.kind = Piece::Kind::kMesh;
      piece.triangles = static_cast<const TriangleSurface*>(shape.getUserPointer());
      break;
    default:
      break;
  }
}

class SolidBuilder {
 public:
  explicit SolidBuilder(int body) { solid_.body = body; }

  void Add(const Pose& solid_from_piece, btCollisionShape* shape, const model::Surface& surface) {
    Piece& piece = solid_.pieces.emplace_back();
    piece.solid_from_piece = solid_from_piece;
    piece.rotation = MatrixOf(solid_from_piece.orientation);
    piece.shape = shape;
    piece.surface = surface;
    SetKind(piece);
    // A plane is unbounded.
    if (piece.kind == Piece::Kind::kPlane) return;
    btVector3 low, high;
    shape->getAabb(btTransform::getIdentity(), low, high);
    piece.middle = FromBullet((low + high) / 2);
    piece.box = FromBullet((high - low) / 2);
    solid_.thickness = std::min({solid_.thickness, piece.box.x, piece.box.y, piece.box.z});
    btVector3 centre;
    btScalar radius = 0;
    shape->getBoundingSphere(centre, radius);
    solid_.radius =
        std::max<double>(solid_.radius, Norm(solid_from_piece * FromBullet(centre)) + radius);
  }

  Solid Finish() { return std::move(solid_); }

 private:
  Solid solid_;
};

Solid SolidOf(const Part& part, const model::Model& model, int body, RigidShapes& shapes) {
  SolidBuilder builder(body);
  const Pose part_from_model = Inverse(part.model_from_part);
  for (const int l : part.links) {
    for (const model::Collision& collision : model.links[l].collisions) {
      const Pose pose =
          part_from_model * model.links[l].model_from_link * collision.link_from_collision;
      for (btCollisionShape* shape : shapes.Moving(collision.shape)) {
        builder.Add(pose, shape, collision.surface);
      }
    }
  }
  return builder.Finish();
}

}  // namespace

bool Solid::bounces() const {
  return std::any_of(pieces.begin(), pieces.end(),
                     [](const Piece& piece) { return piece.surface.restitution > 0; });
}

bool IsNear(const Solid& planar, const world::State& before, const world::State& after,
            const std::vector<Area>& areas) {
  if (planar.pieces.empty()) return false;
  const geometry::Vector3& at = before.bodies[planar.body].world_from_model.position;
  const geometry::Vector3& to = after.bodies[planar.body].world_from_model.position;
  const double reach = planar.radius;
  return std::any_of(areas.begin(), areas.end(), [&](const Area& area) {
    return std::max(at.x, to.x) + reach > area.low.x &&
           std::min(at.x, to.x) - reach < area.high.x &&
           std::max(at.y, to.y) + reach > area.low.y && std::min(at.y, to.y) - reach < area.high.y;
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
  SolidBuilder builder(index);
  for (const model::Link& link : model.links) {
    for (const model::Collision& collision : link.collisions) {
      const Pose pose = link.model_from_link * collision.link_from_collision;
      btCollisionShape* shape = shapes_.Standing(collision.shape);
      if (shape != nullptr) builder.Add(pose, shape, collision.surface);
    }
  }
  if (Solid solid = builder.Finish(); !solid.pieces.empty()) {
    standing_.push_back(std::move(solid));
  }
}

void RigidScene::AddPlanar(int index) {
  const world::Body& body = layout_->bodies[index];
  const Footprint footprint = MakeFootprint(*body.model, {});
  const double climb = footprint.heights.low + ClimbHeight(*body.model, footprint);
  SolidBuilder builder(index);
  for (const Footprint::Piece& piece : footprint.pieces) {
    const double low = std::max(piece.heights.low, climb);
    if (!(piece.heights.high > low)) continue;
    Pose model_from_shape;
    btCollisionShape* shape = shapes_.Prism(piece, low, model_from_shape);
    if (shape == nullptr) continue;
    model::Surface surface;
    surface.filter = piece.filter;
    builder.Add(model_from_shape, shape, surface);
  }
  planar_.push_back(builder.Finish());
}

void RigidScene::AddActor(int index) {
  SolidBuilder builder(index);
  for (const model::Link& link : layout_->bodies[index].model->links) {
    for (const model::Collision& collision : link.collisions) {
      const Pose pose = link.model_from_link * collision.link_from_collision;
      for (btCollisionShape* shape : shapes_.Moving(collision.shape)) {
        builder.Add(pose, shape, collision.surface);
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
