// omniORB's TCP connections, by TLS where they have a channel.
//
// Whoever includes it needs omniORB's internal headers, see CMakeLists.txt.
#pragma once

#include <cerrno>
#include <memory>
#include <utility>

#include <sys/socket.h>

// Each of omniORB's own headers needs those before it.
// clang-format off
#include <omniORB4/CORBA.h>
#include <omniORB4/giopEndpoint.h>
#include <tcpSocket.h>
#include <SocketCollection.h>
#include <omniORB4/tcpConnection.h>
// clang-format on

#include "gsv/orb/tls_channel.h"

namespace gsv::orb {

// Of an end of a connection by TLS, told by getsockname() or getpeername(). A peer that has gone
// has no address any more; the ORB wants one all the same.
template <typename Ask>
CORBA::String_var TlsAddressOf(omni::SocketHandle_t socket, const Ask& ask) {
  sockaddr_storage address{};
  socklen_t length = sizeof address;
  auto* const end = reinterpret_cast<sockaddr*>(&address);
  if (ask(socket, end, &length) != 0) return "giop:ssl:255.255.255.255:65535";
  return omni::tcpSocket::addrToURI(end, "giop:ssl");
}

template <typename Base>
class MaybeTls : public Base {
 public:
  // Without a channel it is TCP alone; with one, its handshake is done.
  template <typename... Arguments>
  explicit MaybeTls(std::unique_ptr<TlsChannel> channel, omni::SocketHandle_t socket,
                    Arguments... arguments)
      : Base(socket, arguments...), channel_(std::move(channel)) {
    if (channel_ == nullptr) return;
    own_address_ = TlsAddressOf(socket, getsockname);
    peer_address_ = TlsAddressOf(socket, getpeername);
  }

  int Recv(void* buffer, std::size_t size, const omni_time_t& deadline) override {
    if (channel_ == nullptr) return Base::Recv(buffer, size, deadline);
    return channel_->Receive(buffer, size, deadline);
  }
  int Send(void* buffer, std::size_t size, const omni_time_t& deadline) override {
    if (channel_ == nullptr) return Base::Send(buffer, size, deadline);
    return channel_->Send(buffer, size, deadline);
  }
  void Shutdown() override {
    if (channel_ != nullptr) channel_->Close();
    Base::Shutdown();
  }
  void setSelectable(int now, CORBA::Boolean data_in_buffer) override {
    Base::setSelectable(now, data_in_buffer || HasBytes());
  }
  CORBA::Boolean Peek() override { return HasBytes() || Base::Peek(); }
  const char* myaddress() override {
    return channel_ != nullptr ? own_address_.in() : Base::myaddress();
  }
  const char* peeraddress() override {
    return channel_ != nullptr ? peer_address_.in() : Base::peeraddress();
  }

 protected:
  // As recv() and send() with MSG_DONTWAIT.
  ssize_t TryReceive(void* buffer, std::size_t size) {
    if (channel_ != nullptr) return channel_->TryReceive(buffer, size);
    return recv(this->pd_socket, buffer, size, MSG_DONTWAIT);
  }
  ssize_t TrySend(const void* buffer, std::size_t size) {
    if (channel_ != nullptr) return channel_->TrySend(buffer, size);
    return send(this->pd_socket, buffer, size, MSG_DONTWAIT | MSG_NOSIGNAL);
  }

 private:
  bool HasBytes() { return channel_ != nullptr && channel_->HasBytes(); }

  const std::unique_ptr<TlsChannel> channel_;
  CORBA::String_var own_address_, peer_address_;  // of TLS
};

using Connection = MaybeTls<omni::tcpConnection>;              // made by a client
using ActiveConnection = MaybeTls<omni::tcpActiveConnection>;  // made by this process

}  // namespace gsv::orb
