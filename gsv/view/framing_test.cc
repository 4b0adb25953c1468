#include "gsv/view/framing.h"

#include <gtest/gtest.h>

namespace gsv::view {
namespace {

using geometry::Vector3;

world::Body BoxAt(const char* name, const Vector3& size, const Vector3& centre) {
  auto model = std::make_shared<model::Model>();
  model->name = name;
  model->links.resize(1);
  model::Visual visual;
  visual.shape = geometry::Box{size};
  model->links[0].visuals.push_back(visual);
  world::Body body;
  body.name = name;
  body.model = model;
  body.initial_pose = {centre, {}};
  return body;
}

// Returns the box that an image of these bodies shows.
geometry::Bounds Shown(std::vector<world::Body> bodies) {
  world::Snapshot snapshot;
  snapshot.layout =
      world::MakeLayout(1, std::move(bodies), std::make_shared<const model::WorldDescription>());
  snapshot.state = world::InitialState(*snapshot.layout);
  const auto corners = CornersToShow(snapshot);
  geometry::Bounds bounds{corners.at(0), corners.at(0)};
  for (const Vector3& p : corners) {
    bounds.min = {std::min(bounds.min.x, p.x), std::min(bounds.min.y, p.y),
                  std::min(bounds.min.z, p.z)};
    bounds.max = {std::max(bounds.max.x, p.x), std::max(bounds.max.y, p.y),
                  std::max(bounds.max.z, p.z)};
  }
  return bounds;
}

TEST(Framing, ShowsAllBodies) {
  const auto shown =
      Shown({BoxAt("a", {1, 1, 1}, {2, 0, 0.5}), BoxAt("b", {1, 1, 1}, {-30, 0, 0.5})});
  EXPECT_EQ(shown.min, (Vector3{-30.5, -0.5, 0}));
  EXPECT_EQ(shown.max, (Vector3{2.5, 0.5, 1}));
}

TEST(Framing, IgnoresABodyFarAway) {
  const auto two =
      Shown({BoxAt("a", {1, 1, 1}, {2, 0, 0.5}), BoxAt("far", {1, 1, 1}, {0, 0, 343582})});
  EXPECT_EQ(two.max, (Vector3{2.5, 0.5, 1}));
  const auto more =
      Shown({BoxAt("a", {1, 1, 1}, {500'000, 0, 0.5}), BoxAt("b", {1, 1, 1}, {500'004, 0, 0.5}),
             BoxAt("c", {1, 1, 1}, {500'002, 3, 0.5}), BoxAt("far", {1, 1, 1}, {0, 0, 0.5})});
  EXPECT_EQ(more.min, (Vector3{499'999.5, -0.5, 0}));
}

TEST(Framing, IgnoresGroundMuchLargerThanTheBodiesOnIt) {
  const auto shown =
      Shown({BoxAt("ground", {100, 100, 0.1}, {0, 0, -0.05}), BoxAt("a", {2, 2, 2}, {1, 1, 1})});
  EXPECT_EQ(shown.min, (Vector3{0, 0, 0}));
  EXPECT_EQ(shown.max, (Vector3{2, 2, 2}));
}

TEST(Framing, ShowsGroundThatIsAsLargeAsTheBodiesOnIt) {
  const auto shown =
      Shown({BoxAt("floor", {10, 10, 0.1}, {0, 0, -0.05}), BoxAt("a", {8, 8, 2}, {0, 0, 1})});
  EXPECT_EQ(shown.max.x, 5);
  EXPECT_EQ(Shown({BoxAt("ground", {100, 100, 0.1}, {0, 0, -0.05})}).max.x, 50);
}

TEST(Framing, TheOverviewProjectsAllCornersIntoTheImage) {
  const std::vector<Vector3> corners{{-30, -0.5, 0}, {2.5, 4, 1}, {0, 0, 7}};
  const rendering::CameraView all = Overview(corners, 640, 480);
  const double focal = rendering::FocalLength(all.parameters);
  for (const Vector3& corner : corners) {
    const Vector3 p = geometry::Inverse(all.world_from_camera) * corner;
    EXPECT_GT(p.x, all.parameters.near);
    EXPECT_LE(std::abs(focal * p.y / p.x), 320);
    EXPECT_LE(std::abs(focal * p.z / p.x), 240);
  }
}

TEST(Framing, TheOverviewLooksFromTheRequestedSide) {
  const std::vector<Vector3> corners{{-1, -1, -1}, {1, 1, 1}};
  // This view looks along x.
  const rendering::CameraView east = Overview(corners, 400, 400, {0, 0, 1});
  EXPECT_LT(east.world_from_camera.position.x, -1);
  EXPECT_NEAR(east.world_from_camera.position.y, 0, 1e-9);
  EXPECT_NEAR(east.world_from_camera.position.z, 0, 1e-9);
  const rendering::CameraView near = Overview(corners, 400, 400, {0, 0, 2});
  EXPECT_NEAR(near.world_from_camera.position.x, east.world_from_camera.position.x / 2, 1e-9);
  const rendering::CameraView down = Overview(corners, 400, 400, {0, std::numbers::pi / 2, 1});
  EXPECT_NEAR(down.world_from_camera.position.x, 0, 1e-9);
  EXPECT_GT(down.world_from_camera.position.z, 1);
}

}  // namespace
}  // namespace gsv::view
