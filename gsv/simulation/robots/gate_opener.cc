#include "gsv/simulation/robots/gate_opener.h"

#include <pthread.h>

namespace gsv::simulation {
namespace {

constexpr std::size_t kFew = 8;

void OpenAll(const GateOpener::Gates& gates) {
  for (const auto& gate : gates) gate->Open();
}

}  // namespace

GateOpener::GateOpener() : thread_([this] { Run(); }) {}

GateOpener::~GateOpener() {
  {
    const base::MutexLock lock(mutex_);
    quit_ = true;
  }
  came_.notify_one();
  thread_.join();
  OpenAll(waiting_);
}

void GateOpener::Open(Gates& gates) {
  if (gates.size() <= kFew) {
    OpenAll(gates);
  } else {
    const base::MutexLock lock(mutex_);
    waiting_.insert(waiting_.end(), gates.begin(), gates.end());
    came_.notify_one();
  }
  gates.clear();
}

void GateOpener::Run() {
  pthread_setname_np(pthread_self(), "waking");
  Gates gates;
  base::MutexLock lock(mutex_);
  for (;;) {
    came_.wait(lock, [this]() GSV_REQUIRES(mutex_) { return quit_ || !waiting_.empty(); });
    if (waiting_.empty()) return;
    gates.swap(waiting_);
    lock.unlock();
    OpenAll(gates);
    gates.clear();
    lock.lock();
  }
}

}  // namespace gsv::simulation
