#include "gsv/broker/transport/checked_connection.h"

#include <algorithm>
#include <cerrno>
#include <utility>

namespace gsv::broker {
namespace {

// A message must have come this long after it began.
constexpr std::chrono::seconds kMessageTime{3};

omni_time_t Soon() {
  omni_time_t deadline;
  omni_thread::get_time(deadline, omni_time_t(kMessageTime.count(), 0));
  return deadline;
}

}  // namespace

void ConnectionTable::Add(CheckedConnection* connection) {
  const std::lock_guard lock(mutex_);
  if (connections_.size() >= limit_) DropSilent();
  connections_[connection] = {};
}

void ConnectionTable::Remove(CheckedConnection* connection) {
  const std::lock_guard lock(mutex_);
  connections_.erase(connection);
}

bool ConnectionTable::Readable(CheckedConnection* connection) {
  const std::lock_guard lock(mutex_);
  const auto found = connections_.find(connection);
  if (found == connections_.end()) return true;
  if (connection->Gather()) {
    found->second = {};
    return true;
  }
  const Clock::time_point now = Clock::now();
  if (!connection->has_begun()) {
    found->second = {};
  } else if (found->second == Clock::time_point()) {
    found->second = now;
  }
  DropLate(now);
  connection->setSelectable(1, false);
  return false;
}

void ConnectionTable::DropLate(Clock::time_point now) {
  for (const auto& [connection, incomplete] : connections_) {
    if (incomplete != Clock::time_point() && now - incomplete > kMessageTime) {
      connection->Shutdown();
    }
  }
}

void ConnectionTable::DropSilent() {
  const auto silent = std::min_element(
      connections_.begin(), connections_.end(),
      [](const auto& a, const auto& b) { return a.first->heard() < b.first->heard(); });
  silent->first->Drop();
}

CheckedConnection::CheckedConnection(std::unique_ptr<orb::TlsChannel> channel,
                                     omni::SocketHandle_t socket,
                                     omni::SocketCollection* collection,
                                     std::shared_ptr<ConnectionTable> table)
    : orb::Connection(std::move(channel), socket, collection), table_(std::move(table)) {
  table_->Add(this);
}

CheckedConnection::~CheckedConnection() {
  GiveTurn();
  table_->Remove(this);
}

void CheckedConnection::TakeTurn() {
  if (table_->turns().Take() && has_turn_.exchange(true)) table_->turns().Give();
}

void CheckedConnection::GiveTurn() {
  if (has_turn_.exchange(false)) table_->turns().Give();
}

int CheckedConnection::Send(void* buffer, std::size_t size, const omni_time_t& deadline) {
  GiveTurn();
  // The ORB's own way asks first whether there is room, which there nearly always is.
  const ssize_t sent = TrySend(buffer, size);
  return sent > 0 ? static_cast<int>(sent) : orb::Connection::Send(buffer, size, deadline);
}

int CheckedConnection::Recv(void* buffer, std::size_t size, const omni_time_t& deadline) {
  const std::lock_guard lock(mutex_);
  if (incoming_.assembly().empty()) GiveTurn();  // what came before wanted no reply
  omni_time_t until = deadline;
  while (!incoming_.IsThere()) {
    MessageAssembly& assembly = incoming_.assembly();
    // Clients may be silent between messages, not within one.
    if (assembly.empty()) {
      until = deadline;
    } else if (!until) {
      until = Soon();
    }
    const auto room = assembly.Next();
    // The rest of a message is mostly there with its header.
    ssize_t received = assembly.empty() ? -1 : TryReceive(room.bytes, room.size);
    if (received < 0) received = orb::Connection::Recv(room.bytes, room.size, until);
    if (received <= 0) return static_cast<int>(received);
    Hear();
    assembly.Take(static_cast<std::size_t>(received));
  }
  if (!std::exchange(checked_, true)) {
    TakeTurn();
    CheckRequest(incoming_.assembly().message());
  }
  const int handed_out = incoming_.HandOut(buffer, size);
  checked_ = incoming_.IsThere();
  return handed_out;
}

bool CheckedConnection::Gather() {
  const std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock) return true;  // a thread of the ORB reads
  while (!incoming_.IsThere()) {
    const auto room = incoming_.assembly().Next();
    const ssize_t received = TryReceive(room.bytes, room.size);
    if (received < 0 && errno == EINTR) continue;
    if (received < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) return false;
    if (received <= 0) return true;  // the ORB finds out why
    Hear();
    incoming_.assembly().Take(static_cast<std::size_t>(received));
  }
  return true;
}

void CheckedConnection::Drop() {
  Hear();  // the next time it is another's turn
  Shutdown();
}

int CheckedActiveConnection::Send(void* buffer, std::size_t size, const omni_time_t& deadline) {
  // The reply may come before this returns.
  const std::lock_guard lock(mutex_);
  const int sent = orb::ActiveConnection::Send(buffer, size, deadline);
  if (sent > 0) {
    replies_.Sending({static_cast<const char*>(buffer), size}, static_cast<std::size_t>(sent));
  }
  return sent;
}

int CheckedActiveConnection::Recv(void* buffer, std::size_t size, const omni_time_t& deadline) {
  while (!incoming_.IsThere()) {
    const auto room = incoming_.assembly().Next();
    const int received = orb::ActiveConnection::Recv(room.bytes, room.size, deadline);
    if (received <= 0) return received;
    incoming_.assembly().Take(static_cast<std::size_t>(received));
    if (!incoming_.IsThere()) continue;
    const std::lock_guard lock(mutex_);
    replies_.Check(incoming_.assembly().message());
  }
  return incoming_.HandOut(buffer, size);
}

}  // namespace gsv::broker
