// Who hears whom by radio.
//
// Model  What arrives, in dBm, is power + the gains of both antennas - the path loss - the loss at
//        walls. The path loss is that of free space over the first metre (Friis 1946),
//        20 log10(4 pi f / c), and 10 n log10(d) beyond, with the exponent n. No fading, no
//        interference: radios may all speak at once.
#pragma once

#include <optional>

#include "gsv/world/radio.h"
#include "gsv/world/ray_caster.h"

namespace gsv::sensing {

using world::Antenna;

// dBm at `distance` (m), behind so many walls. Nearer than 1 cm counts as that.
double ArrivingStrength(const world::RadioSetup& sender, const world::RadioSetup& receiver,
                        double distance, int walls);

// How many solids stand between two antennas, those that carry them left out: half of the surfaces
// that the line of sight crosses, rounded up.
int WallsBetween(const world::RayCaster& rays, const Antenna& from, const Antenna& to);

// The strength at which `to` hears `from`; nothing if it does not. Rays are cast only where walls
// make a difference.
std::optional<double> HeardAt(const Antenna& from, const Antenna& to, const world::RayCaster& rays);

}  // namespace gsv::sensing
