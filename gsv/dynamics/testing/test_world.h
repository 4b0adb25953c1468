// Small worlds for tests: robots of simple shapes, walls, floors.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gsv/dynamics/motion/engine.h"
#include "gsv/world/pedestrian.h"
#include "gsv/world/snapshot.h"

namespace gsv::dynamics::testing {

inline model::Link LinkOf(const geometry::Shape& shape, const geometry::Pose& pose = {}) {
  model::Link link;
  link.name = "link";
  model::Collision collision;
  collision.name = "collision";
  collision.link_from_collision = pose;
  collision.shape = shape;
  link.collisions.push_back(collision);
  return link;
}

inline std::shared_ptr<model::Model> ModelOf(const geometry::Shape& shape,
                                             const geometry::Pose& pose = {}) {
  auto model = std::make_shared<model::Model>();
  model->name = "model";
  model->links.push_back(LinkOf(shape, pose));
  return model;
}

// A robot that stands on its lowest point and reaches any velocity at once.
inline std::shared_ptr<model::Model> RobotOf(
    const geometry::Shape& shape, double height,
    model::DriveKind kind = model::DriveKind::kDifferential) {
  auto model = ModelOf(shape, geometry::PlanarPose(0, 0, height / 2, 0));
  model->drive = model::Drive{};
  model->drive->kind = kind;
  return model;
}

inline std::shared_ptr<model::Model> DiscRobot(double radius = 0.2) {
  return RobotOf(geometry::Cylinder{radius, 0.4}, 0.4);
}

inline std::shared_ptr<model::Model> BoxRobot(double length, double width) {
  return RobotOf(geometry::Box{{length, width, 0.4}}, 0.4);
}

// A world that a test builds from models, starts and steps.
class TestWorld {
 public:
  explicit TestWorld(std::unique_ptr<Engine> engine) : engine_(std::move(engine)) {}

  void AddStatic(const std::string& name, std::shared_ptr<const model::Model> model,
                 const geometry::Pose& pose) {
    Add(name, std::move(model), pose, world::BodyKind::kStatic);
  }
  void AddRigid(const std::string& name, std::shared_ptr<const model::Model> model,
                const geometry::Pose& pose) {
    Add(name, std::move(model), pose, world::BodyKind::kRigidBody);
  }
  void AddActor(const std::string& name, std::shared_ptr<const model::Model> model,
                const geometry::Pose& pose) {
    Add(name, std::move(model), pose, world::BodyKind::kActor);
  }
  void AddPedestrian(const std::string& name, const world::Pedestrian& pedestrian,
                     const geometry::Pose& pose) {
    Add(name, model::PedestrianModel(*pedestrian.group, 0), pose, world::BodyKind::kPedestrian);
    bodies_.back().pedestrian = std::make_shared<const world::Pedestrian>(pedestrian);
  }
  void AddRobot(const std::string& name, std::shared_ptr<const model::Model> model,
                const geometry::Pose& pose) {
    const bool has_drive = model->drive.has_value();
    Add(name, std::move(model), pose,
        has_drive ? world::BodyKind::kPlanarBase : world::BodyKind::kUnmoved);
  }
  // Adds a box at (x, y) whose bottom is at height z.
  void AddBox(const std::string& name, const geometry::Vector3& size, double x, double y,
              double z = 0, double yaw = 0) {
    AddStatic(name, ModelOf(geometry::Box{size}), geometry::PlanarPose(x, y, z + size.z / 2, yaw));
  }

  // Gravity, wind and fluids. They may be changed before Start().
  model::WorldDescription& description() { return description_; }

  base::Status Start() {
    layout_ =
        world::MakeLayout(1, bodies_, std::make_shared<model::WorldDescription>(description_));
    state_ = world::InitialState(*layout_);
    return engine_->SetLayout(layout_);
  }

  void Command(const std::string& name, const world::DriveCommand& command) {
    world::DriveState& drive = body(name).drive;
    drive.command = command;
    drive.command_time = state_.time;
  }

  void CommandJoint(const std::string& name, int joint, const world::JointCommand& command) {
    world::CommandJoint(*layout_, layout_->Find(name), joint, command, state_);
  }

  std::vector<world::Contact> Step(double seconds) {
    const base::SimTime step = base::FromSeconds(seconds);
    std::vector<world::Contact> contacts;
    Step(step, contacts);
    return contacts;
  }
  void Step(base::SimTime step, std::vector<world::Contact>& contacts) {
    engine_->Step(step, state_, contacts);
    ++state_.step;
    state_.time += step;
  }
  // Takes steps of `step` seconds for `seconds` of simulated time.
  void Run(double seconds, double step) {
    for (int i = 0; i < static_cast<int>(seconds / step + 0.5); ++i) Step(step);
  }

  world::BodyState& body(const std::string& name) { return state_.bodies[layout_->Find(name)]; }
  const geometry::Vector3& position(const std::string& name) {
    return body(name).world_from_model.position;
  }
  double yaw(const std::string& name) {
    return geometry::Yaw(body(name).world_from_model.orientation);
  }
  // The position and the velocity of a joint of a body, by the joint's index in the model.
  double joint(const std::string& name, int joint) {
    return state_.joint_positions[layout_->bodies[layout_->Find(name)].first_joint + joint];
  }
  double joint_velocity(const std::string& name, int joint) {
    return state_.joint_velocities[layout_->bodies[layout_->Find(name)].first_joint + joint];
  }

  // Returns the hash of the present state.
  std::uint64_t Digest() const {
    base::Hash hash;
    world::AddToHash(*layout_, state_, hash);
    return hash.Digest();
  }

  Engine& engine() { return *engine_; }
  world::State& state() { return state_; }
  const world::State& state() const { return state_; }
  const world::Layout& layout() const { return *layout_; }

 private:
  void Add(const std::string& name, std::shared_ptr<const model::Model> model,
           const geometry::Pose& pose, world::BodyKind kind) {
    world::Body body;
    body.name = name;
    body.model = std::move(model);
    body.initial_pose = pose;
    body.kind = kind;
    bodies_.push_back(std::move(body));
  }

  std::unique_ptr<Engine> engine_;
  model::WorldDescription description_;
  std::vector<world::Body> bodies_;
  std::shared_ptr<const world::Layout> layout_;
  world::State state_;
};

}  // namespace gsv::dynamics::testing
