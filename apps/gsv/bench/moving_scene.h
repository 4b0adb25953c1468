// What `gsv bench camera` takes pictures of: robots that drive in circles about a world, in real
// time, and the cameras that look at it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gsv/rendering/camera_view.h"
#include "gsv/simulation/simulation.h"

namespace gsv::app {

struct MovingScene {
  // `world` as of `gsv run`, or "square": that of the crowd, with a floor. Robots get the first
  // free places on a spiral about the origin, on the square those of the crowd.
  static base::Result<MovingScene> Create(const std::string& world, const std::string& model,
                                          int robots);

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

}  // namespace gsv::app
