#include "gsv/gateway/history/histories.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace gsv::gateway::history {
namespace {

// The periods of sampling a simulation with and without viewers, in wall-clock time.
constexpr std::chrono::milliseconds kWatchedRound{50};
constexpr std::chrono::milliseconds kUnwatchedRound{250};

}  // namespace

Histories::Histories(std::shared_ptr<SimulationDirectory> directory, std::size_t capacity,
                     IsWatched is_watched)
    : directory_(std::move(directory)), capacity_(capacity), is_watched_(std::move(is_watched)) {
  for (const SimulationPointer& simulation : directory_->List()) (void)Of(simulation);
  thread_ = std::thread([this] { Run(); });
}

std::shared_ptr<recording::RunHistory> Histories::Of(const SimulationPointer& simulation) {
  const base::MutexLock lock(mutex_);
  for (const Entry& entry : entries_) {
    if (entry.simulation.lock() == simulation) return entry.history;
  }
  entries_.push_back({simulation, std::make_shared<recording::RunHistory>(simulation, capacity_)});
  return entries_.back().history;
}

void Histories::Stop() {
  {
    const base::MutexLock lock(mutex_);
    is_stopping_ = true;
  }
  changed_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void Histories::Run() {
  base::MutexLock lock(mutex_);
  while (!is_stopping_) {
    lock.unlock();
    const bool is_watched = Round();
    lock.lock();
    changed_.wait_for(lock, is_watched ? kWatchedRound : kUnwatchedRound,
                      [this]() GSV_REQUIRES(mutex_) { return is_stopping_; });
  }
}

bool Histories::Round() {
  const auto now = std::chrono::steady_clock::now();
  const std::vector<SimulationPointer> simulations = directory_->List();
  bool is_any_watched = false;
  for (const SimulationPointer& simulation : simulations) {
    const bool is_watched = is_watched_(simulation);
    is_any_watched = is_any_watched || is_watched;
    Of(simulation)->SampleIfDue(now, is_watched);
  }
  std::vector<Entry> gone;  // these entries are destroyed after the lock was released
  const base::MutexLock lock(mutex_);
  const auto is_there = [&](const Entry& entry) {
    return std::find(simulations.begin(), simulations.end(), entry.simulation.lock()) !=
           simulations.end();
  };
  const auto first_gone = std::stable_partition(entries_.begin(), entries_.end(), is_there);
  gone.assign(std::make_move_iterator(first_gone), std::make_move_iterator(entries_.end()));
  entries_.erase(first_gone, entries_.end());
  return is_any_watched;
}

}  // namespace gsv::gateway::history
