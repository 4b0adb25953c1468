#include "gsv/gateway/live/publisher.h"

#include <algorithm>
#include <utility>

namespace gsv::gateway {
namespace {

constexpr double kDirectoryRate = 2;  // Hz: rate of checks for destroyed simulations

}  // namespace

Publisher::Publisher(std::shared_ptr<SimulationDirectory> directory, WorkerPool& watchers,
                     WorkerPool& commanders, RecordingSwitch* recordings,
                     access::ViewerRegistry* registry)
    : directory_(std::move(directory)),
      watchers_(watchers),
      commanders_(commanders),
      recordings_(recordings),
      registry_(registry),
      directory_pacing_(kDirectoryRate) {
  thread_ = std::thread([this] { Run(); });
}

Publisher::~Publisher() { Stop(); }

std::shared_ptr<Hub> Publisher::HubOf(const std::shared_ptr<simulation::Simulation>& simulation) {
  return StreamOf(simulation)->hub();
}

void Publisher::WantSensorsOf(const std::shared_ptr<simulation::Simulation>& simulation,
                              const std::string& robot) {
  StreamOf(simulation)->WantSensorsOf(robot);
  Wake();
}

bool Publisher::IsWatched(const std::shared_ptr<simulation::Simulation>& simulation) const {
  for (const Entry& entry : Entries()) {
    if (entry.simulation.lock() == simulation) return entry.stream->hub()->has_clients();
  }
  return false;
}

std::shared_ptr<LiveStream> Publisher::StreamOf(
    const std::shared_ptr<simulation::Simulation>& simulation) {
  const base::MutexLock lock(mutex_);
  for (const Entry& entry : entries_) {
    if (entry.simulation.lock() == simulation) return entry.stream;
  }
  auto stream = std::make_shared<LiveStream>(
      simulation, watchers_, commanders_, recordings_, [this] { Wake(); }, registry_);
  if (is_stopping_) stream->hub()->Close(CloseCode::kGoingAway, "the server is shutting down");
  entries_.push_back({simulation->specification().name, simulation, stream});
  return stream;
}

void Publisher::Stop() {
  {
    const base::MutexLock lock(mutex_);
    is_stopping_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
  for (const Entry& entry : Entries()) {
    // Publish once more, so that viewers get the final state of a run that has just ended.
    const std::shared_ptr<simulation::Simulation> simulation = entry.simulation.lock();
    if (simulation) entry.stream->Round(simulation, std::chrono::steady_clock::now());
    entry.stream->hub()->Close(CloseCode::kGoingAway, "the server is shutting down");
  }
}

void Publisher::Wake() {
  {
    const base::MutexLock lock(mutex_);
    is_woken_ = true;
  }
  changed_.notify_all();
}

void Publisher::Run() {
  const std::chrono::nanoseconds period(static_cast<std::int64_t>(1e9 / kPublishRate));
  auto next_round = std::chrono::steady_clock::now();
  bool is_watched = false;
  base::MutexLock lock(mutex_);
  while (!is_stopping_) {
    const auto is_called = [&]() GSV_REQUIRES(mutex_) { return is_stopping_ || is_woken_; };
    if (is_watched) {
      changed_.wait_until(lock, next_round, is_called);
    } else {
      changed_.wait(lock, is_called);
    }
    is_woken_ = false;
    if (is_stopping_) return;
    lock.unlock();
    is_watched = Round();
    const auto now = std::chrono::steady_clock::now();
    while (next_round <= now) next_round = std::max(next_round + period, now - period);
    lock.lock();
  }
}

bool Publisher::Round() {
  const WallTime now = std::chrono::steady_clock::now();
  if (directory_pacing_.IsDue(now)) {
    DropEnded();
    directory_pacing_.Done(now);
  }
  bool is_watched = false;
  for (const Entry& entry : Entries()) {
    const std::shared_ptr<simulation::Simulation> simulation = entry.simulation.lock();
    if (!simulation) continue;
    is_watched = is_watched || entry.stream->hub()->has_clients();
    entry.stream->Round(simulation, now);
  }
  return is_watched;
}

void Publisher::DropEnded() {
  for (const Entry& entry : Entries()) {
    const std::shared_ptr<simulation::Simulation> simulation = entry.simulation.lock();
    if (simulation && directory_->Find(entry.name) == simulation) continue;
    entry.stream->hub()->Close(CloseCode::kGoingAway,
                               "the simulation '" + entry.name + "' does not exist any more");
    const base::MutexLock lock(mutex_);
    std::erase_if(entries_, [&](const Entry& other) { return other.stream == entry.stream; });
  }
}

std::vector<Publisher::Entry> Publisher::Entries() const {
  const base::MutexLock lock(mutex_);
  return entries_;
}

}  // namespace gsv::gateway
