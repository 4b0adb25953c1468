// Tests an ORB with raw connections. A process can have only one ORB at a time, so each test starts
// and ends the ORB.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstring>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include "gsv/orb/orb.h"
#include "gsv/orb/testing/raw_message.h"
#include "gsv/orb/transport/object_addresses.h"
#include "idl/behaviour.hh"

namespace gsv::orb {
namespace {

using namespace std::chrono_literals;

// A factory whose calls block until the test calls Open().
class BlockingFactory final : public POA_sba::AgentBehaviourFactory {
 public:
  sba::AgentBehaviour_ptr create() override {
    std::unique_lock lock(mutex_);
    ++inside_;
    most_ = std::max(most_, inside_);
    changed_.notify_all();
    changed_.wait(lock, [this] { return is_open_; });
    --inside_;
    return sba::AgentBehaviour::_nil();
  }
  void Open() {
    const std::lock_guard lock(mutex_);
    is_open_ = true;
    changed_.notify_all();
  }
  void AwaitInside(int count) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return inside_ >= count; });
  }
  int most() {
    const std::lock_guard lock(mutex_);
    return most_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool is_open_ = false;
  int inside_ = 0, most_ = 0;
};

std::string Number(std::uint32_t value) { return RawCdr().ULong(value).bytes(); }

class MessageTransportTest : public ::testing::Test {
 public:
  ~MessageTransportTest() override {
    door_->Open();
    for (const int connection : connections_) close(connection);
    if (!CORBA::is_nil(orb_)) orb_->destroy();
  }

 protected:
  // Starts the ORB, which serves a BlockingFactory.
  void Start(const OrbOptions& options = {}) {
    orb_ = *StartOrb(options);
    const PortableServer::POA_var poa = RootPoa(orb_);
    const PortableServer::ObjectId_var id = poa->activate_object(door_);
    const CORBA::Object_var object = poa->id_to_reference(id);
    address_ = AddressOf(object);
    for (const std::string& address : AddressesIn(object)) {
      constexpr std::string_view kLocal = "giop:unix:";
      if (address.starts_with(kLocal)) local_ = address.substr(kLocal.size());
    }
    key_ = KeyOf(object);
  }

  static std::string KeyOf(CORBA::Object_ptr object);

