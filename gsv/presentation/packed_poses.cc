#include "gsv/presentation/packed_poses.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "gsv/messages/time.h"

namespace gsv::presentation {
namespace {

constexpr double kUnitsPerMetre = 1e4;
// The largest component of a unit quaternion is left out. The others are at most 1 / sqrt(2), and
// this scale maps them to integers.
constexpr double kHalfScale = 16383.5;
constexpr unsigned kHighestBit = 0x8000;

std::int32_t PackedCoordinate(double metres) {
  constexpr double kLimit = std::numeric_limits<std::int32_t>::max();
  return static_cast<std::int32_t>(
      std::lround(std::clamp(metres * kUnitsPerMetre, -kLimit, kLimit)));
}

unsigned PackedComponent(double component) {
  const double scaled = (component * std::numbers::sqrt2 + 1) * kHalfScale;
  return static_cast<unsigned>(std::lround(std::clamp(scaled, 0.0, 2 * kHalfScale)));
}

void PackRotation(const geometry::Quaternion& q, std::vector<std::uint16_t>& out) {
  const std::array<double, 4> all{q.x, q.y, q.z, q.w};
  const auto largest = std::max_element(
      all.begin(), all.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  const auto missing = static_cast<unsigned>(largest - all.begin());
  const double sign = *largest < 0 ? -1 : 1;
  std::array<unsigned, 3> packed{};
  std::size_t next = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i != missing) packed[next++] = PackedComponent(sign * all[i]);
  }
  if ((missing & 2u) != 0) packed[0] |= kHighestBit;
  if ((missing & 1u) != 0) packed[1] |= kHighestBit;
  for (const unsigned number : packed) out.push_back(static_cast<std::uint16_t>(number));
}

}  // namespace

messages::gsv_msgs::PackedPoses PackedPosesMessage(const world::Snapshot& snapshot,
                                                   const std::vector<PoseEntry>& list) {
  messages::gsv_msgs::PackedPoses message;
  message.stamp = messages::ToMessage(snapshot.state.time);
  message.step = static_cast<std::uint64_t>(snapshot.state.step);
  message.layout_version = snapshot.layout->version;
  message.positions.reserve(3 * list.size());
  message.rotations.reserve(3 * list.size());
  for (const geometry::Pose& pose : PosesOf(snapshot, list)) {
    const geometry::Vector3& p = pose.position;
    for (const double metres : {p.x, p.y, p.z}) {
      message.positions.push_back(PackedCoordinate(metres));
    }
    PackRotation(pose.orientation, message.rotations);
  }
  return message;
}

}  // namespace gsv::presentation
