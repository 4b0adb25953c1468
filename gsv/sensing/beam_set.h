// The beams of one robot's sensors, cast together. For eight sonars, this takes a third of the time
// of eight separate readings.
//
// Determinism  a value is bit-identical to the value of the sensor's Sample().
// Threads      const members may run concurrently, with a Sampling for each.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "gsv/sensing/rays/ray_packet.h"
#include "gsv/sensing/sensor.h"

namespace gsv::sensing {

// Casts the beams of one robot's range sensors together, which is faster than one by one.
class BeamSet {
 public:
  // Adds the sensor's beam. The sensor must have one (Sensor::beam()).
  void Add(const Sensor& sensor);
  std::size_t size() const { return size_; }
  // Whether both sets have bit-identical beams in the same order.
  bool IsIdenticalTo(const BeamSet& other) const;

  // Reads all sensors. values[i] is the value of sensor i, counted from 0 in the order of Add().
  void Sample(const Sampling& sampling, std::span<double> values) const;

  // Beams on one link, as a structure of arrays. `link_from_sensor` has its position in x, y, z,
  // and its orientation in qw, qx, qy, qz.
  struct Beams {
    int link = 0;           // index of the link in the robot's model
    std::size_t count = 0;  // number of beams
    alignas(32) RayPacket::Coordinates x{}, y{}, z{}, qw{}, qx{}, qy{}, qz{};
    RayPacket::Coordinates min{}, max{};  // m
  };

 private:
  std::size_t size_ = 0;      // number of beams, one for each Add()
  std::vector<Beams> beams_;  // in the order of Add()
};

}  // namespace gsv::sensing
