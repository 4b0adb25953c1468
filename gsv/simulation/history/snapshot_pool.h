// A pool of snapshots that have no reader any more. Later steps reuse their memory.
//
// Threads  any. Snapshots may outlive the pool.
#pragma once

#include <memory>
#include <vector>

#include "gsv/base/mutex.h"
#include "gsv/world/snapshot.h"

namespace gsv::simulation {

// Reuses the memory of old snapshots for new snapshots.
class SnapshotPool {
 public:
  // Returns a snapshot, whose content may be old. When its last reader releases it, the snapshot
  // returns to the pool.
  std::shared_ptr<world::Snapshot> Take() {
    std::unique_ptr<world::Snapshot> snapshot = shelf_->Take();
    return {snapshot.release(), [shelf = shelf_](world::Snapshot* done) {
              shelf->Return(std::unique_ptr<world::Snapshot>(done));
            }};
  }

 private:
  // The unused snapshots. Snapshots in use keep the shelf alive.
  struct Shelf {
    static constexpr std::size_t kMaxIdle = 4;  // number of unused snapshots that are kept

    // Removes an unused snapshot and returns it. Makes a snapshot if there is none.
    std::unique_ptr<world::Snapshot> Take() {
      const base::MutexLock lock(mutex);
      if (idle.empty()) return std::make_unique<world::Snapshot>();
      std::unique_ptr<world::Snapshot> snapshot = std::move(idle.back());
      idle.pop_back();
      return snapshot;
    }
    // Keeps the snapshot for Take(), if there is space.
    void Return(std::unique_ptr<world::Snapshot> snapshot) {
      const base::MutexLock lock(mutex);
      if (idle.size() < kMaxIdle) idle.push_back(std::move(snapshot));
    }

    base::Mutex mutex;
    std::vector<std::unique_ptr<world::Snapshot>> idle GSV_GUARDED_BY(mutex);
  };
  const std::shared_ptr<Shelf> shelf_ = std::make_shared<Shelf>();
};

}  // namespace gsv::simulation
