#include "gsv/model/model.h"

#include <numbers>

#include <gtest/gtest.h>

namespace gsv::model {
namespace {

Model With(const geometry::Shape& shape, const geometry::Pose& model_from_link) {
  Model model;
  Link link;
  link.model_from_link = model_from_link;
  Collision collision;
  collision.shape = shape;
  link.collisions.push_back(collision);
  model.links.push_back(link);
  return model;
}

TEST(FootprintRadius, ReachesTheFarthestCorner) {
  // The box is 2 m x 4 m with its centre at (1, 0), so the corner (2, 2) is farthest from the
  // origin.
  const Model model = With(geometry::Box{{2, 4, 1}}, {{1, 0, 0}, {}});
  EXPECT_NEAR(FootprintRadius(model), std::hypot(2.0, 2.0), 1e-12);
}

TEST(FootprintRadius, IgnoresPlanes) {
  EXPECT_EQ(FootprintRadius(With(geometry::Plane{}, {})), 0);
  EXPECT_EQ(LowestPoint(With(geometry::Plane{}, {})), 0);
  EXPECT_EQ(FootprintRadius(Model{}), 0);
}

TEST(LowestPoint, IsThatOfARotatedBox) {
  // A cube of side 1 stands on its edge, so half of its diagonal is below its centre.
  const auto turned = geometry::FromAxisAngle({1, 0, 0}, std::numbers::pi / 4);
  EXPECT_NEAR(LowestPoint(With(geometry::Box{{1, 1, 1}}, {{0, 0, 3}, turned})),
              3 - std::numbers::sqrt2 / 2, 1e-12);
}

TEST(Parameters, ReturnTheValueOfTheirTypeOrTheDefault) {
  const Parameters parameters = {{"max", 3.5}, {"on", true}, {"unit", std::string("m")}};
  EXPECT_EQ(NumberOr(parameters, "max", 1), 3.5);
  EXPECT_EQ(NumberOr(parameters, "on", 1), 1);
  EXPECT_EQ(NumberOr(parameters, "absent", 1), 1);
  EXPECT_TRUE(FlagOr(parameters, "on", false));
  EXPECT_EQ(TextOr(parameters, "unit", ""), "m");
  EXPECT_EQ(TextOr(parameters, "max", "none"), "none");
}

}  // namespace
}  // namespace gsv::model
