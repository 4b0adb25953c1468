// The propagation of radio signals.
//
// Model  The received strength in dBm is power + the gains of both antennas - path loss - loss at
//        walls. The path loss is 20 log10(4 pi f / c) + 10 n log10(d), with the exponent n and the
//        distance d in metres. The first term is the loss of free space over one metre (Friis
//        1946). No fading and no interference.
#pragma once

#include <optional>

#include "gsv/world/radio.h"
#include "gsv/world/ray_caster.h"

namespace gsv::sensing {

using world::Antenna;

// Returns the received strength in dBm at `distance` (m, at least 1 cm) behind `walls` walls.
double ArrivingStrength(const world::RadioSetup& sender, const world::RadioSetup& receiver,
                        double distance, int walls);

// Returns the number of solids between two antennas, without the robots that carry the antennas.
// The number is half of the number of surfaces on the line of sight, rounded up.
int WallsBetween(const world::RayCaster& rays, const Antenna& from, const Antenna& to);

// Returns the strength (dBm) at which the antenna `to` receives a message of the antenna `from`;
// nullopt if the message is not received. Casts rays only if walls affect the result.
std::optional<double> HeardAt(const Antenna& from, const Antenna& to, const world::RayCaster& rays);

}  // namespace gsv::sensing
