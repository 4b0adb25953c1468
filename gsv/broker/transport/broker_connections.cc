#include "gsv/broker/transport/broker_connections.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <map>
#include <memory>
#include <semaphore>
#include <thread>
#include <utility>

#include "gsv/base/mutex.h"
#include "gsv/broker/transport/message_check.h"
#include "gsv/orb/giop/giop_header.h"

namespace gsv::broker {
namespace {

using SteadyClock = std::chrono::steady_clock;

constexpr std::size_t kMessageBytes = 65'536;  // the value of giopMaxMsgSize, without the header
constexpr std::chrono::seconds kMessageTime{3};

// Limits the number of requests in progress to about the number of processors. If dozens of threads
// competed for the ORB's lock and the trader's lock, each acquisition would cost a switch of
// threads. A request waits at most a millisecond for a slot, and then continues without a slot. So
// a request that holds a slot while it waits for another broker delays others only briefly.
//
// Threads  any.
class RequestSlots {
 public:
  bool Acquire() { return free_.try_acquire_for(std::chrono::milliseconds(1)); }
  void Release() { free_.release(); }

 private:
  std::counting_semaphore<> free_{1 + static_cast<int>(std::thread::hardware_concurrency())};
};

class ClientConnection;

// The open connections of clients. While no thread of the ORB waits on a connection, Readable()
// collects the bytes of its next message. Only a complete message is passed to the ORB, so that a
// slow client occupies no thread.
//
// Threads  any.
class ConnectionTable {
 public:
  explicit ConnectionTable(std::size_t limit) : limit_(limit) {}

  void Add(orb::ConnectionControl* control, ClientConnection* connection);
  void Remove(orb::ConnectionControl* control);
  // Called when bytes have arrived. Returns true if the ORB must read the message now. Returns
  // false if the bytes were read here and the message is still incomplete.
  bool Readable(orb::ConnectionControl* control);
  RequestSlots& slots() { return slots_; }

 private:
  struct Entry {
    ClientConnection* connection = nullptr;
    SteadyClock::time_point incomplete{};  // begin of an incomplete message; epoch if there is none
  };

  void EndLate(SteadyClock::time_point now) GSV_REQUIRES(mutex_);
  void EndMostIdle() GSV_REQUIRES(mutex_);

  const std::size_t limit_;
  RequestSlots slots_;
  base::Mutex mutex_;
  std::map<orb::ConnectionControl*, Entry> connections_ GSV_GUARDED_BY(mutex_);
};

class ClientConnection final : public orb::ConnectionHooks {
 public:
  ClientConnection(orb::ConnectionControl& control, std::shared_ptr<ConnectionTable> table)
      : control_(control), table_(std::move(table)) {
    table_->Add(&control_, this);
  }
  ~ClientConnection() override {
    ReleaseSlot();
    table_->Remove(&control_);
  }

  // The ORB waits for the next request. If the previous request had no reply (oneway), OnSend() was
  // not called. So its slot is released here.
  void OnWait() override { ReleaseSlot(); }
  void OnBytes() override { NoteActivity(); }
  void OnMessage(std::string& message) override {
    AcquireSlot();
    CheckRequest(message);
  }
  void OnSend(std::string_view /*bytes*/) override { ReleaseSlot(); }

  // The time at which the last bytes were received, or at which the connection was opened.
  SteadyClock::time_point last_activity() const {
    return SteadyClock::time_point(SteadyClock::duration(last_activity_.load()));
  }
  // Closes this connection because it has been idle longest. The ORB destroys it later. Until then
  // it does not count as idle, so that the next call closes another connection.
  void EndAsIdle() {
    NoteActivity();
    control_.End();
  }

 private:
  void NoteActivity() { last_activity_ = SteadyClock::now().time_since_epoch().count(); }
  void AcquireSlot() {
    if (table_->slots().Acquire() && has_slot_.exchange(true)) table_->slots().Release();
  }
  void ReleaseSlot() {
    if (has_slot_.exchange(false)) table_->slots().Release();
  }

  orb::ConnectionControl& control_;
  const std::shared_ptr<ConnectionTable> table_;
  std::atomic<SteadyClock::rep> last_activity_ = SteadyClock::now().time_since_epoch().count();
  std::atomic<bool> has_slot_ = false;  // true from a request to its reply
};

void ConnectionTable::Add(orb::ConnectionControl* control, ClientConnection* connection) {
  const base::MutexLock lock(mutex_);
  if (connections_.size() >= limit_) EndMostIdle();
  connections_[control] = {connection};
}

void ConnectionTable::Remove(orb::ConnectionControl* control) {
  const base::MutexLock lock(mutex_);
  connections_.erase(control);
}

bool ConnectionTable::Readable(orb::ConnectionControl* control) {
  const base::MutexLock lock(mutex_);
  const auto found = connections_.find(control);
  if (found == connections_.end()) return true;
  SteadyClock::time_point& incomplete = found->second.incomplete;
  if (control->Gather()) {
    incomplete = {};
    return true;
  }
  const SteadyClock::time_point now = SteadyClock::now();
  if (!control->has_begun()) {
    incomplete = {};
  } else if (incomplete == SteadyClock::time_point()) {
    incomplete = now;
  }
  EndLate(now);
  control->Watch();
  return false;
}

void ConnectionTable::EndLate(SteadyClock::time_point now) {
  for (const auto& [control, entry] : connections_) {
    if (entry.incomplete == SteadyClock::time_point()) continue;
    if (now - entry.incomplete > kMessageTime) control->End();
  }
}

void ConnectionTable::EndMostIdle() {
  const auto last_activity = [](const auto& each) {
    return each.second.connection->last_activity();
  };
  std::ranges::min_element(connections_, {}, last_activity)->second.connection->EndAsIdle();
}

// A connection to a service or another trader.
class ServiceConnection final : public orb::ConnectionHooks {
 public:
  // The reply may arrive before OnSent() is called, so OnSend() notes the request.
  void OnSend(std::string_view bytes) override {
    const base::MutexLock lock(mutex_);
    replies_.Sending(bytes);
  }
  void OnSent(std::size_t count) override {
    const base::MutexLock lock(mutex_);
    replies_.Sent(count);
  }
  void OnMessage(std::string& message) override {
    const base::MutexLock lock(mutex_);
    replies_.Check(message);
  }

 private:
  base::Mutex mutex_;
  orb::ReplyCheck replies_{TradingSignatures()};
};

}  // namespace

orb::ConnectionPolicy BrokerConnectionPolicy(std::size_t connections) {
  const auto table = std::make_shared<ConnectionTable>(connections);
  orb::ConnectionPolicy policy;
  policy.limits = {kMessageBytes + orb::kGiopHeaderBytes, kMessageTime};
  policy.accepted = [table](orb::ConnectionControl& control) {
    return std::make_unique<ClientConnection>(control, table);
  };
  policy.made = [](orb::ConnectionControl&) { return std::make_unique<ServiceConnection>(); };
  policy.shall_read = [table](orb::ConnectionControl* control) { return table->Readable(control); };
  return policy;
}

}  // namespace gsv::broker
