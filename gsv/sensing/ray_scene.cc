#include "gsv/sensing/ray_scene.h"

#include <algorithm>
#include <deque>
#include <map>
#include <mutex>
#include <utility>
#include <vector>

#include "gsv/base/check.h"
#include "gsv/sensing/box_tree.h"
#include "gsv/sensing/solid_set.h"

namespace gsv::sensing {
namespace {

using geometry::Bounds;
using geometry::Pose;
using geometry::Vector3;

// The solids of one link, or of all links of a model that do not move against each other.
struct Part {
  int link = -1;  // whose frame it is in; -1: the model's
  SolidSet solids;
};

// The solids of a model that moves, shared by all bodies that have it.
struct ModelParts {
  std::vector<Part> parts;
  bool has_moving_links = false;
};

void AddLink(const model::Link& link, const Pose& set_from_link, int body, SolidSet& solids) {
  for (const model::Collision& collision : link.collisions) {
    solids.Add(collision.shape, set_from_link * collision.link_from_collision, body);
  }
}

ModelParts MakeParts(const model::Model& model) {
  const std::vector<int> moving = world::MovingLinks(model);
  ModelParts result;
  Part rigid;
  for (int link = 0; link < static_cast<int>(model.links.size()); ++link) {
    if (std::binary_search(moving.begin(), moving.end(), link)) continue;
    AddLink(model.links[link], model.links[link].model_from_link, 0, rigid.solids);
  }
  result.parts.push_back(std::move(rigid));
  for (const int link : moving) {
    Part part;
    part.link = link;
    AddLink(model.links[link], {}, 0, part.solids);
    if (part.solids.empty()) continue;
    result.parts.push_back(std::move(part));
    result.has_moving_links = true;
  }
  for (Part& part : result.parts) part.solids.Commit();
  return result;
}

// What all scenes of a layout share.
struct LayoutSolids {
  explicit LayoutSolids(std::shared_ptr<const world::Layout> of) : layout(std::move(of)) {
    std::map<const model::Model*, int> known;  // looked up only
    for (std::size_t i = 0; i < layout->bodies.size(); ++i) {
      const world::Body& body = layout->bodies[i];
      if (body.is_static) {
        for (const model::Link& link : body.model->links) {
          AddLink(link, body.initial_pose * link.model_from_link, static_cast<int>(i), standing);
        }
        continue;
      }
      const auto [entry, is_new] =
          known.try_emplace(body.model.get(), static_cast<int>(models.size()));
      if (is_new) models.push_back(MakeParts(*body.model));
      moving.push_back({static_cast<int>(i), entry->second});
    }
    standing.Commit();
  }

  struct Moving {
    int body, model;
  };
  std::shared_ptr<const world::Layout> layout;
  SolidSet standing;
  std::vector<ModelParts> models;
  std::vector<Moving> moving;
};

// A part of a body at its place.
struct PlacedPart {
  const SolidSet* solids;
  Pose world_from_part;
  int body;
  int number;      // within its body
  Vector3 centre;  // of a ball around it, in the world
  double radius;
};

Bounds Around(const PlacedPart& part) {
  const Vector3 r{part.radius, part.radius, part.radius};
  return {part.centre - r, part.centre + r};
}

class Scene final : public RayScene {
 public:
  void MoveTo(std::shared_ptr<const LayoutSolids> solids, const world::Snapshot& snapshot);

  std::optional<Hit> Cast(const Ray& ray, int ignored_body) const override;
  void Cast(std::span<const Ray> rays, int ignored_body,
            std::span<std::optional<Hit>> hits) const override {
    GSV_CHECK(rays.size() == hits.size());
    for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = Cast(rays[i], ignored_body);
  }

 private:
  void Place(const Part& part, const Pose& world_from_part, int body, int number);
  void CastAtPart(std::uint32_t index, const Ray& ray, int ignored_body, Nearest& nearest) const;