  int Connect() {
    const int connection = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(static_cast<std::uint16_t>(std::stoi(address_.substr(10))));
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(connect(connection, reinterpret_cast<sockaddr*>(&to), sizeof to), 0) << address_;
    connections_.push_back(connection);
    return connection;
  }
  // Connects to the ORB's Unix domain socket.
  int ConnectLocally() {
    const int connection = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_un to{};
    to.sun_family = AF_UNIX;
    local_.copy(to.sun_path, sizeof to.sun_path - 1);
    EXPECT_EQ(connect(connection, reinterpret_cast<sockaddr*>(&to), sizeof to), 0) << local_;
    connections_.push_back(connection);
    return connection;
  }
  static void Send(int connection, const std::string& bytes) {
    std::size_t sent = 0;
    while (sent < bytes.size()) {
      const ssize_t count =
          send(connection, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
      if (count <= 0) return;  // the ORB closed the connection
      sent += static_cast<std::size_t>(count);
    }
  }
  // Waits until the ORB, which is in this process, has begun to read the last `size` bytes of a
  // connection.
  static void AwaitReading(int connection, int size) {
    sockaddr_in own{};
    socklen_t length = sizeof own;
    getsockname(connection, reinterpret_cast<sockaddr*>(&own), &length);
    for (int unread = size; unread >= size; std::this_thread::yield()) {
      unread = 0;  // the ORB may have closed the connection
      for (int each = 3; each < 200; ++each) {
        sockaddr_in peer{};
        length = sizeof peer;
        if (getpeername(each, reinterpret_cast<sockaddr*>(&peer), &length) != 0) continue;
        if (peer.sin_family == AF_INET && peer.sin_port == own.sin_port)
          ioctl(each, FIONREAD, &unread);
      }
    }
  }
  // Returns the number of the request that is answered; nullopt if the connection ends.
  static std::optional<std::uint32_t> Answer(int connection) {
    char header[12];
    if (recv(connection, header, 12, MSG_WAITALL) != 12) return std::nullopt;
    std::uint32_t size = 0;
    std::memcpy(&size, header + 8, 4);
    std::string body(size, '\0');
    if (recv(connection, body.data(), size, MSG_WAITALL) != static_cast<ssize_t>(size))
      return std::nullopt;
    std::uint32_t number = 0;
    std::memcpy(&number, body.data(), 4);
    return number;
  }

  // Returns the bytes after the header of a call of create(). `padding` is a number of meaningless
  // bytes.
  std::string Call(std::uint32_t number, std::size_t padding = 0) const {
    RawCdr body = RawCdr().ULong(number).Octet(3).Octet(0).Octet(0).Octet(0).ULong(0).Octets(key_);
    body.String("create").ULong(padding > 0 ? 1 : 0);
    if (padding > 0) body.ULong(0x12345678).Octets(std::string(padding, 'x'));
    return body.bytes();
  }

  CORBA::ORB_var orb_;
  PortableServer::Servant_var<BlockingFactory> door_ = new BlockingFactory;
  std::string address_, local_, key_;
  std::vector<int> connections_;
};

std::string MessageTransportTest::KeyOf(CORBA::Object_ptr object) {
  cdrMemoryStream stream;
  CORBA::Object::_marshalObjRef(object, stream);
  // The reference has a type id and profiles. The first profile has version, host, port and key.
  const auto skip_string = [&] { CORBA::String_var(stream.unmarshalRawString()); };
  skip_string();
  CORBA::ULong profiles = 0, tag = 0;
  profiles <<= stream;
  tag <<= stream;
  _CORBA_Unbounded_Sequence_Octet profile;
  profile <<= stream;
  cdrEncapsulationStream inner(profile);
  inner.unmarshalOctet();
  inner.unmarshalOctet();
  const CORBA::String_var host = inner.unmarshalRawString();
  CORBA::UShort port = 0;
  port <<= inner;
  _CORBA_Unbounded_Sequence_Octet key;
  key <<= inner;
  return {reinterpret_cast<const char*>(key.get_buffer()), key.length()};
}

// omniORB 4.2.5 alone would use two threads for this call, and crash.
TEST_F(MessageTransportTest, RepeatedFragmentDuringItsCallIsHarmless) {
  Start();
  for (int round = 0; round < 5; ++round) {
    const int connection = Connect();
    const std::string call = Call(1, 100);
    const std::string last = RawMessage(MessageType::kFragment, Number(1) + call.substr(60));
    Send(connection, RawMessage(MessageType::kRequest, call.substr(0, 60), true) + last);
    door_->AwaitInside(round + 1);
    Send(connection, last);
    AwaitReading(connection, static_cast<int>(last.size()));
  }
  door_->Open();
  const int another = Connect();
  Send(another, RawMessage(MessageType::kRequest, Call(3)));
  EXPECT_EQ(Answer(another), 3u);
}

TEST_F(MessageTransportTest, JoinsFragmentsAndIgnoresCancelRequests) {
  Start();
  const int connection = Connect();
  const std::string call = Call(1, 100);
  Send(connection, RawMessage(MessageType::kRequest, call.substr(0, 4), true) +
                       RawMessage(MessageType::kFragment, Number(1) + call.substr(4, 72), true) +
                       RawMessage(MessageType::kFragment, Number(1) + call.substr(76)));
  door_->AwaitInside(1);
  Send(connection, RawMessage(MessageType::kCancelRequest, Number(1)) +
                       RawMessage(MessageType::kCancelRequest, Number(1)));
  door_->Open();
  EXPECT_EQ(Answer(connection), 1u);
  Send(connection, RawMessage(MessageType::kRequest, Call(2)));
  EXPECT_EQ(Answer(connection), 2u);
}

TEST_F(MessageTransportTest, LocalSocketsJoinFragmentsAndLimitTheSizeOfMessages) {
  OrbOptions options;
  options.local_socket = true;
  options.max_message_bytes = 10'000;
  Start(options);
  door_->Open();
  const int connection = ConnectLocally();
  const std::string call = Call(1, 100);
  Send(connection, RawMessage(MessageType::kRequest, call.substr(0, 60), true) +
                       RawMessage(MessageType::kFragment, Number(1) + call.substr(60)));
  EXPECT_EQ(Answer(connection), 1u);
  Send(connection, RawMessage(MessageType::kRequest, Call(2, 20'000)));
  EXPECT_EQ(Answer(connection), std::nullopt);
}

std::atomic<int> requests_seen = 0;

TEST_F(MessageTransportTest, CheckSeesEachRequestOnce) {
  requests_seen = 0;
  OrbOptions options;
  options.check_request = [](std::string& message) {
    EXPECT_EQ(message.substr(0, 4), "GIOP");
    ++requests_seen;
  };
  Start(options);
  door_->Open();
  const int connection = Connect();
  const std::string call = Call(1, 100);
  Send(connection, RawMessage(MessageType::kRequest, call.substr(0, 60), true) +
                       RawMessage(MessageType::kFragment, Number(1) + call.substr(60)) +
                       RawMessage(MessageType::kCancelRequest, Number(1)));
  EXPECT_EQ(Answer(connection), 1u);
  Send(connection, RawMessage(MessageType::kRequest, Call(2)));
  EXPECT_EQ(Answer(connection), 2u);
  EXPECT_EQ(requests_seen, 2);
}

TEST_F(MessageTransportTest, MessageIsReadUpToItsLength) {
  OrbOptions options;
  options.max_message_bytes = 10'000;
  Start(options);
  door_->Open();
  const std::size_t around = RawMessage(MessageType::kRequest, Call(1, 4)).size() - 4;
  const int connection = Connect();
  Send(connection, RawMessage(MessageType::kRequest, Call(1, 10'000 - around)));
  EXPECT_EQ(Answer(connection), 1u);
  Send(connection, RawMessage(MessageType::kRequest, Call(2, 10'001 - around)));
  EXPECT_EQ(Answer(connection), std::nullopt);
  // max_message_bytes limits the whole message, also if it is sent in fragments.
  const int another = Connect();
  const std::string call = Call(3, 10'001 - around);
  Send(another, RawMessage(MessageType::kRequest, call.substr(0, 5000), true) +
                    RawMessage(MessageType::kFragment, Number(3) + call.substr(5000)));
  EXPECT_EQ(Answer(another), std::nullopt);
}

TEST_F(MessageTransportTest, IncompleteMessageEndsItsConnection) {
  OrbOptions options;
  options.message_time = 1s;
  Start(options);
  door_->Open();
  const int silent = Connect(), halting = Connect();
  Send(halting, RawMessage(MessageType::kRequest, Call(1)).substr(0, 30));
  EXPECT_EQ(Answer(halting), std::nullopt);
  // Clients may be silent between messages.
  Send(silent, RawMessage(MessageType::kRequest, Call(2)));
  EXPECT_EQ(Answer(silent), 2u);
}

TEST_F(MessageTransportTest, ConnectionServesSixteenCallsConcurrently) {
  Start();
  const int connection = Connect();
  for (std::uint32_t number = 1; number <= 20; ++number) {
    Send(connection, RawMessage(MessageType::kRequest, Call(number)));
  }
  door_->AwaitInside(16);
  const int another = Connect();
  Send(another, RawMessage(MessageType::kRequest, Call(1)));
  door_->AwaitInside(17);  // another connection is not delayed
  door_->Open();
  for (int count = 0; count < 20; ++count) EXPECT_TRUE(Answer(connection));
  EXPECT_EQ(door_->most(), 17);
}

TEST_F(MessageTransportTest, UnansweredCallEndsWithATimeout) {
  OrbOptions options;
  options.call_timeout = 300ms;
  Start(options);
  // A server that accepts connections, but never sends anything.
  const int listener = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  connections_.push_back(listener);
  sockaddr_in here{};
  here.sin_family = AF_INET;
  here.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t length = sizeof here;
  ASSERT_EQ(bind(listener, reinterpret_cast<sockaddr*>(&here), length), 0);
  ASSERT_EQ(listen(listener, 4), 0);
  getsockname(listener, reinterpret_cast<sockaddr*>(&here), &length);
  const std::string silent =
      "corbaloc::1.2@127.0.0.1:" + std::to_string(ntohs(here.sin_port)) + "/silent";
  const CORBA::Object_var object = orb_->string_to_object(silent.c_str());
  EXPECT_THROW((void)object->_non_existent(), CORBA::SystemException);
}

}  // namespace
}  // namespace gsv::orb
