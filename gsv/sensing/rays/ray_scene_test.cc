#include "gsv/sensing/rays/ray_scene.h"

#include <cmath>
#include <limits>
#include <thread>

#include <gtest/gtest.h>

#include "gsv/base/test_within.h"
#include "gsv/sensing/testing/test_rays.h"
#include "gsv/sensing/testing/test_snapshot.h"

namespace gsv::sensing {
namespace {

using geometry::Pose;
using geometry::Vector3;
using testing::BruteForce;
using testing::MakeSnapshot;
using testing::ModelOf;
using testing::Placed;
using testing::Random;
using testing::RandomMesh;

// A base with a wheel on a hinge, and a mast on a prismatic joint.
std::shared_ptr<model::Model> Vehicle(Random& random) {
  auto model = ModelOf(geometry::Box{{0.6, 0.4, 0.3}});
  model->links.push_back(ModelOf(geometry::Box{{0.2, 0.05, 0.2}})->links[0]);
  model->links[1].model_from_link = geometry::PlanarPose(0.2, 0.25, -0.1, 0.2);
  model->links.push_back(ModelOf(RandomMesh(random, 30, 0.3))->links[0]);
  model->links[2].model_from_link = geometry::PlanarPose(0, 0, 0.6, 0);
  model::Joint hinge;
  hinge.kind = model::JointKind::kContinuous;
  hinge.parent = 0, hinge.child = 1;
  hinge.model_from_joint.position = {0.2, 0.25, -0.1};
  hinge.axis = {0, 1, 0};
  model::Joint slider;
  slider.kind = model::JointKind::kPrismatic;
  slider.parent = 0, slider.child = 2;
  model->joints = {hinge, slider};
  return model;
}

std::shared_ptr<world::Snapshot> RandomWorld(Random& random) {
  const std::vector<geometry::Shape> shapes = {
      geometry::Box{{1, 2, 0.5}},           geometry::Sphere{0.8},
      geometry::Cylinder{0.6, 1.5},         geometry::Capsule{0.4, 1.2},
      geometry::Ellipsoid{{0.5, 0.9, 1.3}}, geometry::Cone{0.9, 1.6}};
  std::vector<Placed> bodies;
  for (int i = 0; i < 40; ++i) {
    const bool is_static = i % 3 != 0;
    bodies.push_back({"shape" + std::to_string(i), ModelOf(shapes[i % shapes.size()]),
                      random.AnyPose(15), is_static});
  }
  for (int i = 0; i < 4; ++i) {
    bodies.push_back({"mesh" + std::to_string(i), ModelOf(RandomMesh(random, 300, 0.4)),
                      random.AnyPose(12), i % 2 == 0});
  }
  const auto vehicle = Vehicle(random);
  for (int i = 0; i < 8; ++i) {
    bodies.push_back({"vehicle" + std::to_string(i), vehicle, random.AnyPose(12), false});
  }
  bodies.push_back({"plane", ModelOf(geometry::Plane{}), {{0, 0, -14}, {}}, true});
  auto snapshot = MakeSnapshot(bodies);
  for (double& q : snapshot->state.joint_positions) q = random.Uniform(-1, 1);
  return snapshot;
}

TEST(RayScene, EqualsABruteForceSearch) {
  Random random(11);
  RaySceneCache cache;
  int hits = 0;
  for (int world = 0; world < 5; ++world) {
    const auto snapshot = RandomWorld(random);
    const auto scene = cache.At(snapshot);
    for (int i = 0; i < 1000; ++i) {
      const Ray ray{random.Point(16), Normalized(random.Point(1)), random.Uniform(1, 60)};
      const int ignored = i % 4 == 0 ? static_cast<int>(random.Uniform(0, 50)) : -1;
      const auto expected = BruteForce(*snapshot, ray, ignored);
      const auto found = scene->Cast(ray, ignored);
      ASSERT_EQ(found.has_value(), expected.has_value()) << world << " " << i;
      if (!found) continue;
      ++hits;
      ASSERT_WITHIN(found->distance, expected->distance, 1e-9, "m") << world << " " << i;
      ASSERT_EQ(found->body, expected->body) << world << " " << i;
      ASSERT_LE(Dot(found->normal, ray.direction), 1e-12) << world << " " << i;
      ASSERT_NEAR(Norm(found->normal), 1, 1e-9) << world << " " << i;
    }
  }
  EXPECT_GT(hits, 1000);
}

// Poses of the moving bodies are enough for a draft if no solids move with joints.
TEST(RaySceneCache, SceneOfADraftEqualsTheSceneOfItsSnapshot) {
  Random random(21);
  std::vector<Placed> bodies;
  for (int i = 0; i < 60; ++i) {
    bodies.push_back({"body" + std::to_string(i),
                      ModelOf(i % 2 == 0 ? geometry::Shape(geometry::Box{{1, 2, 0.5}})
                                         : geometry::Shape(geometry::Sphere{0.8})),
                      random.AnyPose(12), i % 3 == 0});
  }
  const auto snapshot = MakeSnapshot(bodies);
  RaySceneCache cache, other;
  for (int round = 0; round < 3; ++round) {
    // The snapshot of this round is complete only after the draft has begun.
    auto next = std::make_shared<world::Snapshot>(*snapshot);
    auto draft = cache.Begin(next->layout);
    ASSERT_NE(draft, nullptr);
    for (int i = 0; i < 60; ++i) {
      if (i % 3 == 0) continue;
      const int body = next->layout->Find("body" + std::to_string(i));
      const Pose pose = random.AnyPose(12);
      next->state.bodies[static_cast<std::size_t>(body)].world_from_model = pose;
      draft->Place(body, pose);
    }
    cache.Add(next, std::move(draft));
    const auto scene = cache.At(next), expected = other.At(next);
    for (int i = 0; i < 1000; ++i) {
      const Ray ray{random.Point(14), Normalized(random.Point(1)), 40};
      ASSERT_EQ(scene->Range(ray, -1), expected->Range(ray, -1)) << round << " " << i;
    }
  }
}

TEST(RaySceneCache, MakesNoDraftIfSolidsMoveWithJoints) {
  Random random(22);
  RaySceneCache cache;
  EXPECT_EQ(cache.Begin(RandomWorld(random)->layout), nullptr);
}

// The result must not depend on the arrangement of boxes. A grid is not suited for stacked or
// distant boxes.
TEST(RayScene, EqualsABruteForceSearchInTowersAndFarAway) {
  Random random(14);
  constexpr int kFloors = 120;
  std::vector<Placed> bodies;
  bodies.reserve(kFloors);
  for (int i = 0; i < kFloors; ++i) {
    bodies.push_back({"floor" + std::to_string(i),
                      ModelOf(geometry::Box{{1, 1, 0.1}}),
                      {{random.Uniform(-1, 1), random.Uniform(-1, 1), 0.2 * i}, {}},
                      i % 2 == 0});
  }
  for (int i = 0; i < 3; ++i) {
    bodies.push_back({"far" + std::to_string(i),
                      ModelOf(geometry::Sphere{2}),
                      {{i * 3e4, -2e4, 5}, {}},
                      i == 1});
  }
  const auto snapshot = MakeSnapshot(bodies);
  RaySceneCache cache;
  const auto scene = cache.At(snapshot);
  int hits = 0;
  for (int i = 0; i < 1000; ++i) {
    const Vector3 origin{random.Uniform(-4, 4), random.Uniform(-4, 4), random.Uniform(-1, 25)};
    const Ray ray{origin, Normalized(random.Point(1)), 20};
    const auto expected = BruteForce(*snapshot, ray, -1);
    const auto found = scene->Cast(ray, -1);
    ASSERT_EQ(found.has_value(), expected.has_value()) << i;
    if (!found) continue;
    ++hits;
    ASSERT_WITHIN(found->distance, expected->distance, 1e-9, "m") << i;
    ASSERT_EQ(found->body, expected->body) << i;
  }
  EXPECT_GT(hits, 100);
  EXPECT_NEAR(scene->Range({{0, -2e4, 9}, {0, 0, -1}, 5}, -1), 2, 1e-9);
}

TEST(RayScene, FirstOfTwoBodiesAtOneDistanceIsHit) {
  // The boxes are side by side, and some are static. The rays go along their common faces.
  constexpr int kBoxes = 20;
  std::vector<Placed> bodies;
  bodies.reserve(kBoxes);
  for (int i = 0; i < kBoxes; ++i) {
    bodies.push_back({"box" + std::to_string(10 + (7 * i) % 20),
                      ModelOf(geometry::Box{{1, 1, 1}}),
                      {{i + 0.5, 0, 0}, {}},
                      i % 3 == 0});
  }
  const auto snapshot = MakeSnapshot(bodies);
  RaySceneCache cache;
  const auto scene = cache.At(snapshot);
  for (int i = 1; i < 20; ++i) {
    const auto hit = scene->Cast({{i + 0.0, 0, 5}, {0, 0, -1}, 10}, -1);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->distance, 4.5);
    const int left = snapshot->layout->Find("box" + std::to_string(10 + 7 * (i - 1) % 20));
    const int right = snapshot->layout->Find("box" + std::to_string(10 + 7 * i % 20));
    EXPECT_EQ(hit->body, std::min(left, right)) << i;
  }
}

TEST(RayScene, RangeIsTheDistanceOfTheHit) {
  Random random(15);
  RaySceneCache cache;
  const auto scene = cache.At(RandomWorld(random));
  for (int i = 0; i < 1000; ++i) {
    const Ray ray{random.Point(16), Normalized(random.Point(1)), random.Uniform(1, 60)};
    const auto hit = scene->Cast(ray, i % 50);
    ASSERT_EQ(scene->Range(ray, i % 50),
              hit ? hit->distance : std::numeric_limits<double>::infinity());
  }
}

TEST(RayScene, ManyRaysAtOnceEqualSingleRays) {
  Random random(12);
  RaySceneCache cache;
  const auto snapshot = RandomWorld(random);
  const auto scene = cache.At(snapshot);
  std::vector<Ray> rays(500);
  for (Ray& ray : rays) ray = {random.Point(5), Normalized(random.Point(1)), 40};
  std::vector<std::optional<Hit>> hits(rays.size());
  scene->Cast(rays, 3, hits);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const auto one = scene->Cast(rays[i], 3);
    ASSERT_EQ(hits[i].has_value(), one.has_value());
    if (!one) continue;
    EXPECT_EQ(hits[i]->distance, one->distance);
    EXPECT_EQ(hits[i]->body, one->body);
    EXPECT_EQ(hits[i]->normal, one->normal);
  }
}

