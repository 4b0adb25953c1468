#include "gsv/sensing/rays/column_grid.h"

#include "gsv/base/check.h"

namespace gsv::sensing {
namespace {

using geometry::Bounds;

// The grid has about kColumnsPerBox columns for each box. A box is listed in each column that it
// covers, in at most kMaxEntriesPerBox columns on average. If necessary, the columns are made
// larger.
constexpr double kColumnsPerBox = 2;
constexpr std::size_t kMaxEntriesPerBox = 8;
// The maximum number of columns in each direction, because an index has 16 bits.
constexpr double kMaxColumns = 30'000;

}  // namespace

void ColumnGrid::Divide(double cell, double width, double depth) {
  cell_ = cell;
  per_metre_ = 1 / cell;
  columns_ = static_cast<int>(width / cell) + 1;
  rows_ = static_cast<int>(depth / cell) + 1;
  starts_.assign(std::size_t(columns_ + 2) * (rows_ + 2) + 1, 0);
}

bool ColumnGrid::Count(std::span<const Bounds> boxes, std::size_t most) {
  const std::size_t stride = columns_ + 2;
  std::size_t total = 0;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    const Bounds& b = boxes[i];
    const auto index = [&](double from_low) {
      return static_cast<std::uint16_t>(IndexOf(from_low));
    };
    const Range r{index(b.min.x - kMargin - low_x_), index(b.max.x + kMargin - low_x_),
                  index(b.min.y - kMargin - low_y_), index(b.max.y + kMargin - low_y_)};
    ranges_[i] = r;
    total += std::size_t(r.last_column - r.first_column + 1) * (r.last_row - r.first_row + 1);
    if (total > most) return false;
    for (std::size_t row = r.first_row; row <= r.last_row; ++row) {
      for (std::size_t c = r.first_column; c <= r.last_column; ++c) ++starts_[row * stride + c];
    }
  }
  entries_.resize(total);
  return true;
}

void ColumnGrid::Build(std::span<const Bounds> boxes) {
  GSV_CHECK(!boxes.empty() && boxes.size() <= kBox);
  double high_x = boxes[0].max.x, high_y = boxes[0].max.y;
  low_x_ = boxes[0].min.x, low_y_ = boxes[0].min.y;
  for (const Bounds& b : boxes) {
    low_x_ = std::min(low_x_, b.min.x), high_x = std::max(high_x, b.max.x);
    low_y_ = std::min(low_y_, b.min.y), high_y = std::max(high_y, b.max.y);
  }
  GSV_CHECK(low_x_ >= -kMaxCoordinate && high_x <= kMaxCoordinate);
  GSV_CHECK(low_y_ >= -kMaxCoordinate && high_y <= kMaxCoordinate);
  low_x_ -= 2 * kMargin, low_y_ -= 2 * kMargin;
  const double width = high_x - low_x_ + 2 * kMargin, depth = high_y - low_y_ + 2 * kMargin;

  const auto count = static_cast<double>(boxes.size());
  double cell = std::max(std::sqrt(width * depth / (kColumnsPerBox * count)),
                         std::max(width, depth) / std::min(kMaxColumns, kColumnsPerBox * count));
  ranges_.resize(boxes.size());
  for (Divide(cell, width, depth); !Count(boxes, kMaxEntriesPerBox * boxes.size());) {
    Divide(cell *= 1.5, width, depth);
  }

  // starts_ contains the number of entries of each column. This loop replaces it by the index of
  // the end of these entries. The next loop inserts entries backwards, and reduces the index by 1
  // for each. At the end, the index is the start of the column's entries.
  double squares = 0;
  std::uint32_t end = 0;
  for (std::uint32_t& start : starts_) {
    squares += double{1} * start * start;
    start = end += start;
  }
  occupancy_ = squares / static_cast<double>(entries_.size());
  const std::size_t stride = columns_ + 2;
  for (std::size_t i = boxes.size(); i-- > 0;) {
    const Range& r = ranges_[i];
    for (std::size_t row = r.first_row; row <= r.last_row; ++row) {
      for (std::size_t c = r.first_column; c <= r.last_column; ++c) {
        entries_[--starts_[row * stride + c]] = static_cast<std::uint32_t>(i) |
                                                (c == r.first_column ? kFirstColumn : 0) |
                                                (row == r.first_row ? kFirstRow : 0);
      }
    }
  }
}

bool ColumnGrid::Near(const geometry::Vector3& place, double reach, FoundBoxes& found) const {
  const auto index = [&](double from_low, int count) {
    return static_cast<int>(std::clamp(from_low * per_metre_ + 1, 0.0, double(count + 1)));
  };
  const int left = index(place.x - reach - low_x_, columns_);
  const int right = index(place.x + reach - low_x_, columns_);
  const int front = index(place.y - reach - low_y_, rows_);
  const int back = index(place.y + reach - low_y_, rows_);
  // A box may have several entries in the searched columns. The box is added for the first of them
  // only: if it is in the first searched row, or marked as the box's first row; likewise for
  // columns.
  std::uint32_t row_mark = 0;
  std::size_t count = found.count;
  for (int row = front; row <= back; ++row, row_mark = kFirstRow) {
    const std::uint32_t* starts = &starts_[std::size_t(row) * (columns_ + 2)];
    const std::uint32_t begin = starts[left], second = starts[left + 1], end = starts[right + 1];
    if (count + (end - begin) > FoundBoxes::kMax) return false;
    // Each entry is written. If it does not count, the next entry overwrites it. So no branch is
    // needed; the processor could hardly predict it.
    for (std::uint32_t i = begin; i < end; ++i) {
      const std::uint32_t mark = row_mark | (i < second ? 0 : kFirstColumn);
      found.boxes[count] = entries_[i] & kBox;
      count += (entries_[i] & mark) == mark;
    }
  }
  found.count = count;
  return true;
}

}  // namespace gsv::sensing
