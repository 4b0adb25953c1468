#include "gsv/sensing/rays/column_grid.h"

#include <set>

#include <gtest/gtest.h>

#include "gsv/sensing/testing/test_rays.h"

namespace gsv::sensing {
namespace {

using geometry::Bounds;
using geometry::Vector3;
using testing::Random;

Bounds BoxAt(const Vector3& centre, const Vector3& half) { return {centre - half, centre + half}; }

// Returns boxes of many sizes. A few of them are as long as walls.
std::vector<Bounds> RandomBoxes(Random& random, int count) {
  std::vector<Bounds> boxes;
  for (int i = 0; i < count; ++i) {
    const double size = i % 20 == 0 ? 8 : 0.3;
    const Vector3 centre = Scaled(random.Point(20), {1, 1, 0.03});
    boxes.push_back(BoxAt(centre, {random.Uniform(0.05, size), random.Uniform(0.05, 0.3),
                                   random.Uniform(0.05, 0.3)}));
  }
  return boxes;
}

bool Holds(const Bounds& box, const Vector3& p) {
  return box.min.x <= p.x && p.x <= box.max.x && box.min.y <= p.y && p.y <= box.max.y &&
         box.min.z <= p.z && p.z <= box.max.z;
}

std::set<std::uint32_t> Walked(const ColumnGrid& grid, const Ray& ray) {
  std::set<std::uint32_t> found;
  grid.Walk(ray, ray.max_distance, [&](std::uint32_t box) { found.insert(box); });
  return found;
}

TEST(ColumnGrid, FindsEveryBoxThatARayPassesThrough) {
  Random random(31);
  const std::vector<Bounds> boxes = RandomBoxes(random, 300);
  ColumnGrid grid;
  grid.Build(boxes);
  int passed = 0;
  for (int i = 0; i < 500; ++i) {
    const Vector3 flat{1, 1, 0.03};
    Ray ray{Scaled(random.Point(30), flat), Normalized(Scaled(random.Point(1), flat)),
            random.Uniform(0, 60)};
    if (i % 5 == 0) ray.direction = {i % 2 ? 1.0 : -1.0, 0, 0};
    if (i % 7 == 0) ray.direction = {-0.0, i % 2 ? 1.0 : -1.0, 0};
    if (i % 11 == 0) ray.direction = {0, 0, -1};
    const auto found = Walked(grid, ray);
    // Checks points along the ray.
    for (double t = 0; t <= ray.max_distance; t += 0.01) {
      const Vector3 p = ray.origin + t * ray.direction;
      for (std::uint32_t box = 0; box < boxes.size(); ++box) {
        if (!Holds(boxes[box], p)) continue;
        ++passed;
        ASSERT_TRUE(found.contains(box)) << i << " " << box << " at " << t;
      }
    }
  }
  EXPECT_GT(passed, 1000);
}

TEST(ColumnGrid, FindsBoxesOnEitherSideOfARayAlongTheirBorder) {
  std::vector<Bounds> boxes;
  for (int x = 0; x < 10; ++x) {
    for (int y = 0; y < 10; ++y) boxes.push_back({{x + 0.0, y + 0.0, 0}, {x + 1.0, y + 1.0, 1}});
  }
  ColumnGrid grid;
  grid.Build(boxes);
  for (int y = 1; y < 10; ++y) {
    const auto along = Walked(grid, {{-1, y + 0.0, 0.5}, {1, 0, 0}, 20});
    const auto across = Walked(grid, {{y + 0.0, 11, 0.5}, {0, -1, 0}, 20});
    for (int i = 0; i < 10; ++i) {
      for (const int side : {y - 1, y}) {
        EXPECT_TRUE(along.contains(10 * i + side)) << i << " " << side;
        EXPECT_TRUE(across.contains(10 * side + i)) << i << " " << side;
      }
    }
  }
}

TEST(ColumnGrid, StopsWhenTheRayIsShortened) {
  constexpr int kBoxes = 100;
  std::vector<Bounds> boxes;
  boxes.reserve(kBoxes);
  for (int x = 0; x < kBoxes; ++x) boxes.push_back(BoxAt({x + 0.5, 0, 0}, {0.1, 0.1, 0.1}));
  ColumnGrid grid;
  grid.Build(boxes);
  double length = 1000;
  std::uint32_t furthest = 0;
  grid.Walk({{0, 0, 0}, {1, 0, 0}, length}, length, [&](std::uint32_t box) {
    length = std::min(length, box + 0.4);
    furthest = std::max(furthest, box);
  });
  EXPECT_EQ(length, 0.4);
  EXPECT_LT(furthest, 3u);
}

TEST(ColumnGrid, FindsEveryBoxNearAPlaceOnce) {
  Random random(32);
  const std::vector<Bounds> boxes = RandomBoxes(random, 200);
  ColumnGrid grid;
  grid.Build(boxes);
  for (int i = 0; i < 200; ++i) {
    const Vector3 place = random.Point(25);
    const double reach = random.Uniform(0, 8);
    FoundBoxes found;
    ASSERT_TRUE(grid.Near(place, reach, found));
    const std::set<std::uint32_t> once(found.boxes.begin(), found.boxes.begin() + found.count);
    EXPECT_EQ(once.size(), found.count);
    for (std::uint32_t box = 0; box < boxes.size(); ++box) {
      const Bounds& b = boxes[box];
      const Vector3 gap{place.x - std::clamp(place.x, b.min.x, b.max.x),
                        place.y - std::clamp(place.y, b.min.y, b.max.y), 0};
      EXPECT_TRUE(Norm(gap) > reach || once.contains(box)) << i << " " << box;
    }
  }
}

TEST(ColumnGrid, ReportsTooManyBoxesNearAPlace) {
  const std::vector<Bounds> boxes(FoundBoxes::kMax + 1, BoxAt({0, 0, 0}, {1, 1, 1}));
  ColumnGrid grid;
  grid.Build(boxes);
  FoundBoxes found;
  EXPECT_FALSE(grid.Near({0, 0, 0}, 1, found));
  EXPECT_EQ(grid.occupancy(), static_cast<double>(boxes.size()));
}

}  // namespace
}  // namespace gsv::sensing
