#include "gsv/broker/trader/liveness_monitor.h"

#include <cstdio>
#include <new>
#include <utility>

#include "gsv/broker/trader/service_reference.h"

namespace gsv::broker {

LivenessMonitor::LivenessMonitor(const LivenessOptions& options, Trader& trader, Ask ask)
    : options_(options), trader_(trader), ask_(std::move(ask)), round_start_(Clock::now()) {
  if (options_.period <= std::chrono::milliseconds::zero()) return;
  for (int i = 0; i < options_.concurrent; ++i) workers_.emplace_back([this] { Work(); });
}

LivenessMonitor::~LivenessMonitor() {
  {
    const base::MutexLock lock(mutex_);
    ending_ = true;
  }
  ending_changed_.notify_all();
  for (std::thread& worker : workers_) worker.join();
}

void LivenessMonitor::Work() {
  while (true) {
    try {
      AskDueServices();
      return;
    } catch (const std::bad_alloc&) {
      // Tries again after a pause, because other threads may use up the limited address space for a
      // short time.
      base::MutexLock lock(mutex_);
      ending_changed_.wait_for(lock, options_.timeout,
                               [this]() GSV_REQUIRES(mutex_) { return ending_; });
    }
  }
}

void LivenessMonitor::AskDueServices() {
  base::MutexLock lock(mutex_);
  while (const auto service = Next(lock)) {
    Liveness pulse = Liveness::kSilent;
    if (!silent_addresses_.contains(service->address)) {
      lock.unlock();
      pulse = ask_(service->reference, options_.timeout);
      lock.lock();
    }
    const bool is_dead = Judge(*service, pulse);
    if (!is_dead) continue;
    lock.unlock();
    Withdraw(*service, pulse);
    lock.lock();
  }
}

std::shared_ptr<const LivenessMonitor::Service> LivenessMonitor::Next(base::MutexLock& lock) {
  while (!ending_) {
    const bool is_over = next_ == round_.size();
    Clock::duration share = options_.period;
    if (!is_over) share = share / static_cast<int>(round_.size()) * static_cast<int>(next_);
    const auto due = round_start_ + share;
    if (Clock::now() < due) {
      // The loop checks the condition again. During the wait, another thread may have taken this
      // service, or may have begun the next check of all services.
      ending_changed_.wait_until(lock, due, [this]() GSV_REQUIRES(mutex_) { return ending_; });
    } else if (is_over) {
      StartRound();
    } else {
      return round_[next_++];
    }
  }
  return nullptr;
}

void LivenessMonitor::StartRound() {
  std::map<std::string, std::shared_ptr<Service>> services;
  for (const OfferPtr& offer : trader_.AllOffers()) {
    auto& service = services[offer->reference];
    if (service == nullptr) {
      const auto reference = ReadReference(offer->reference);
      service = std::make_shared<Service>();
      service->reference = offer->reference;
      if (reference) service->address = reference->Address();
    }
    service->offers.push_back(offer->number);
  }
  round_.clear();
  for (auto& [reference, service] : services) round_.push_back(std::move(service));
  next_ = 0;
  round_start_ = Clock::now();
  silent_addresses_.clear();
  std::erase_if(silent_since_,
                [&](const auto& silent) { return !services.contains(silent.first); });
}

bool LivenessMonitor::Judge(const Service& service, Liveness pulse) {
  if (pulse != Liveness::kSilent) {
    silent_since_.erase(service.reference);
    return pulse == Liveness::kGone;
  }
  if (!service.address.empty()) silent_addresses_.insert(service.address);
  const auto now = Clock::now();
  const auto since = silent_since_.emplace(service.reference, now).first->second;
  return now - since >= options_.max_silence;
}

void LivenessMonitor::Withdraw(const Service& service, Liveness pulse) {
  const std::size_t count = trader_.WithdrawAll(service.offers);
  if (count == 0) return;
  std::fprintf(
      stderr, "broker: withdrew %zu offer%s of a service at %s: it %s\n", count,
      count == 1 ? "" : "s",
      service.address.empty() ? "an unknown address" : service.address.c_str(),
      pulse == Liveness::kGone ? "does not exist any more" : "has not responded for too long");
}

}  // namespace gsv::broker
