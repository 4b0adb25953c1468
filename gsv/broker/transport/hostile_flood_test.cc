// A broker that is flooded must still answer other clients, and must not grow.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <random>
#include <thread>

#include <arpa/inet.h>
#include <gmock/gmock.h>
#include <netinet/in.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include "gsv/broker/testing/broker_fixture.h"
#include "gsv/broker/testing/raw_connection.h"
#include "gsv/orb/testing/raw_message.h"

namespace gsv::broker {
namespace {

using orb::RawCdr;
using orb::RawRequest;

using Clock = std::chrono::steady_clock;

// A client that calls all the time and must get each answer.
class Bystander {
 public:
  explicit Bystander(CosTrading::Lookup_ptr lookup) {
    // The client has its own reference, because a time limit belongs to a reference.
    const CORBA::String_var name = TestOrb()->object_to_string(lookup);
    lookup_ = CosTrading::Lookup::_narrow(CORBA::Object_var(TestOrb()->string_to_object(name)));
    omniORB::setClientCallTimeout(lookup_, 10'000);
    thread_ = std::jthread([this](const std::stop_token& stop) { Ask(stop); });
  }
  // Ends the calls. Returns the 99th percentile of the waits, in milliseconds.
  double End() {
    thread_.request_stop();
    thread_.join();
    std::sort(waits_.begin(), waits_.end());
    return waits_.empty() ? 0 : waits_[waits_.size() * 99 / 100];
  }

 private:
  void Ask(const std::stop_token& stop) {
    CosTrading::Lookup::SpecifiedProps desired;
    desired._d(CosTrading::Lookup::all);
    while (!stop.stop_requested()) {
      CosTrading::OfferSeq_var offers;
      CosTrading::OfferIterator_var rest;
      CosTrading::PolicyNameSeq_var limits;
      const auto start = Clock::now();
      try {
        lookup_->query("Robot", "", "", {}, desired, 1, offers, rest, limits);
        EXPECT_EQ(offers->length(), 1u);
      } catch (const CORBA::SystemException& exception) {
        ADD_FAILURE() << "was not answered: " << exception._name();
      }
      waits_.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
    }
  }

  CosTrading::Lookup_var lookup_;
  std::vector<double> waits_;
  std::jthread thread_;
};

class HostileFloodTest : public BrokerFixture {
 protected:
  HostileFloodTest() {
    AddType("Robot");
    Export("Robot", {{"n", Value::Long(1)}});
  }

  // Returns -1 if the broker accepts no more connections.
  int Connect() {
    const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(std::stoi(broker_.port())));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (connect(socket, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0) return socket;
    close(socket);
    return -1;
  }
  void Send(const std::string& bytes) {
    const int socket = Connect();
    if (socket < 0) return;
    send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    close(socket);
  }

