#include "gsv/orb/transport/connection.h"

#include <cerrno>
#include <cstdio>
#include <utility>

#include <sys/socket.h>
#include <unistd.h>

namespace gsv::orb {
namespace {

// A collection for the sockets of outgoing connections. These sockets have no endpoint, and no
// thread polls them.
class Unwatched final : public omni::SocketCollection {
  CORBA::Boolean notifyReadable(omni::SocketHolder* /*holder*/) override { return true; }
};
omni::SocketCollection& UnwatchedSockets() {
  // never destroyed, because an ORB may outlive static objects
  static auto& collection = *new Unwatched;
  return collection;
}

// Returns the address of a socket. `ask` is getsockname() or getpeername(). A disconnected socket
// has no address, but the ORB requires a text.
template <typename Ask>
std::string AddressOfEnd(int socket, const char* scheme, const Ask& ask) {
  sockaddr_storage address{};
  socklen_t length = sizeof address;
  auto* const end = reinterpret_cast<sockaddr*>(&address);
  if (ask(socket, end, &length) != 0) return std::string(scheme) + ":255.255.255.255:65535";
  return CORBA::String_var(omni::tcpSocket::addrToURI(end, scheme)).in();
}

std::string WithNumber(const std::string& server) {
  static std::atomic<unsigned> count = 0;
  std::array<char, 16> number{};
  std::snprintf(number.data(), number.size(), " %08x", ++count);
  return server + number.data();
}

std::unique_ptr<ConnectionHooks> Make(const ConnectionPolicy::MakeHooks& make,
                                      ConnectionControl& connection) {
  return make ? make(connection) : nullptr;
}

}  // namespace

ConnectionAddresses AddressesOfTcp(int socket, const char* scheme) {
  return {AddressOfEnd(socket, scheme, getsockname), AddressOfEnd(socket, scheme, getpeername)};
}

ConnectionAddresses AddressesOfAcceptedLocal(const std::string& server) {
  return {server, WithNumber(server)};
}

ConnectionAddresses AddressesOfMadeLocal(const std::string& server) {
  return {WithNumber(server), server};
}

Connection::Connection(int socket, std::unique_ptr<Channel> channel, ConnectionAddresses addresses,
                       omni::SocketCollection& collection, const MessageLimits& limits)
    : SocketHolder(socket),
      channel_(std::move(channel)),
      addresses_(std::move(addresses)),
      message_time_(limits.time),
      incoming_(limits.bytes) {
  collection.addSocket(this);
}

Connection::Connection(int socket, std::unique_ptr<Channel> channel, ConnectionAddresses addresses,
                       omni::SocketCollection& collection, const ConnectionPolicy& policy)
    : Connection(socket, std::move(channel), std::move(addresses), collection, policy.limits) {
  is_accepted_ = true;
  hooks_ = Make(policy.accepted, *this);
}

Connection::Connection(int socket, std::unique_ptr<Channel> channel, ConnectionAddresses addresses,
                       const ConnectionPolicy& policy)
    : Connection(socket, std::move(channel), std::move(addresses), UnwatchedSockets(),
                 policy.limits) {
  hooks_ = Make(policy.made, *this);
}

Connection::~Connection() {
  hooks_.reset();
  SocketHolder::clearSelectable();
  pd_belong_to->removeSocket(this);
  channel_.reset();
  close(pd_socket);
}

void Connection::Shutdown() {
  channel_->Close();
  shutdown(pd_socket, SHUT_RDWR);
  is_shut_down_ = true;
}

void Connection::setSelectable(int now, CORBA::Boolean data_in_buffer) {
  SocketHolder::setSelectable(now, data_in_buffer || channel_->HasBytes());
}

CORBA::Boolean Connection::Peek() { return channel_->HasBytes() || SocketHolder::Peek(); }

int Connection::Send(void* buffer, std::size_t size, const omni_time_t& deadline) {
  if (hooks_ != nullptr) hooks_->OnSend({static_cast<const char*>(buffer), size});
  // A reply is sent even after the deadline, if the socket has space for the reply. There is nearly
  // always enough space. A request is not sent after the deadline.
  int sent = is_accepted_ ? static_cast<int>(channel_->TrySend(buffer, size)) : -1;
  if (sent <= 0) sent = channel_->Send(buffer, size, deadline);
  if (sent > 0 && hooks_ != nullptr) hooks_->OnSent(static_cast<std::size_t>(sent));
  return sent;
}

int Connection::Recv(void* buffer, std::size_t size, const omni_time_t& deadline) {
  if (is_shut_down_) return -1;
  if (!is_accepted_ && hooks_ == nullptr) return channel_->Receive(buffer, size, deadline);
  const base::MutexLock lock(mutex_);
  if (hooks_ != nullptr && incoming_.assembly().empty()) hooks_->OnWait();
  omni_time_t until = deadline;
  while (!incoming_.IsReady()) {
    // A client may be silent between messages, but not within a message.
    if (incoming_.assembly().empty()) {
      until = deadline;
    } else if (!until) {
      omni_thread::get_time(until, omni_time_t(message_time_.count(), 0));
    }
    const int received = ReadPiece(until);
    if (received <= 0) return received;
  }
  if (hooks_ != nullptr && incoming_.is_new()) hooks_->OnMessage(incoming_.assembly().message());
  return incoming_.HandOut(buffer, size);
}

int Connection::ReadPiece(const omni_time_t& deadline) {
  MessageAssembly& assembly = incoming_.assembly();
  const auto room = assembly.Next();
  // The rest of a message usually arrives with its header, so it is first read without waiting.
  ssize_t received = assembly.empty() ? -1 : channel_->TryReceive(room.bytes, room.size);
  if (received < 0) received = channel_->Receive(room.bytes, room.size, deadline);
  if (received <= 0) return static_cast<int>(received);
  if (hooks_ != nullptr) hooks_->OnBytes();
  assembly.Take(static_cast<std::size_t>(received));
  return static_cast<int>(received);
}

bool Connection::Gather() {
  if (!mutex_.try_lock()) return true;  // a thread of the ORB already reads
  const base::MutexLock lock(mutex_, std::adopt_lock);
  while (!incoming_.IsReady()) {
    const auto room = incoming_.assembly().Next();
    const ssize_t received = channel_->TryReceive(room.bytes, room.size);
    if (received < 0 && errno == EINTR) continue;
    if (received < 0)
      // the ORB will detect the error
      return errno != EAGAIN && errno != EWOULDBLOCK;
    if (hooks_ != nullptr) hooks_->OnBytes();
    incoming_.assembly().Take(static_cast<std::size_t>(received));
  }
  return true;
}

}  // namespace gsv::orb
