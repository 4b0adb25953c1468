// For tests: TCP without an ORB.
#pragma once

#include <cstdint>
#include <string>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

namespace gsv::broker {

// Returns the address 127.0.0.1 with this port.
inline sockaddr_in Loopback(int port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

// Reads the next GIOP message, which must be little-endian. Returns an empty text if the peer
// closes the connection instead.
inline std::string ReadRawMessage(int socket) {
  std::string message(12, '\0');
  if (recv(socket, message.data(), 12, MSG_WAITALL) != 12) return "";
  std::uint32_t size = 0;
  for (std::size_t i = 12; i-- > 8;) size = size << 8 | static_cast<unsigned char>(message[i]);
  message.resize(12 + size);
  if (size > 0 && recv(socket, message.data() + 12, size, MSG_WAITALL) != size) return "";
  return message;
}

// A TCP connection to a port on 127.0.0.1.
class RawConnection {
 public:
  explicit RawConnection(int port) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    const sockaddr_in address = Loopback(port);
    EXPECT_EQ(connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  }
  ~RawConnection() { close(socket_); }
  RawConnection(const RawConnection&) = delete;
  RawConnection& operator=(const RawConnection&) = delete;

  // Sends the bytes as they are.
  void Send(const std::string& bytes) const {
    send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
  }
  // Waits for the next message, see ReadRawMessage().
  std::string Read() const { return ReadRawMessage(socket_); }

 private:
  int socket_;
};

}  // namespace gsv::broker
