#include "gsv/dynamics/rigid/rigid_world.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "gsv/dynamics/motion/drive_servo.h"
#include "gsv/dynamics/rigid/plane_pairs.h"

namespace gsv::dynamics {
namespace {

using geometry::Pose;
using geometry::Vector3;

// s: the longest and the shortest substep.
constexpr double kLongest = 1e-3, kShortest = 1e-3 / 16;
// Of its least thickness a body moves at most so much in a substep, so that it passes through
// nothing.
constexpr double kPassable = 0.4;

// (m/s)²: until no velocity changes by more in an iteration.
constexpr double kConverged = 1e-14;
// penetration of resting bodies, so that they stay in contact, m
constexpr double kSlop = 1e-5;
// m/s: what meets slower does not bounce.
constexpr double kBounces = 0.05;
// m: planar bodies closer than this to where a rigid body may get take part.
constexpr double kNear = 0.05;

constexpr int kStanding = btBroadphaseProxy::StaticFilter;
constexpr int kPlanar = btBroadphaseProxy::KinematicFilter;
constexpr int kRigid = btBroadphaseProxy::DefaultFilter;

}  // namespace

BulletKit::BulletKit(base::ThreadTeam* team) : dispatcher(&configuration), solver(team) {
  dispatcher.setNearCallback(LookAtPairsThatMayTouch);
  InstallSurfaces();
}

RigidWorld::RigidWorld(BulletKit& kit, const RigidScene& scene, const world::State& before,
                       const world::State& after, double seconds)
    : kit_(kit),
      scene_(scene),
      before_(before),
      after_(after),
      seconds_(seconds),
      world_(&kit.dispatcher, &broad_phase_, &kit.solver, &kit.configuration) {
  kit.solver.reset();
  broad_phase_.m_deferedcollide = true;  // all pairs at once, when all objects are there
  world_.setGravity(ToBullet(scene.layout().description->gravity));
  world_.getDispatchInfo().m_deterministicOverlappingPairs = true;
  btContactSolverInfo& settings = world_.getSolverInfo();
  settings.m_leastSquaresResidualThreshold = kConverged;
  settings.m_linearSlop = kSlop;
  settings.m_restitutionVelocityThreshold = kBounces;
  settings.m_splitImpulsePenetrationThreshold = 0;
  settings.m_solverMode = SOLVER_USE_WARMSTARTING | SOLVER_USE_2_FRICTION_DIRECTIONS |
                          SOLVER_ENABLE_FRICTION_DIRECTION_CACHING;
  for (const StandingBody& standing : scene.standing()) AddStanding(standing);
  for (const RigidBody& body : scene.bodies()) {
    AddRigid(body);
  }
  AddPlanarNear();
}

// Bullet searches all pairs for those of each object that goes.
RigidWorld::~RigidWorld() {
  btOverlappingPairCache& cache = *broad_phase_.getOverlappingPairCache();
  btBroadphasePairArray& pairs = cache.getOverlappingPairArray();
  for (int i = 0; i < pairs.size(); ++i) cache.cleanOverlappingPair(pairs[i], &kit_.dispatcher);
  pairs.resizeNoInitialize(0);
}

Owner& RigidWorld::NewOwner(const Solid& solid, bool is_rigid, bool is_held) {
  return owners_.emplace_back(Owner{&solid, &friction_axes_, is_rigid, is_held, false, 0});
}

void RigidWorld::AddRigid(const RigidBody& body) {
  std::vector<Owner*> owners;
  const bool is_held = body.kinematics && !RollsOnWheels(*body.model);
  for (const Solid& solid : body.solids) owners.push_back(&NewOwner(solid, true, is_held));
  const model::WorldDescription& world_description = *scene_.layout().description;
  bodies_.push_back(body.is_jointed()
                        ? MakeJointTree(body, world_description, before_, owners, world_)
                        : MakeFreeBody(body, world_description, before_, *owners[0], world_));
}

void RigidWorld::AddStanding(const StandingBody& standing) {
  auto object = std::make_unique<btCollisionObject>();
  object->setCollisionShape(standing.solid.shape);
  object->setWorldTransform(
      ToBullet(before_.bodies[standing.solid.body].world_from_model * standing.model_from_shape));
  object->setUserPointer(&NewOwner(standing.solid, false));
  object->setCollisionFlags(btCollisionObject::CF_STATIC_OBJECT |
                            btCollisionObject::CF_CUSTOM_MATERIAL_CALLBACK);
  world_.addCollisionObject(object.get(), kStanding, kRigid);
  objects_.push_back(std::move(object));
}

std::vector<Area> RigidWorld::MakeAreas() const {
  std::vector<Area> areas;
  const double fall = world_.getGravity().length() * seconds_ * seconds_ / 2;
  for (const auto& body : bodies_) {
    Area area;
    body->Bounds(area.low, area.high);
    const double reach = kNear + fall + body->Speed() * seconds_;
    area.low -= btVector3(reach, reach, reach);
    area.high += btVector3(reach, reach, reach);
    areas.push_back(area);
  }
  return areas;
}

void RigidWorld::AddPlanarNear() {
  if (scene_.planar().empty()) return;
  const std::vector<Area> areas = MakeAreas();
  for (const Solid& planar : scene_.planar()) {
    if (IsNear(planar, before_, after_, areas)) AddPlanar(planar);
  }
}

void RigidWorld::AddPlanar(const Solid& planar) {
  const Pose& start = before_.bodies[planar.body].world_from_model;
  const Pose& end = after_.bodies[planar.body].world_from_model;
  btRigidBody::btRigidBodyConstructionInfo info(0, nullptr, planar.shape);
  auto object = std::make_unique<btRigidBody>(info);
  object->setCollisionFlags(btCollisionObject::CF_KINEMATIC_OBJECT |
                            btCollisionObject::CF_CUSTOM_MATERIAL_CALLBACK);
  object->setActivationState(DISABLE_DEACTIVATION);
  object->setUserPointer(&NewOwner(planar, false));
  object->setWorldTransform(ToBullet(start));
  const double turn =
      geometry::WrapAngle(geometry::Yaw(end.orientation) - geometry::Yaw(start.orientation));
  planar_.push_back({start, end.position - start.position, turn, object.get()});
  world_.addRigidBody(object.get(), kPlanar, kRigid);
  objects_.push_back(std::move(object));
}

// Bullet takes a kinematic body's velocity from where it was and where it is.
void RigidWorld::MovePlanar(double time, double substep) {
  for (const Planar& planar : planar_) {
    const auto place = [&](double at) {
      const double part = at / seconds_;
      return ToBullet(
          Pose{planar.start.position + part * planar.travel,
               geometry::FromAxisAngle({0, 0, 1}, part * planar.turn) * planar.start.orientation});
    };
    planar.object->setInterpolationWorldTransform(place(time - substep));
    planar.object->setWorldTransform(place(time));
  }
}

void RigidWorld::AddPushes(std::span<const Push> pushes) {
  for (const Push& push : pushes) {
    const auto& plans = scene_.bodies();
    const auto found = std::find_if(plans.begin(), plans.end(), [&](const RigidBody& plan) {
      return plan.body == push.object;
    });
    pushes_.push_back(nullptr);
    if (found == plans.end()) continue;
    btRigidBody* object = bodies_[static_cast<std::size_t>(found - plans.begin())]->rigid();
    if (object == nullptr) continue;
    btVector3 low, high;
    object->getAabb(low, high);
    // The point at which a tipping body leans on the robot: the lowest height at which they face
    // each other.
    btVector3 point = ToBullet(push.point);
    point.setZ(std::max(push.low, low.z()));
    pushes_.back() = std::make_unique<PushConstraint>(*object, point, ToBullet(push.normal),
                                                      push.speed, push.force);
  }
}

// A push takes part from when its robot gets there.
void RigidWorld::StartPushes(std::span<const Push> pushes, double time) {
  for (std::size_t i = 0; i < pushes.size(); ++i) {
    PushConstraint* const constraint = pushes_[i].get();
    if (constraint == nullptr || constraint->has_started() || time < pushes[i].start) continue;
    constraint->Start();
    world_.addConstraint(constraint);
  }
}

double RigidWorld::SubstepFor(double left) const {
  double longest = kLongest;
  for (const auto& body : bodies_) {
    const double speed = body->Speed(), room = kPassable * body->Thickness();
    if (speed * longest > room) longest = room / speed;
  }
  return left / std::ceil(left / std::max(longest, kShortest) - 1e-9);
}

void RigidWorld::TakeSubstep(double time, double substep, RigidContacts& contacts) {
  MovePlanar(time, substep);
  for (const auto& body : bodies_) body->BeforeSubstep(substep);
  for (Owner& owner : owners_) owner.touches = false;
  world_.stepSimulation(substep, 0);
  contacts.Read(kit_.dispatcher);
  for (const auto& body : bodies_) body->AfterSubstep(substep);
  for (const auto& push : pushes_) {
    if (push != nullptr && push->has_started()) push->AfterSubstep();
  }
}

void RigidWorld::Run(std::span<Push> pushes, RigidContacts& contacts) {
  AddPushes(pushes);
  for (double time = 0; seconds_ - time > 1e-12;) {
    const double substep = SubstepFor(seconds_ - time);
    StartPushes(pushes, time);
    TakeSubstep(time, substep, contacts);
    time += substep;
  }
  for (std::size_t i = 0; i < pushes.size(); ++i) {
    if (pushes_[i] == nullptr) continue;
    pushes[i].achieved = pushes_[i]->Achieved();
    pushes[i].impulse = pushes_[i]->impulse();
  }
}

std::vector<world::Contact> RigidWorld::OverlapsOf(int body, double tolerance) {
  world_.performDiscreteCollisionDetection();
  std::map<BodyPair, double> depths;
  for (int i = 0; i < kit_.dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *kit_.dispatcher.getManifoldByIndexInternal(i);
    const int a = static_cast<Owner*>(manifold.getBody0()->getUserPointer())->solid->body;
    const int b = static_cast<Owner*>(manifold.getBody1()->getUserPointer())->solid->body;
    if (a == b || (a != body && b != body)) continue;
    for (int p = 0; p < manifold.getNumContacts(); ++p) {
      const double depth = -manifold.getContactPoint(p).getDistance();
      if (!(depth > tolerance)) continue;
      double& deepest = depths[{std::min(a, b), std::max(a, b)}];
      deepest = std::max(deepest, depth);
    }
  }
  std::vector<world::Contact> contacts;
  for (const auto& [pair, depth] : depths) {
    world::Contact& contact = contacts.emplace_back();
    contact.first = pair.first;
    contact.second = pair.second;
    contact.depth = depth;
  }
  return contacts;
}

void RigidWorld::Store(world::State& state) const {
  for (const auto& body : bodies_) body->Store(seconds_, state);
}

}  // namespace gsv::dynamics