TEST(RayScene, APacketOfRaysEqualsSingleRays) {
  Random random(13);
  RaySceneCache cache;
  int echoes = 0;
  for (int round = 0; round < 20; ++round) {
    const auto snapshot = RandomWorld(random);
    const auto scene = cache.At(snapshot);
    for (int i = 0; i < 50; ++i) {
      const Vector3 place = random.Point(round % 2 == 0 ? 8 : 30);
      RayPacket packet;
      const auto count = 1 + static_cast<std::size_t>(i) % RayPacket::kMax;
      while (packet.count < count) {
        packet.Add({place + random.Point(0.2), Normalized(random.Point(1)), random.Uniform(0, 9)});
      }
      std::vector<double> ranges(count);
      scene->Ranges(packet, place, i, ranges);
      for (std::size_t ray = 0; ray < count; ++ray) {
        EXPECT_EQ(ranges[ray], scene->Range(packet.At(ray), i));
        echoes += std::isfinite(ranges[ray]) ? 1 : 0;
      }
    }
  }
  EXPECT_GT(echoes, 100);
}

TEST(RayScene, NoRayPassesBetweenTheTrianglesOfAMesh) {
  // A wavy sheet of 2 × 100 × 100 triangles. The rays hit it exactly at its vertices and edges.
  auto mesh = std::make_shared<geometry::TriangleMesh>();
  constexpr int kSide = 100;
  const auto height = [](double x, double y) { return 0.3 * std::sin(3 * x) * std::cos(2 * y); };
  for (int i = 0; i <= kSide; ++i) {
    for (int k = 0; k <= kSide; ++k) {
      const double x = 0.07 * i, y = 0.07 * k;
      mesh->positions.push_back({x, y, height(x, y)});
    }
  }
  for (std::uint32_t i = 0; i < kSide; ++i) {
    for (std::uint32_t k = 0; k < kSide; ++k) {
      const std::uint32_t a = i * (kSide + 1) + k, b = a + kSide + 1;
      mesh->triangles.push_back({a, b, b + 1});
      mesh->triangles.push_back({a, b + 1, a + 1});
    }
  }
  RaySceneCache cache;
  const auto snapshot =
      MakeSnapshot({{"sheet", ModelOf(geometry::Mesh{mesh, {1, 1, 1}}), {}, true}});
  const auto scene = cache.At(snapshot);
  for (int i = 1; i < kSide; ++i) {
    for (int k = 1; k < kSide; ++k) {
      const Vector3 vertex = mesh->positions[i * (kSide + 1) + k];
      for (const Vector3& from : {vertex + Vector3{0, 0, 5}, vertex + Vector3{0.3, -0.2, 4}}) {
        const auto hit = scene->Cast({from, Normalized(vertex - from), 100}, -1);
        ASSERT_TRUE(hit) << i << " " << k;
        ASSERT_NEAR(hit->distance, Norm(vertex - from), 1e-9);
      }
    }
  }
}

