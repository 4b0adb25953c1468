// Finds the contacts of rigid bodies with each other and with all other bodies. Private to this
// folder: it includes Bullet.
//
// Broad phase   sort and sweep for rigid and planar bodies; for static bodies a BVH, which is kept
//               until a static body moves. Planes are tested one by one.
// Margin        contacts begin where two pieces may touch within a substep.
// Order         by the first body, the second body, and their pieces. Bodies far away do not change
//               the order.
// Determinism   Find() is a function of the bodies' poses, velocities and the substep.
#pragma once

#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "gsv/dynamics/rigid/bullet_pairs.h"
#include "gsv/dynamics/rigid/contact.h"
#include "gsv/dynamics/rigid/moving_body.h"
#include "gsv/dynamics/rigid/rigid_scene.h"
#include "gsv/dynamics/shapes/box_bvh.h"

namespace gsv::dynamics {

// A solid in the world: a part of a rigid body, a static body, or a planar body near rigid bodies.
struct Collider {
  const Solid* solid = nullptr;  // its shapes; never null
  int moving = -1, part = 0;     // index of the rigid body, and its part; -1: none
  bool bounces = false;          // whether its contacts have no margin, so that it bounces fully
  // Set only for planar bodies, in the world: position (m) and velocity (m/s) of the model's
  // origin, and angular velocity (rad/s).
  geometry::Vector3 position, velocity, angular_velocity;
};

// Finds the contacts of rigid bodies with each other and with all other bodies.
class ContactFinder {
 public:
  // Prepares for the bodies of a scene. `bodies` are in the order of scene.bodies().
  void SetScene(const RigidScene& scene, std::span<const std::unique_ptr<MovingBody>> bodies);

  // Reads the poses of the static bodies from the state, and removes all planar bodies.
  void Start(const world::State& state);
  // Adds a planar body for this step. Returns its index among the planar bodies.
  int AddPlanar(const Solid& solid);
  // Sets the pose and velocities of a planar body. `index` is the result of AddPlanar().
  void MovePlanar(int index, const geometry::Pose& pose, const geometry::Vector3& velocity,
                  const geometry::Vector3& angular_velocity);
  // Computes the poses of all pieces of the rigid bodies.
  void PlaceBodies();

  // Finds all contacts. The result is valid until the next call.
  std::vector<Contact>& Find(double substep);

  const Collider& collider(int index) const { return colliders_[static_cast<std::size_t>(index)]; }
  // Returns the velocity of a point of a collider, in the world.
  geometry::Vector3 VelocityOf(const Collider& collider, const geometry::Vector3& point) const;
  // Returns the contact's point in the frame of the first collider's part.
  geometry::Vector3 PointOnFirst(const Contact& contact) const;
  // Returns the bounding box of a rigid body.
  void Bounds(int moving, geometry::Vector3& low, geometry::Vector3& high) const;

 private:
  // All solids of one body. Their pieces are consecutive.
  struct Group {
    int moving = -1;                             // index of the rigid body, or -1 for a planar body
    int first_collider = 0, collider_count = 0;  // range in colliders_
    int first_piece = 0, piece_count = 0;        // range in pieces_
    geometry::Vector3 low, high;                 // bounding box in the world
    double reach = 0;  // maximum distance that the body may move in the substep, m
  };
  // A piece of a static body.
  struct StaticPiece {
    PlacedPiece placed;  // the piece at its pose in the world
    int collider = 0;    // index in colliders_
  };

  // Computes the poses of the static bodies.
  void PlaceStatic(const world::State& state);
  // Computes the poses of a group's pieces.
  void PlaceGroup(Group& group);
  // Adds the contacts between groups whose bounding boxes overlap, found by sort and sweep.
  void AddGroupPairs(double substep);
  // Adds the contacts between two groups.
  void AddGroupPair(const Group& a, const Group& b);
  // Adds the contacts of a group with static bodies.
  void AddStaticPairs(const Group& group);
  // Adds the contacts of two pieces.
  void AddPair(int first, const PlacedPiece& first_piece, int second,
               const PlacedPiece& second_piece, double margin);
  // Returns the collider as a wheel that slips on this ground, or nullopt if it does not slip.
  std::optional<SlippingContact> SlippingOf(const Collider& collider, const model::Surface& ground,
                                            const geometry::Vector3& normal) const;
  // Converts the slip of each contact to the softness of its friction in this substep.
  void SetSoftness(double substep);
  // Whether a base without wheels rests on the other body, so that there is no friction.
  bool GlidesOn(const Collider& first, const Collider& second,
                const geometry::Vector3& normal) const;

  const RigidScene* scene_ = nullptr;
  std::span<const std::unique_ptr<MovingBody>> bodies_;
  std::vector<Collider> colliders_;
  std::vector<PlacedPiece> pieces_;     // pieces of the groups
  std::vector<int> collider_of_piece_;  // for each of pieces_, an index in colliders_
  std::vector<Group> groups_;           // groups of rigid bodies, then of planar bodies
  // Number of colliders of rigid and static bodies, which stay from step to step.
  std::size_t static_colliders_ = 0;
  std::size_t rigid_pieces_ = 0;  // number of pieces of rigid bodies, at the start of pieces_
  std::vector<geometry::Pose> static_poses_;      // poses of the static bodies in static_bvh_
  std::vector<StaticPiece> statics_, planes_;     // pieces of static bodies; planes are separate
  BoxBvh static_bvh_;                             // BVH of statics_
  std::vector<int> near_;                         // pieces near a group; memory that is used again
  std::vector<int> order_;                        // groups ordered by their minimum x
  std::vector<std::pair<int, int>> group_pairs_;  // groups whose bounding boxes overlap
  std::vector<Contact> contacts_;                 // the result of the last Find()
  std::vector<TouchPoint> points_;                // points of two pieces; memory that is used again
  std::vector<std::pair<int, int>> slipping_;     // the colliders of each contact that slips
  BulletPairs bullet_;
};

}  // namespace gsv::dynamics
