// Who hears whom by radio.
//
// Model  What arrives, in dBm, is power + the gains of both antennas - the path loss - the loss at
//        walls. The path loss is that of free space over the first metre (Friis 1946),
//        20 log10(4 pi f / c), and 10 n log10(d) beyond, with the exponent n. No fading, no
//        interference: radios may all speak at once.
#pragma once

#include <optional>

#include "gsv/sensing/rays/ray_scene.h"
#include "gsv/world/radio.h"

namespace gsv::sensing {

struct Antenna {
  const world::RadioSetup* setup = nullptr;
  geometry::Vector3 place;  // world
  int body = -1;            // that carries it
};

// dBm at `distance` (m), behind so many walls. Nearer than 1 cm counts as that.
double ArrivingStrength(const world::RadioSetup& sender, const world::RadioSetup& receiver,
                        double distance, int walls);

// How many solids stand between two antennas, those that carry them left out: half of the surfaces
// that the line of sight crosses, rounded up.
int WallsBetween(const RayScene& scene, const Antenna& from, const Antenna& to);

// The strength at which `to` hears `from`; nothing if it does not. `scene` is asked for walls only
// where they make a difference; see SceneSource.
template <class SceneSource>
std::optional<double> HeardAt(const Antenna& from, const Antenna& to, const SceneSource& scene) {
  const world::RadioSetup& sender = *from.setup;
  const world::RadioSetup& receiver = *to.setup;
  if (sender.network != receiver.network || sender.frequency != receiver.frequency) return {};
  const double distance = Norm(to.place - from.place);
  if (sender.range > 0 && distance > sender.range) return {};
  const double in_the_open = ArrivingStrength(sender, receiver, distance, 0);
  if (in_the_open < receiver.sensitivity) return {};
  if (sender.wall_loss == 0) return in_the_open;
  const double strength =
      ArrivingStrength(sender, receiver, distance, WallsBetween(scene(), from, to));
  if (strength < receiver.sensitivity) return {};
  return strength;
}

}  // namespace gsv::sensing
