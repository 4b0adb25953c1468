// For tests: a world for a ViewDrawer.
#pragma once

#include <atomic>
#include <memory>
#include <utility>
#include <vector>

#include "gsv/base/mutex.h"
#include "gsv/gateway/drawing/view_source.h"

namespace gsv::gateway::testing {

// A world with a box, whose snapshot changes on request.
class FakeViewSource final : public drawing::ViewSource {
 public:
  FakeViewSource() { Change(); }

  base::Result<drawing::ViewInstant> Now() override {
    ++looks;
    if (has_ended) return base::Fail(base::ErrorCode::kEnded, "the simulation has been removed");
    const base::MutexLock lock(mutex_);
    const auto snapshot = snapshot_;
    return drawing::ViewInstant{
        snapshot,
        {[](const std::string&) { return std::optional<geometry::Pose>(); },
         [](const std::string&, const std::string&) -> base::Result<view::SensorView> {
           return base::Fail(base::ErrorCode::kNotFound, "there is no camera");
         },
         [] {
           return std::vector<geometry::Vector3>{{-1, -1, 0}, {1, 1, 1}};
         }},
        snapshot->state.time};
  }

  // Makes a new snapshot, whose time is one second later.
  void Change() {
    auto model = std::make_shared<model::Model>();
    model->links.resize(1);
    model->links[0].visuals.resize(1);
    model->links[0].visuals[0].shape = geometry::Box{{1, 1, 1}};
    world::Body body;
    body.name = "box";
    body.model = model;
    auto snapshot = std::make_shared<world::Snapshot>();
    snapshot->layout =
        world::MakeLayout(1, {body}, std::make_shared<const model::WorldDescription>());
    snapshot->state = world::InitialState(*snapshot->layout);
    const base::MutexLock lock(mutex_);
    snapshot->state.time = std::chrono::seconds(++changes_);
    snapshot_ = snapshot;
  }

  std::atomic<int> looks = 0;           // number of calls of Now()
  std::atomic<bool> has_ended = false;  // if true, Now() fails as for a removed simulation

 private:
  base::Mutex mutex_;
  int changes_ GSV_GUARDED_BY(mutex_) = 0;
  std::shared_ptr<const world::Snapshot> snapshot_ GSV_GUARDED_BY(mutex_);
};

// The source of a ViewDrawer; the test owns it.
class BorrowedViewSource final : public drawing::ViewSource {
 public:
  explicit BorrowedViewSource(std::shared_ptr<FakeViewSource> source)
      : source_(std::move(source)) {}
  base::Result<drawing::ViewInstant> Now() override { return source_->Now(); }

 private:
  const std::shared_ptr<FakeViewSource> source_;
};

}  // namespace gsv::gateway::testing