TEST(RayScene, NearerBodyIsHitFromTheNextSnapshotOn) {
  RaySceneCache cache;
  const auto before =
      MakeSnapshot({{"a", ModelOf(geometry::Box{{1, 1, 1}}), {{5, 0, 0}, {}}, false},
                    {"b", ModelOf(geometry::Box{{1, 1, 1}}), {{9, 0, 0}, {}}, true}});
  const Ray ray{{0, 0, 0}, {1, 0, 0}, 20};
  const auto old_scene = cache.At(before);
  EXPECT_EQ(cache.At(before), old_scene);
  EXPECT_DOUBLE_EQ(old_scene->Cast(ray, -1)->distance, 4.5);
  EXPECT_DOUBLE_EQ(old_scene->Cast(ray, 0)->distance, 8.5);
  auto after = std::make_shared<world::Snapshot>(*before);
  after->state.bodies[0].world_from_model.position.y = 3;
  const auto new_scene = cache.At(after);
  EXPECT_DOUBLE_EQ(new_scene->Cast(ray, -1)->distance, 8.5);
  // the old scene still shows its own snapshot
  EXPECT_DOUBLE_EQ(old_scene->Cast(ray, -1)->distance, 4.5);
}

TEST(RayScene, OutlivesItsCache) {
  std::shared_ptr<const RayScene> scene;
  {
    RaySceneCache cache;
    scene = cache.At(MakeSnapshot({{"a", ModelOf(geometry::Sphere{1}), {{5, 0, 0}, {}}, false}}));
  }
  EXPECT_DOUBLE_EQ(scene->Cast({{0, 0, 0}, {1, 0, 0}, 20}, -1)->distance, 4);
}

