#include "gsv/rendering/images/depth_segment.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

#include "gsv/base/check.h"

namespace gsv::rendering {
namespace {

constexpr std::uint8_t kMarker = 0xe9;  // APP9

void AppendLittleEndian(std::uint32_t value, int size, std::vector<std::uint8_t>& bytes) {
  for (int i = 0; i < size; ++i) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
}

// Appends numbers as groups of three bits, two groups per byte.
class GroupWriter {
 public:
  explicit GroupWriter(std::vector<std::uint8_t>& bytes) : bytes_(bytes) {}

  void Append(std::uint32_t number) {
    for (; number >= 8; number >>= 3) AppendGroup(8 | (number & 7));
    AppendGroup(number);
  }

 private:
  void AppendGroup(std::uint32_t group) {
    if (is_half_) {
      bytes_.back() = static_cast<std::uint8_t>(bytes_.back() | (group << 4));
    } else {
      bytes_.push_back(static_cast<std::uint8_t>(group));
    }
    is_half_ = !is_half_;
  }

  std::vector<std::uint8_t>& bytes_;
  bool is_half_ = false;
};

}  // namespace

std::vector<std::uint8_t> EncodeDepth(const DepthGrid& grid) {
  GSV_CHECK(grid.inverse_depth.size() <= kMaxDepthSamples);
  constexpr float kMaxNumber = 65535;
  float nearest = 0;
  for (const float inverse : grid.inverse_depth) nearest = std::max(nearest, inverse);
  const float scale = nearest > 0 ? kMaxNumber / nearest : 0;

  std::vector<std::uint8_t> bytes(kDepthIdentifier, kDepthIdentifier + sizeof kDepthIdentifier);
  bytes.reserve(bytes.size() + 10 + grid.inverse_depth.size());
  for (const int value : {grid.width, grid.height, grid.spacing}) {
    AppendLittleEndian(static_cast<std::uint32_t>(value), 2, bytes);
  }
  AppendLittleEndian(std::bit_cast<std::uint32_t>(scale), 4, bytes);

  GroupWriter groups(bytes);
  const auto columns = static_cast<std::size_t>(grid.columns);
  // In the columns that the loop has passed: the numbers of this row. In the other columns: the
  // numbers of the previous row.
  std::vector<std::uint32_t> numbers(columns, 0);
  for (std::size_t first = 0; first < grid.inverse_depth.size(); first += columns) {
    std::uint32_t left = 0, above_left = 0;
    for (std::size_t column = 0; column < columns; ++column) {
      const float scaled = std::min(scale * grid.inverse_depth[first + column], kMaxNumber);
      const auto number = static_cast<std::uint32_t>(std::lround(scaled));
      const std::uint32_t above = numbers[column];
      const auto difference =
          static_cast<std::int16_t>(static_cast<std::uint16_t>(number - left - above + above_left));
      groups.Append(difference < 0 ? static_cast<std::uint32_t>(-2 * difference - 1)
                                   : static_cast<std::uint32_t>(2 * difference));
      above_left = above;
      left = numbers[column] = number;
    }
  }
  return bytes;
}

void InsertDepth(const DepthGrid& grid, std::vector<std::uint8_t>& jpeg) {
  constexpr std::size_t kFirstSegment = 2;  // offset in bytes, after the marker SOI
  GSV_CHECK(jpeg.size() > kFirstSegment + 4);
  const std::size_t length = (std::size_t{jpeg[kFirstSegment + 2]} << 8) + jpeg[kFirstSegment + 3];
  const std::vector<std::uint8_t> content = EncodeDepth(grid);
  const std::size_t size = content.size() + 2;
  std::vector<std::uint8_t> segment{0xff, kMarker, static_cast<std::uint8_t>(size >> 8),
                                    static_cast<std::uint8_t>(size & 0xff)};
  segment.insert(segment.end(), content.begin(), content.end());
  jpeg.insert(jpeg.begin() + static_cast<std::ptrdiff_t>(kFirstSegment + 2 + length),
              segment.begin(), segment.end());
}

}  // namespace gsv::rendering
