// The scene of `gsv bench camera` and `gsv bench lidar`: robots that drive in circles in a world,
// and cameras.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gsv/rendering/lenses/camera_view.h"
#include "gsv/simulation/simulation.h"

namespace gsv::app {

struct MovingSceneOptions {
  std::string world = "office";  // as for `gsv run`, or "square": that of the crowd, with a floor
  std::string model = "b21r";
  int robots = 50;
  simulation::Mode mode = simulation::Mode::kRealTime;
  // Static bodies collide with their visuals, mesh by mesh, instead of their simpler collision
  // shapes.
  bool collide_with_visuals = false;
};

struct MovingScene {
  // Robots get the first free places on a spiral about the origin; on the square, those of the
  // crowd.
  static base::Result<MovingScene> Create(const MovingSceneOptions& options);

  // Views from the robots' heads in changing directions; several cameras of a robot look several
  // ways.
  std::vector<rendering::CameraView> RobotViews(const world::Snapshot& snapshot, int count,
                                                const rendering::CameraParameters& camera) const;
  // Circling views from above, at such a distance that all robots are in view.
  std::vector<rendering::CameraView> Overviews(const world::Snapshot& snapshot, int count,
                                               const rendering::CameraParameters& camera) const;

  std::shared_ptr<simulation::Simulation> simulation;
  std::vector<std::string> robots;
};

// The number of visible triangles.
std::uint64_t TrianglesIn(const world::Layout& layout);
// The objects that rays can hit: the triangles of meshes, and other shapes.
struct Solids {
  std::uint64_t triangles = 0, shapes = 0;
};
Solids SolidsIn(const world::Layout& layout);

}  // namespace gsv::app
