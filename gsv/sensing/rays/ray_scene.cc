#include "gsv/sensing/rays/ray_scene.h"

#include <deque>
#include <mutex>
#include <utility>
#include <vector>

#include "gsv/base/check.h"
#include "gsv/sensing/rays/placed_solids.h"

namespace gsv::sensing {
namespace {

// Scenes that nobody looks at. It outlives the cache as long as a scene is out.
struct Pool {
  static constexpr std::size_t kMostIdle = 4;
  std::mutex mutex;
  std::vector<std::unique_ptr<PlacedSolids>> idle;

  std::unique_ptr<PlacedSolids> Take() {
    const std::lock_guard lock(mutex);
    if (idle.empty()) return std::make_unique<PlacedSolids>();
    std::unique_ptr<PlacedSolids> scene = std::move(idle.back());
    idle.pop_back();
    return scene;
  }
  void Return(std::unique_ptr<PlacedSolids> scene) {
    const std::lock_guard lock(mutex);
    if (idle.size() < kMostIdle) idle.push_back(std::move(scene));
  }
};

}  // namespace

class RaySceneCache::Impl {
 public:
  std::shared_ptr<const RayScene> At(const std::shared_ptr<const world::Snapshot>& snapshot,
                                     base::ThreadTeam* team) {
    GSV_CHECK(snapshot != nullptr);
    const std::lock_guard lock(mutex_);
    for (const Entry& entry : recent_) {
      if (entry.snapshot == snapshot) return entry.scene;
    }
    if (solids_ == nullptr || solids_->layout != snapshot->layout) {
      solids_ = std::make_shared<const LayoutSolids>(snapshot->layout);
    }
    if (recent_.size() == kRecent) recent_.pop_front();  // may return its scene to the pool
    std::unique_ptr<PlacedSolids> scene = pool_->Take();
    scene->MoveTo(solids_, *snapshot, team);
    std::shared_ptr<const RayScene> shared(
        scene.release(), [pool = pool_](const PlacedSolids* done) {
          pool->Return(std::unique_ptr<PlacedSolids>(const_cast<PlacedSolids*>(done)));
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
    const std::shared_ptr<const world::Snapshot>& snapshot, base::ThreadTeam* team) {
  return impl_->At(snapshot, team);
}

}  // namespace gsv::sensing
