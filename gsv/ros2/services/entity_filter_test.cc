#include "gsv/ros2/services/entity_filter.h"

#include <gtest/gtest.h>

#include "gsv/geometry/shape.h"

namespace gsv::ros2 {
namespace {

using messages::simulation_interfaces::Bounds;
using messages::simulation_interfaces::EntityCategory;
using messages::simulation_interfaces::EntityFilters;

// Three cubes of 1 m at x = 0, 10 and 20: a wall, a robot and an object.
class EntityFilterTest : public ::testing::Test {
 protected:
  EntityFilterTest() {
    model::Model cube;
    cube.links.resize(1);
    cube.links[0].collisions.resize(1);
    cube.links[0].collisions[0].shape = geometry::Box{};
    const auto model = std::make_shared<const model::Model>(cube);
    std::vector<world::Body> bodies(3);
    const char* const names[] = {"a_wall", "b_robot", "c_thing"};
    const world::BodyKind kinds[] = {world::BodyKind::kStatic, world::BodyKind::kPlanarBase,
                                     world::BodyKind::kUnmoved};
    for (std::size_t i = 0; i < bodies.size(); ++i) {
      bodies[i].name = names[i];
      bodies[i].kind = kinds[i];
      bodies[i].model = model;
      bodies[i].initial_pose.position.x = 10.0 * static_cast<double>(i);
    }
    snapshot_.layout = world::MakeLayout(1, bodies, std::make_shared<model::WorldDescription>());
    snapshot_.state = world::InitialState(*snapshot_.layout);
  }
  std::vector<int> Filter(const EntityFilters& filters) {
    const auto passed = FilterEntities(snapshot_, filters);
    EXPECT_TRUE(passed) << passed.error().Sentence();
    return passed.value_or(std::vector<int>{});
  }
  base::ErrorCode Refusal(const EntityFilters& filters) {
    const auto passed = FilterEntities(snapshot_, filters);
    EXPECT_FALSE(passed);
    return passed ? base::ErrorCode::kEnded : passed.error().code;
  }

  world::Snapshot snapshot_;
};

TEST_F(EntityFilterTest, PassesAllWithoutAFilter) {
  EXPECT_EQ(Filter({}), (std::vector<int>{0, 1, 2}));
}

TEST_F(EntityFilterTest, MatchesNamesByARegularExpression) {
  EXPECT_EQ(Filter({.filter = "^[ab]_"}), (std::vector<int>{0, 1}));
  EXPECT_EQ(Filter({.filter = "thing$"}), std::vector<int>{2});
}

TEST_F(EntityFilterTest, PassesBodiesOfAnyOfTheCategories) {
  EntityFilters filters;
  filters.categories = {{EntityCategory::kCategoryRobot}, {EntityCategory::kCategoryStaticObject}};
  EXPECT_EQ(Filter(filters), (std::vector<int>{0, 1}));
}

TEST_F(EntityFilterTest, PassesBodiesThatOverlapABoxOrASphere) {
  EntityFilters filters;
  filters.bounds.type = Bounds::kTypeBox;
  filters.bounds.points = {{10, 1, 1}, {0.4, -1, -1}};
  EXPECT_EQ(Filter(filters), (std::vector<int>{0, 1}));
  filters.bounds.type = Bounds::kTypeSphere;
  filters.bounds.points = {{12, 0, 0}, {1.4, 0, 0}};  // the near side of the robot is at x = 10.5
  EXPECT_EQ(Filter(filters), std::vector<int>{});
  filters.bounds.points[1].x = 1.6;
  EXPECT_EQ(Filter(filters), std::vector<int>{1});
}

TEST_F(EntityFilterTest, RefusesExpressionsThatWouldTakeLong) {
  for (const std::string& expression :
       {std::string("((a{1,255}){1,255}){1,255}"), std::string("(a*)\\1"), std::string("("),
        std::string(257, 'a'), std::string("a\0b", 3)}) {
    EXPECT_EQ(Refusal({.filter = expression}), base::ErrorCode::kInvalidArgument) << expression;
  }
}

TEST_F(EntityFilterTest, RejectsUnsupportedFilters) {
  EntityFilters filters;
  filters.tags.tags = {"red"};
  EXPECT_EQ(Refusal(filters), base::ErrorCode::kUnavailable);
  filters.tags.tags.clear();
  filters.bounds.type = Bounds::kTypeConvexHull;
  EXPECT_EQ(Refusal(filters), base::ErrorCode::kUnavailable);
  filters.bounds.type = Bounds::kTypeBox;
  filters.bounds.points.resize(3);
  EXPECT_EQ(Refusal(filters), base::ErrorCode::kInvalidArgument);
}

}  // namespace
}  // namespace gsv::ros2
