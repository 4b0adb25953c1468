#include "gsv/simulation/robots/behaviour_caller.h"

#include <algorithm>

namespace gsv::simulation {

BehaviourCaller::BehaviourCaller(int threads) {
  for (int i = 0; i < threads; ++i) threads_.emplace_back([this] { Work(); });
}

void BehaviourCaller::Close() {
  {
    const base::MutexLock lock(mutex_);
    closing_ = true;
  }
  changed_.notify_all();
  threads_.clear();
}

void BehaviourCaller::Post(std::string key, std::function<void()> call) {
  {
    const base::MutexLock lock(mutex_);
    tasks_.push_back({std::move(key), std::move(call)});
  }
  changed_.notify_one();
}

bool BehaviourCaller::WaitUntilIdle(std::chrono::milliseconds timeout) {
  base::MutexLock lock(mutex_);
  return changed_.wait_for(lock, timeout, [this]() GSV_REQUIRES(mutex_) {
    return tasks_.empty() && in_progress_.empty();
  });
}

std::deque<BehaviourCaller::Task>::iterator BehaviourCaller::FindRunnable() {
  return std::find_if(tasks_.begin(), tasks_.end(), [this](const Task& task) GSV_REQUIRES(mutex_) {
    return !in_progress_.contains(task.key);
  });
}

void BehaviourCaller::Work() {
  base::MutexLock lock(mutex_);
  for (;;) {
    changed_.wait(lock, [this]() GSV_REQUIRES(mutex_) {
      return FindRunnable() != tasks_.end() || (closing_ && tasks_.empty());
    });
    const auto it = FindRunnable();
    if (it == tasks_.end()) return;
    const Task task = std::move(*it);
    tasks_.erase(it);
    in_progress_.insert(task.key);
    lock.unlock();
    task.call();
    lock.lock();
    in_progress_.erase(task.key);
    changed_.notify_all();
  }
}

}  // namespace gsv::simulation
