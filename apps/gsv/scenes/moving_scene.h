// What `gsv bench camera` and `gsv bench lidar` look at: robots that drive in circles about a
// world, and the cameras that look at them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gsv/rendering/lenses/camera_view.h"
#include "gsv/simulation/simulation.h"

namespace gsv::app {

struct MovingSceneOptions {
  std::string world = "office";  // as of `gsv run`, or "square": that of the crowd, with a floor
  std::string model = "b21r";
  int robots = 50;
  simulation::Mode mode = simulation::Mode::kRealTime;
  // What stands still is collided with as it is drawn, mesh by mesh, instead of by the simpler
  // shapes that stand for it.
  bool collide_with_visuals = false;
};

struct MovingScene {
  // Robots get the first free places on a spiral about the origin, on the square those of the
  // crowd.
  static base::Result<MovingScene> Create(const MovingSceneOptions& options);

  // From the robots' heads, looking about; a robot with several cameras looks several ways.
  std::vector<rendering::CameraView> RobotViews(const world::Snapshot& snapshot, int count,
                                                const rendering::CameraParameters& camera) const;
  // From above, circling, so far away that all robots are in view.
  std::vector<rendering::CameraView> Overviews(const world::Snapshot& snapshot, int count,
                                               const rendering::CameraParameters& camera) const;

  std::shared_ptr<simulation::Simulation> simulation;
  std::vector<std::string> robots;
};

// Of all that can be seen.
std::uint64_t TrianglesIn(const world::Layout& layout);
// What rays can meet: the triangles of meshes, and the shapes that are none.
struct Solids {
  std::uint64_t triangles = 0, shapes = 0;
};
Solids SolidsIn(const world::Layout& layout);

}  // namespace gsv::app
