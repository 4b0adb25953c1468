#include "gsv/simulation/robots/gate_opener.h"

#include <pthread.h>

namespace gsv::simulation {
namespace {

constexpr std::size_t kFew = 8;

void OpenAll(const GateOpener::Gates& gates) {
  for (const auto& gate : gates) gate->Open();
}

}  // namespace

GateOpener::GateOpener() : thread_([this](const std::stop_token& stop) { Run(stop); }) {}

GateOpener::~GateOpener() {
  thread_.request_stop();
  thread_.join();
  OpenAll(waiting_);
}

void GateOpener::Open(Gates& gates) {
  if (gates.size() <= kFew) {
    OpenAll(gates);
  } else {
    const std::lock_guard lock(mutex_);
    waiting_.insert(waiting_.end(), gates.begin(), gates.end());
    came_.notify_one();
  }
  gates.clear();
}

void GateOpener::Run(const std::stop_token& stop) {
  pthread_setname_np(pthread_self(), "waking");
  Gates gates;
  std::unique_lock lock(mutex_);
  while (came_.wait(lock, stop, [this] { return !waiting_.empty(); })) {
    gates.swap(waiting_);
    lock.unlock();
    OpenAll(gates);
    gates.clear();
    lock.lock();
  }
}

}  // namespace gsv::simulation