  // Records the bystander's waits, checks how much memory the broker uses, and connects once more.
  void Judge(Bystander& bystander, const char* what) {
    const double wait_ms = bystander.End();
    std::ifstream statm("/proc/" + std::to_string(broker_.pid()) + "/statm");
    std::size_t pages = 0;
    std::size_t resident = 0;
    statm >> pages >> resident;
    const std::size_t mib = resident * 4096 >> 20;
    RecordProperty(std::string(what) + "_p99_ms", std::to_string(wait_ms));
    RecordProperty(std::string(what) + "_resident_mib", std::to_string(mib));
    std::printf("%s: others waited %.2f ms (p99), the broker takes %zu MiB\n", what, wait_ms, mib);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    EXPECT_LT(mib, 200u);
#endif
    // A client that connects at this time must be served as well.
    const CORBA::Object_var object = TestOrb()->string_to_object(broker_.reference().c_str());
    EXPECT_FALSE(object->_non_existent());
  }
};

// Returns a message with a header that is usually valid, and with a random body.
std::string RandomMessage(std::mt19937& random) {
  const std::size_t size = random() % 600;
  std::string message = "GIOP";
  message += '\x01';
  message += static_cast<char>(random() % 4);  // the minor version of GIOP
  message += static_cast<char>(random() % 4);  // byte order and fragments
  message += static_cast<char>(random() % 9);  // the kind of the message
  const std::size_t claimed = random() % 4 == 0 ? random() : size;
  for (int i = 0; i < 4; ++i) message += static_cast<char>(claimed >> (8 * i));
  for (std::size_t i = 0; i < size; ++i) {
    message += static_cast<char>(random() % 3 == 0 ? random() : random() % 5);
  }
  if (random() % 8 == 0) message[random() % message.size()] = static_cast<char>(random());
  if (random() % 4 == 0) message.resize(random() % message.size());
  return message;
}

TEST_F(HostileFloodTest, SurvivesRandomMessages) {
  Bystander bystander(lookup_);
  std::mt19937 random(6);
  for (int i = 0; i < 3000; ++i) Send(RandomMessage(random));
  Judge(bystander, "random_messages");
}

// omniORB 4.2.5 alone would leak each unterminated string, in total 240 MB in this test.
TEST_F(HostileFloodTest, SurvivesUnterminatedStrings) {
  Bystander bystander(lookup_);
  const std::string text = RawCdr().Octets(std::string(60'000, 'a')).bytes();
  const RawConnection connection(std::stoi(broker_.port()));
  for (int i = 0; i < 4000; ++i) {
    connection.Send(RawRequest("TradingService", "_is_a", text));
    ASSERT_THAT(connection.Read(), testing::HasSubstr("CORBA/MARSHAL"));
  }
  Judge(bystander, "texts");
}

// omniORB 4.2.5 alone would close the connection and keep 9 kB each time. The broker skips the
// excess bytes.
TEST_F(HostileFloodTest, SurvivesRequestsWithExcessBytes) {
  Bystander bystander(lookup_);
  const std::string body =
      RawCdr().String("IDL:omg.org/CosTrading/Lookup:1.0").Octets(std::string(200, 'x')).bytes();
  const RawConnection connection(std::stoi(broker_.port()));
  for (int i = 0; i < 4000; ++i) {
    connection.Send(RawRequest("TradingService", "_is_a", body));
    ASSERT_FALSE(connection.Read().empty()) << i;
  }
  Judge(bystander, "long_requests");
}

TEST_F(HostileFloodTest, SurvivesTenThousandConnections) {
  Bystander bystander(lookup_);
  std::vector<int> open;
  for (int i = 0; i < 10'000; ++i) {
    const int socket = Connect();
    if (socket >= 0) open.push_back(socket);
    if (open.size() < 100) continue;
    for (const int each : open) close(each);
    open.clear();
  }
  for (const int each : open) close(each);
  Judge(bystander, "connections");
}

// The test opens more connections than the broker keeps. The broker closes the connections that
// have been silent longest.
TEST_F(HostileFloodTest, SurvivesManyIdleConnections) {
  rlimit descriptors{};
  getrlimit(RLIMIT_NOFILE, &descriptors);
  descriptors.rlim_cur = descriptors.rlim_max;
  setrlimit(RLIMIT_NOFILE, &descriptors);
  constexpr int kMoreThanKept = 4500;
  if (descriptors.rlim_cur < 2 * kMoreThanKept) GTEST_SKIP() << "too few descriptors";
  Bystander bystander(lookup_);
  std::vector<int> held;
  held.reserve(kMoreThanKept);
  for (int i = 0; i < kMoreThanKept; ++i) held.push_back(Connect());
  char byte = 0;
  EXPECT_EQ(recv(held.front(), &byte, 1, 0), 0);
  Judge(bystander, "held_connections");
  for (const int each : held) close(each);
}

TEST_F(HostileFloodTest, SurvivesSlowSenders) {
  Bystander bystander(lookup_);
  constexpr int kSenders = 200;
  std::vector<int> slow;
  slow.reserve(kSenders);
  for (int i = 0; i < kSenders; ++i) slow.push_back(Connect());
  const std::string message = std::string("GIOP\x01\x02\x01\x00\x40\x00\x00\x00", 12);
  for (const char byte : message) {
    for (const int socket : slow) send(socket, &byte, 1, MSG_NOSIGNAL);
    EXPECT_EQ(Query("Robot").offers->length(), 1u);
  }
  Judge(bystander, "slow_senders");
  for (const int socket : slow) close(socket);
}

// There are more slow connections than the broker has threads. Later clients must still be served.
TEST_F(HostileFloodTest, SurvivesMoreSlowSendersThanThreads) {
  Bystander bystander(lookup_);
  constexpr int kSenders = 700;
  std::vector<int> slow;
  slow.reserve(kSenders);
  for (int i = 0; i < kSenders; ++i) slow.push_back(Connect());
  const std::string message = std::string("GIOP\x01\x02\x01\x00\x40\x00\x00\x00", 12);
  const auto drip = [&](char byte) {
    for (const int socket : slow) send(socket, &byte, 1, MSG_NOSIGNAL);
  };
  for (const char byte : message.substr(0, 4)) drip(byte);

  const RawCdr arguments =
      RawCdr().String("Robot").String("").String("").ULong(0).ULong(0).ULong(1);
  const std::string query = RawRequest("TradingService", "query", arguments.bytes());
  std::vector<double> waits;
  for (int i = 0; i < 50; ++i) {
    const auto start = Clock::now();
    const RawConnection new_client(std::stoi(broker_.port()));
    new_client.Send(query);
    EXPECT_NE(new_client.Read().find("IDL:omg.org/CosTradingDynamic"), std::string::npos);
    waits.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
  }
  RecordProperty("new_clients_max_ms",
                 std::to_string(*std::max_element(waits.begin(), waits.end())));
  Judge(bystander, "many_slow_senders");
  for (const int socket : slow) close(socket);
}

// Some clients repeat expensive queries.
TEST_F(HostileFloodTest, SurvivesExpensiveQueries) {
  for (std::int32_t i = 0; i < 2000; ++i) Export("Robot", {{"n", Value::Long(i)}});
  std::string constraint = "n + 1 == 0";
  for (int i = 0; i < 150; ++i) constraint += " or n * 2 == -1";
  Bystander bystander(lookup_);
  constexpr int kClients = 4, kQueries = 5;
  // The queries wait for each other. On a slow machine this takes longer than the ORB's limit for
  // clients.
  omniORB::setClientCallTimeout(lookup_, 300'000);
  std::atomic<int> answered{0};
  std::vector<std::jthread> greedy;
  greedy.reserve(kClients);
  for (int i = 0; i < kClients; ++i) {
    greedy.emplace_back([&] {
      try {
        for (int k = 0; k < kQueries; ++k, ++answered)
          EXPECT_EQ(Query("Robot", constraint).offers->length(), 0u);
      } catch (const CORBA::Exception& exception) {
        ADD_FAILURE() << "a greedy query raised " << exception._name();
      }
    });
  }
  greedy.clear();
  EXPECT_EQ(answered, kClients * kQueries);
  Judge(bystander, "greedy_queries");
}

}  // namespace
}  // namespace gsv::broker
