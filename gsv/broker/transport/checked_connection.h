// The ORB's connections, which hand on nothing but whole messages that were looked through.
//
// A message that is refused altogether (what is no GIOP, or too long) ends its connection.
#pragma once

#include <atomic>
#include <chrono>
#include <map>
#include <memory>
#include <mutex>
#include <semaphore>
#include <thread>

#include "gsv/broker/transport/message_check.h"
#include "gsv/orb/connection.h"
#include "gsv/orb/incoming_message.h"

namespace gsv::broker {

// What a message may be long, giopMaxMsgSize and its header.
inline constexpr std::size_t kMessageBytes = 65'536;

// How many requests are worked on at once: about as many as there are processors. Dozens of threads
// that stand in line for the ORB's one lock and the trader's would change places at each lock. Who
// has waited for a millisecond goes on anyway, so that one that waits for another broker holds up
// nobody.
//
// Threads: all may call.
class RequestTurns {
 public:
  bool Take() { return free_.try_acquire_for(std::chrono::milliseconds(1)); }
  void Give() { free_.release(); }

 private:
  std::counting_semaphore<> free_{1 + static_cast<int>(std::thread::hardware_concurrency())};
};

class CheckedConnection;
using Clock = std::chrono::steady_clock;

// The connections of an endpoint. Those without a thread of their own wait here for the rest of
// their messages. Threads: all may call.
class ConnectionTable {
 public:
  explicit ConnectionTable(std::size_t limit) : limit_(limit) {}

  void Add(CheckedConnection* connection);
  void Remove(CheckedConnection* connection);
  // There are bytes to be read: whether the ORB shall read now. If not, they were taken, and more
  // are needed.
  bool Readable(CheckedConnection* connection);
  RequestTurns& turns() { return turns_; }

 private:
  void DropLate(Clock::time_point now);
  void DropSilent();

  std::size_t limit_;
  RequestTurns turns_;
  std::mutex mutex_;
  // With the time since when its message has been coming, or the epoch.
  std::map<CheckedConnection*, Clock::time_point> connections_;
};

// One that a client made.
class CheckedConnection : public orb::Connection {
 public:
  CheckedConnection(std::unique_ptr<orb::TlsChannel> channel, omni::SocketHandle_t socket,
                    omni::SocketCollection* collection, std::shared_ptr<ConnectionTable> table);
  ~CheckedConnection() override;

  int Recv(void* buffer, std::size_t size, const omni_time_t& deadline) override;
  int Send(void* buffer, std::size_t size, const omni_time_t& deadline) override;
  // Takes what has come, without waiting. True when the ORB would not have to wait.
  bool Gather();
  // After Gather() was false: what came is a part of a message.
  bool has_begun() const { return incoming_.has_begun(); }
  // Ends it; the ORB then lets go of it.
  void Drop();
  // When bytes came last, or the connection.
  Clock::time_point heard() const { return Clock::time_point(Clock::duration(heard_.load())); }

 private:
  void Hear() { heard_ = Clock::now().time_since_epoch().count(); }
  void TakeTurn();
  void GiveTurn();

  std::shared_ptr<ConnectionTable> table_;
  std::atomic<Clock::rep> heard_ = Clock::now().time_since_epoch().count();
  std::mutex mutex_;
  orb::IncomingMessage incoming_{kMessageBytes + kGiopHeaderBytes};
  bool checked_ = false;
  std::atomic<bool> has_turn_ = false;  // from a request to its reply
};

// One that the broker made.
class CheckedActiveConnection : public orb::ActiveConnection {
 public:
  using orb::ActiveConnection::ActiveConnection;

  int Send(void* buffer, std::size_t size, const omni_time_t& deadline) override;
  int Recv(void* buffer, std::size_t size, const omni_time_t& deadline) override;

 private:
  std::mutex mutex_;
  ReplyCheck replies_;
  orb::IncomingMessage incoming_{kMessageBytes + kGiopHeaderBytes};
};

}  // namespace gsv::broker
