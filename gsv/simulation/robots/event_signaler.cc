#include "gsv/simulation/robots/event_signaler.h"

#include <pthread.h>

namespace gsv::simulation {
namespace {

constexpr std::size_t kFew = 8;

void OpenAll(const EventSignaler::Events& events) {
  for (const auto& wait_event : events) wait_event->Open();
}

}  // namespace

EventSignaler::EventSignaler() : thread_([this] { Run(); }) {}

EventSignaler::~EventSignaler() {
  {
    const base::MutexLock lock(mutex_);
    quit_ = true;
  }
  came_.notify_one();
  thread_.join();
  OpenAll(waiting_);
}

void EventSignaler::Open(Events& events) {
  if (events.size() <= kFew) {
    OpenAll(events);
  } else {
    const base::MutexLock lock(mutex_);
    waiting_.insert(waiting_.end(), events.begin(), events.end());
    came_.notify_one();
  }
  events.clear();
}

void EventSignaler::Run() {
  pthread_setname_np(pthread_self(), "waking");
  Events events;
  base::MutexLock lock(mutex_);
  for (;;) {
    came_.wait(lock, [this]() GSV_REQUIRES(mutex_) { return quit_ || !waiting_.empty(); });
    if (waiting_.empty()) return;
    events.swap(waiting_);
    lock.unlock();
    OpenAll(events);
    events.clear();
    lock.lock();
  }
}

}  // namespace gsv::simulation