  std::shared_ptr<const LayoutSolids> solids_;
  std::vector<PlacedPart> parts_;
  std::vector<std::uint32_t> endless_;  // parts that hold planes
  std::vector<std::uint32_t> boxed_;    // the others: those in the tree
  BoxTree tree_;
};

void Scene::Place(const Part& part, const Pose& world_from_part, int body, int number) {
  const Bounds& bounds = part.solids.bounds();
  const auto index = static_cast<std::uint32_t>(parts_.size());
  parts_.push_back({&part.solids, world_from_part, body, number,
                    world_from_part * (0.5 * (bounds.min + bounds.max)),
                    0.5 * Norm(bounds.max - bounds.min) * (1 + 1e-9) + 1e-9});
  (part.solids.endless() ? endless_ : boxed_).push_back(index);
}

void Scene::MoveTo(std::shared_ptr<const LayoutSolids> solids, const world::Snapshot& snapshot) {
  solids_ = std::move(solids);
  parts_.clear();
  endless_.clear();
  boxed_.clear();
  for (const LayoutSolids::Moving& moving : solids_->moving) {
    const ModelParts& model = solids_->models[moving.model];
    std::vector<Pose> world_from_link;
    if (model.has_moving_links) world_from_link = world::LinkPoses(snapshot, moving.body);
    const Pose& world_from_model = snapshot.state.bodies[moving.body].world_from_model;
    for (std::size_t i = 0; i < model.parts.size(); ++i) {
      const Part& part = model.parts[i];
      if (part.solids.empty()) continue;
      Place(part, part.link < 0 ? world_from_model : world_from_link[part.link], moving.body,
            static_cast<int>(i));
    }
  }
  std::vector<Bounds> boxes;
  boxes.reserve(boxed_.size());
  for (const std::uint32_t index : boxed_) boxes.push_back(Around(parts_[index]));
  tree_.Build(std::move(boxes), /*often=*/true);
}

// Whether the ray comes within the ball around the part.
bool Passes(const Ray& ray, double length, const PlacedPart& part) {
  const Vector3 to_centre = part.centre - ray.origin;
  const double along = Dot(to_centre, ray.direction);
  const double squared = part.radius * part.radius;
  if (along < 0 || along > length) {
    const double end = along < 0 ? 0 : length;
    const Vector3 gap = to_centre - end * ray.direction;
    return Dot(gap, gap) <= squared;
  }
  const Vector3 gap = to_centre - along * ray.direction;
  return Dot(gap, gap) <= squared;
}

void Scene::CastAtPart(std::uint32_t index, const Ray& ray, int ignored_body,
                       Nearest& nearest) const {
  const PlacedPart& part = parts_[index];
  if (part.body == ignored_body) return;
  if (!part.solids->endless() && !Passes(ray, nearest.distance, part)) return;
  const Pose part_from_world = Inverse(part.world_from_part);
  const Ray local{part_from_world * ray.origin, part_from_world.orientation * ray.direction,
                  nearest.distance};
  Nearest found;
  found.distance = nearest.distance;
  part.solids->Cast(local, -1, found, part.body);
  if (found.body < 0) return;
  // Parts of one body are numbered above their primitives.
  const std::uint32_t primitive = (static_cast<std::uint32_t>(part.number) << 24) + found.primitive;
  nearest.Offer(found.distance, part.body, primitive,
                part.world_from_part.orientation * found.normal);
}

std::optional<Hit> Scene::Cast(const Ray& ray, int ignored_body) const {
  if (!(ray.max_distance >= 0) || !IsFinite(ray.origin) || !IsFinite(ray.direction)) return {};
  Nearest nearest;
  nearest.distance = ray.max_distance;
  solids_->standing.Cast(ray, ignored_body, nearest);
  for (const std::uint32_t index : endless_) CastAtPart(index, ray, ignored_body, nearest);
  struct Visitor final : BoxTree::Visitor {
    const Scene& scene;
    const Ray& ray;
    int ignored_body;
    Nearest& nearest;
    Visitor(const Scene& s, const Ray& r, int ignored, Nearest& n)
        : scene(s), ray(r), ignored_body(ignored), nearest(n) {}
    double Visit(std::uint32_t box) override {
      scene.CastAtPart(scene.boxed_[box], ray, ignored_body, nearest);
      return nearest.distance;
    }
  };
  Visitor visitor(*this, ray, ignored_body, nearest);
  tree_.Cast({ray.origin, ray.direction, nearest.distance}, visitor);
  if (nearest.body < 0) return {};
  return Hit{nearest.distance, nearest.normal, nearest.body};
}

// Scenes that nobody looks at. It outlives the cache as long as a scene is out.
struct Pool {
  static constexpr std::size_t kMostIdle = 4;
  std::mutex mutex;
  std::vector<std::unique_ptr<Scene>> idle;

  std::unique_ptr<Scene> Take() {
    const std::lock_guard lock(mutex);
    if (idle.empty()) return std::make_unique<Scene>();
    std::unique_ptr<Scene> scene = std::move(idle.back());
    idle.pop_back();
    return scene;
  }
  void Return(std::unique_ptr<Scene> scene) {
    const std::lock_guard lock(mutex);
    if (idle.size() < kMostIdle) idle.push_back(std::move(scene));
  }
};

}  // namespace

class RaySceneCache::Impl {
 public:
  std::shared_ptr<const RayScene> At(const std::shared_ptr<const world::Snapshot>& snapshot) {
    GSV_CHECK(snapshot != nullptr);
    const std::lock_guard lock(mutex_);
    for (const Entry& entry : recent_) {
      if (entry.snapshot == snapshot) return entry.scene;
    }
    if (solids_ == nullptr || solids_->layout != snapshot->layout) {
      solids_ = std::make_shared<const LayoutSolids>(snapshot->layout);
    }
    if (recent_.size() == kRecent) recent_.pop_front();  // may return its scene to the pool
    std::unique_ptr<Scene> scene = pool_->Take();
    scene->MoveTo(solids_, *snapshot);
    std::shared_ptr<const RayScene> shared(scene.release(), [pool = pool_](const Scene* done) {
      pool->Return(std::unique_ptr<Scene>(const_cast<Scene*>(done)));
    });
    recent_.push_back({snapshot, shared});
    return shared;
  }

 private:
  // Readers a few steps behind still find their scene.
  static constexpr std::size_t kRecent = 4;

  struct Entry {
    std::shared_ptr<const world::Snapshot> snapshot;
    std::shared_ptr<const RayScene> scene;
  };

  std::mutex mutex_;
  std::shared_ptr<const LayoutSolids> solids_;
  std::shared_ptr<Pool> pool_ = std::make_shared<Pool>();
  std::deque<Entry> recent_;  // the newest last
};

RaySceneCache::RaySceneCache() : impl_(std::make_unique<Impl>()) {}
RaySceneCache::~RaySceneCache() = default;

std::shared_ptr<const RayScene> RaySceneCache::At(
    const std::shared_ptr<const world::Snapshot>& snapshot) {
  return impl_->At(snapshot);
}

}  // namespace gsv::sensing
