// The shutter of a camera. A global shutter takes the image at one instant, or during an exposure
// time (motion blur). A rolling shutter takes one row after another.
//
// Parameters   exposure_time (0 s), readout_time (0 s), shutter_samples (8; from 2 to 64)
// Model        The image of the instant t is complete at t. Row y of H is exposed from e -
//              exposure_time to e, where e = t - readout_time (1 - (y + 1/2) / H). The time from t
//              - exposure_time - readout_time to t is divided into `shutter_samples` equal parts.
//              One image is rendered at the centre of each part. A row is the mean light of the
//              images within its exposure. If there is none, the nearest image is used.
// Earlier      the pose s seconds earlier is extrapolated from the velocities at t. Positions
//              change by v s, orientations by w s about w, and joints by their velocity times s. So
//              an image depends on one snapshot only.
#pragma once

#include <functional>
#include <memory>

#include "gsv/base/error.h"
#include "gsv/model/image.h"
#include "gsv/sensing/parameters.h"
#include "gsv/world/snapshot.h"

namespace gsv::rendering {

// Returns the world `seconds` earlier, extrapolated from its velocities.
std::shared_ptr<const world::Snapshot> Earlier(const world::Snapshot& snapshot, double seconds);

// Combines images of several instants into an image with motion blur or a rolling shutter.
class Shutter {
 public:
  // Reports invalid parameters to the reader.
  explicit Shutter(sensing::ParameterReader& reader);

  using SnapshotPtr = std::shared_ptr<const world::Snapshot>;
  using ImagePtr = std::shared_ptr<const model::Image>;
  using Draw = std::function<base::Result<ImagePtr>(const SnapshotPtr& snapshot)>;

  // Takes the image of a snapshot. `draw` renders the camera's view at one instant.
  base::Result<ImagePtr> Take(const SnapshotPtr& snapshot, const Draw& draw) const;

 private:
  // Returns how many seconds before the end of the exposure a sample is taken.
  double Age(int sample) const;
  // Returns the range of samples [first, last] from which a row is composed.
  std::pair<int, int> SamplesOf(int row, int height) const;

  double exposure_time_, readout_time_;  // s
  int samples_;  // number of images that are rendered for one image of the camera
};

}  // namespace gsv::rendering
