// When a camera gathers its light: at one instant, over a while (motion blur), or row after row
// (rolling shutter).
//
// Parameters   exposure_time (s, 0), readout_time (s, 0), shutter_samples (8: from 2 to 64).
// Model        A picture of the instant t is finished at t. Row y of H gathers light from
//              e - exposure_time to e, where e = t - readout_time (1 - (y + 1/2) / H). It is put
//              together from `shutter_samples` pictures, in the middle of equal parts of the time
//              from t - exposure_time - readout_time to t: of each row the mean light of those in
//              its while, or the one nearest to its middle.
// Earlier      things stood, s seconds ago, where their velocities at t lead back to: positions by
//              v s, turned by w s about w, joints by their velocity times s. So a picture hangs on
//              one snapshot, whatever was read before.
#pragma once

#include <functional>
#include <memory>

#include "gsv/base/error.h"
#include "gsv/model/image.h"
#include "gsv/sensing/parameters.h"
#include "gsv/world/snapshot.h"

namespace gsv::rendering {

// The world so many seconds before, by its velocities.
std::shared_ptr<const world::Snapshot> Earlier(const world::Snapshot& snapshot, double seconds);

class Shutter {
 public:
  // Refuses by the reader.
  explicit Shutter(sensing::ParameterReader& reader);

  using SnapshotPtr = std::shared_ptr<const world::Snapshot>;
  using ImagePtr = std::shared_ptr<const model::Image>;
  using Draw = std::function<base::Result<ImagePtr>(const SnapshotPtr& snapshot)>;

  // The picture of a snapshot; `draw` draws what is seen at one instant.
  base::Result<ImagePtr> Take(const SnapshotPtr& snapshot, const Draw& draw) const;

 private:
  double Age(int sample) const;  // s before the picture is finished
  // The samples that a row is put together from: [first, last].
  std::pair<int, int> SamplesOf(int row, int height) const;

  double exposure_time_, readout_time_;
  int samples_;
};

}  // namespace gsv::rendering
