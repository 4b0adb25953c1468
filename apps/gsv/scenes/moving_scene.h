// The scene of `gsv bench camera` and `gsv bench lidar`: robots that drive in circles in a world,
// and cameras.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gsv/rendering/lenses/camera_view.h"
#include "gsv/simulation/simulation.h"

namespace gsv::app {

// The world, the robots and the mode of a scene.
struct MovingSceneOptions {
  std::string world =
      "office";  // a world of `gsv run`, or "square" for the crowd's square with a floor
  std::string model = "b21r";  // model of the robots
  int robots = 50;             // number of robots
  simulation::Mode mode = simulation::Mode::kRealTime;
  // Whether static bodies collide with their visuals, mesh by mesh, and not with their simpler
  // collision shapes. No effect in the world "square".
  bool collide_with_visuals = false;
};

// A running simulation with robots that drive in circles.
struct MovingScene {
  // Creates the scene. Robots get the first free places on a spiral about the origin, or the places
  // of the crowd on the square.
  static base::Result<MovingScene> Create(const MovingSceneOptions& options);

  // Returns views from the robots' heads in changing directions. Several cameras of one robot look
  // in different directions.
  std::vector<rendering::CameraView> RobotViews(const world::Snapshot& snapshot, int count,
                                                const rendering::CameraParameters& camera) const;
  // Returns views from cameras that circle above the world, at such a distance that all robots are
  // visible.
  std::vector<rendering::CameraView> Overviews(const world::Snapshot& snapshot, int count,
                                               const rendering::CameraParameters& camera) const;

  std::shared_ptr<simulation::Simulation> simulation;
  std::vector<std::string> robots;  // names of the robots
};

// Returns the number of visible triangles.
std::uint64_t TrianglesIn(const world::Layout& layout);
// The numbers of objects that rays can hit: the triangles of meshes, and other shapes.
struct Solids {
  std::uint64_t triangles = 0, shapes = 0;
};
Solids SolidsIn(const world::Layout& layout);

}  // namespace gsv::app