TEST(RayScene, NonFiniteRaysHitNothing) {
  RaySceneCache cache;
  const auto scene = cache.At(MakeSnapshot({{"a", ModelOf(geometry::Plane{}), {}, true}}));
  const double nan = std::nan("");
  EXPECT_FALSE(scene->Cast({{0, 0, 1}, {0, 0, nan}, 20}, -1));
  EXPECT_FALSE(scene->Cast({{0, nan, 1}, {0, 0, -1}, 20}, -1));
  EXPECT_FALSE(scene->Cast({{0, 0, 1}, {0, 0, -1}, nan}, -1));
  EXPECT_FALSE(scene->Cast({{0, 0, 1}, {0, 0, -1}, -1}, -1));
}

TEST(RayScene, ThreadsGetTheSameResults) {
  Random random(13);
  const auto snapshot = RandomWorld(random);
  std::vector<Ray> rays(300);
  for (Ray& ray : rays) ray = {random.Point(5), Normalized(random.Point(1)), 40};
  RaySceneCache cache;
  std::vector<std::vector<double>> answers(4);
  std::vector<std::thread> threads;
  threads.reserve(answers.size());
  for (auto& answer : answers) {
    threads.emplace_back([&] {
      for (int round = 0; round < 5; ++round) {
        const auto moved = std::make_shared<world::Snapshot>(*snapshot);
        const auto scene = cache.At(moved);
        answer.clear();
        for (const Ray& ray : rays) {
          const auto hit = scene->Cast(ray, -1);
          answer.push_back(hit ? hit->distance : -1);
        }
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  for (const auto& answer : answers) EXPECT_EQ(answer, answers[0]);
}

}  // namespace
}  // namespace gsv::sensing
