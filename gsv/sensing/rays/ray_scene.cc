#include "gsv/sensing/rays/ray_scene.h"

#include <deque>
#include <mutex>
#include <utility>
#include <vector>

#include "gsv/base/check.h"
#include "gsv/base/mutex.h"
#include "gsv/sensing/rays/placed_solids.h"

namespace gsv::sensing {
namespace {

// Unused scenes. The pool outlives the cache while a scene is in use.
struct Pool {
  static constexpr std::size_t kMaxIdle = 4;
  base::Mutex mutex;
  std::vector<std::unique_ptr<PlacedSolids>> idle GSV_GUARDED_BY(mutex);

  std::unique_ptr<PlacedSolids> Take() {
    const base::MutexLock lock(mutex);
    if (idle.empty()) return std::make_unique<PlacedSolids>();
    std::unique_ptr<PlacedSolids> scene = std::move(idle.back());
    idle.pop_back();
    return scene;
  }
  void Return(std::unique_ptr<PlacedSolids> scene) {
    const base::MutexLock lock(mutex);
    if (idle.size() < kMaxIdle) idle.push_back(std::move(scene));
  }
};

}  // namespace

// The mutex guards only the list of scenes. A scene is built without the mutex, by the first thread
// that needs the scene.
class RaySceneCache::Impl {
 public:
  std::shared_ptr<const RayScene> At(const std::shared_ptr<const world::Snapshot>& snapshot,
                                     base::ThreadTeam* team) {
    GSV_CHECK(snapshot != nullptr);
    const std::shared_ptr<Entry> entry = FindOrAdd(snapshot);
    std::call_once(entry->is_built, [&] { entry->scene = Build(*entry, team); });
    return entry->scene;
  }

  std::unique_ptr<SceneDraft> Begin(const std::shared_ptr<const world::Layout>& layout) {
    std::shared_ptr<Solids> solids;
    {
      const base::MutexLock lock(mutex_);
      solids = SolidsOf(layout);
    }
    if (!Built(*solids)->follow_bodies) return nullptr;
    std::unique_ptr<PlacedSolids> scene = pool_->Take();
    scene->BeginMove(solids->solids);
    return std::make_unique<Draft>(std::move(scene), pool_);
  }

  void Add(const std::shared_ptr<const world::Snapshot>& snapshot,
           std::unique_ptr<SceneDraft> draft) {
    FindOrAdd(snapshot)->draft = std::move(static_cast<Draft&>(*draft).scene);
  }

 private:
  // The number of scenes that the cache keeps. Readers that are a few steps late still find the
  // scene of their step.
  static constexpr std::size_t kRecent = 4;

  struct Solids {
    std::shared_ptr<const world::Layout> layout;
    std::once_flag is_built;
    std::shared_ptr<const LayoutSolids> solids;  // null until the solids are built
  };
  struct Entry {
    std::shared_ptr<const world::Snapshot> snapshot;
    std::shared_ptr<Solids> solids;  // solids of the snapshot's layout
    std::once_flag is_built;
    // the scene before it is complete; null if there was no draft
    std::unique_ptr<PlacedSolids> draft;
    std::shared_ptr<const RayScene> scene;  // null until the scene is built
  };
  // A draft, and the pool to which its scene returns if the draft is not used.
  struct Draft final : SceneDraft {
    Draft(std::unique_ptr<PlacedSolids> of, std::shared_ptr<Pool> from)
        : scene(std::move(of)), pool(std::move(from)) {}
    ~Draft() override {
      if (scene != nullptr) pool->Return(std::move(scene));
    }
    Draft(const Draft&) = delete;
    Draft& operator=(const Draft&) = delete;
    void Place(int body, const geometry::Pose& world_from_model) override {
      scene->PlaceBody(body, world_from_model);
    }

    std::unique_ptr<PlacedSolids> scene;
    const std::shared_ptr<Pool> pool;
  };

  // Returns the solids of a layout, which may not be built yet.
  const std::shared_ptr<Solids>& SolidsOf(const std::shared_ptr<const world::Layout>& layout)
      GSV_REQUIRES(mutex_) {
    if (solids_ == nullptr || solids_->layout != layout) {
      solids_ = std::make_shared<Solids>();
      solids_->layout = layout;
    }
    return solids_;
  }

  static const std::shared_ptr<const LayoutSolids>& Built(Solids& solids) {
    std::call_once(solids.is_built,
                   [&] { solids.solids = std::make_shared<const LayoutSolids>(solids.layout); });
    return solids.solids;
  }

  std::shared_ptr<Entry> FindOrAdd(const std::shared_ptr<const world::Snapshot>& snapshot) {
    const base::MutexLock lock(mutex_);
    for (const auto& entry : recent_) {
      if (entry->snapshot == snapshot) return entry;
    }
    // If nobody else uses the scene of the removed entry, the scene returns to the pool and is
    // reused.
    if (recent_.size() == kRecent) recent_.pop_front();
    auto entry = std::make_shared<Entry>();
    entry->snapshot = snapshot;
    entry->solids = SolidsOf(snapshot->layout);
    recent_.push_back(entry);
    return entry;
  }

  std::shared_ptr<const RayScene> Build(Entry& entry, base::ThreadTeam* team) const {
    std::unique_ptr<PlacedSolids> scene = std::move(entry.draft);
    if (scene != nullptr) {
      scene->EndMove();
    } else {
      scene = pool_->Take();
      scene->MoveTo(Built(*entry.solids), *entry.snapshot, team);
    }
    return {scene.release(), [pool = pool_](const PlacedSolids* done) {
              pool->Return(std::unique_ptr<PlacedSolids>(const_cast<PlacedSolids*>(done)));
            }};
  }

  const std::shared_ptr<Pool> pool_ = std::make_shared<Pool>();
  base::Mutex mutex_;
  std::shared_ptr<Solids> solids_ GSV_GUARDED_BY(mutex_);             // solids of the newest layout
  std::deque<std::shared_ptr<Entry>> recent_ GSV_GUARDED_BY(mutex_);  // the newest is last
};

RaySceneCache::RaySceneCache() : impl_(std::make_unique<Impl>()) {}
RaySceneCache::~RaySceneCache() = default;

std::shared_ptr<const RayScene> RaySceneCache::At(
    const std::shared_ptr<const world::Snapshot>& snapshot, base::ThreadTeam* team) {
  return impl_->At(snapshot, team);
}

std::unique_ptr<SceneDraft> RaySceneCache::Begin(
    const std::shared_ptr<const world::Layout>& layout) {
  return impl_->Begin(layout);
}

void RaySceneCache::Add(const std::shared_ptr<const world::Snapshot>& snapshot,
                        std::unique_ptr<SceneDraft> draft) {
  impl_->Add(snapshot, std::move(draft));
}

}  // namespace gsv::sensing
