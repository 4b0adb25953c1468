#include "apps/gsv/serving/listeners.h"

#include <gtest/gtest.h>

namespace gsv::app {
namespace {

// The columns are as in proc(5). Addresses are in the byte order of this machine.
constexpr const char* kTable =
    "  sl  local_address rem_address   st tx_queue rx_queue tr tm->when retrnsmt   uid  timeout "
    "inode\n"
    "   0: 0100007F:1F90 00000000:0000 0A 00000000:00000000 00:00000000 00000000  1000        0 "
    "4711 1 0000000000000000 100 0 0 10 0\n"
    "   1: 00000000:0016 00000000:0000 0A 00000000:00000000 00:00000000 00000000     0        0 "
    "12 1 0000000000000000 100 0 0 10 0\n"
    "   2: 0100007F:1F90 0100007F:C350 01 00000000:00000000 00:00000000 00000000  1000        0 "
    "4712 1 0000000000000000 20 4 30 10 -1\n"
    "   3: nonsense\n"
    "   4: 0100007:1F90 00000000:0000 0A 00000000:00000000 00:00000000 00000000  1000        0 "
    "13 1 0000000000000000 100 0 0 10 0\n";

TEST(SocketTable, ListsListeningSockets) {
  const auto sockets = ParseSocketTable(kTable);
  ASSERT_EQ(sockets.size(), 2u);
  EXPECT_EQ(sockets[0].first, 4711u);
  EXPECT_EQ(sockets[0].second.address, "127.0.0.1");
  EXPECT_EQ(sockets[0].second.port, 8080);
  EXPECT_EQ(sockets[1].first, 12u);
  EXPECT_EQ(sockets[1].second.address, "0.0.0.0");
  EXPECT_EQ(sockets[1].second.port, 22);
}

TEST(SocketTable, ReadsIpv6Addresses) {
  const auto sockets = ParseSocketTable(
      "heading\n   0: 00000000000000000000000001000000:1F90 "
      "00000000000000000000000000000000:0000 0A 00000000:00000000 00:00000000 00000000  1000 0 "
      "99 1 0000000000000000 100 0 0 10 0\n");
  ASSERT_EQ(sockets.size(), 1u);
  EXPECT_EQ(sockets[0].second.address, "::1");
  EXPECT_TRUE(ParseSocketTable("").empty());
  EXPECT_TRUE(ParseDdsSockets("", 0).empty());
}

TEST(Listener, IsLocalOnLoopbackAndInTheFileSystem) {
  for (const char* local : {"127.0.0.1", "127.1.2.3", "::1", "::ffff:127.0.0.1"})
    EXPECT_TRUE((Listener{local, 80}.IsLocal())) << local;
  for (const char* open : {"0.0.0.0", "::", "10.0.0.1", "1.127.0.0", "fe80::1"})
    EXPECT_FALSE((Listener{open, 80}.IsLocal())) << open;
  EXPECT_TRUE((Listener{"/run/socket", 0}.IsLocal()));
}

TEST(Listeners, FindsDdsSocketsAtThePortsOfTheDomain) {
  const std::string table =
      "  sl  local_address rem_address   st tx_queue rx_queue tr tm->when retrnsmt   uid  timeout "
      "inode\n"
      "  10: 0100007F:1CF2 00000000:0000 07 00000000:00000000 00:00000000 00000000  1000        0 "
      "71\n"
      "  11: 00000000:1CE8 00000000:0000 07 00000000:00000000 00:00000000 00000000  1000        0 "
      "72\n"
      "  12: 00000000:0035 00000000:0000 07 00000000:00000000 00:00000000 00000000  1000        0 "
      "73\n"
      "  13: 00000000:FF82 00000000:0000 07 00000000:00000000 00:00000000 00000000  1000        0 "
      "74\n";
  const auto sockets = ParseDdsSockets(table, 0);
  ASSERT_EQ(sockets.size(), 2u);
  EXPECT_EQ(sockets[0].second.port, 7410);
  EXPECT_TRUE(sockets[0].second.IsLocal());
  EXPECT_EQ(sockets[1].second.port, 7400);
  EXPECT_FALSE(sockets[1].second.IsLocal());
  EXPECT_TRUE(sockets[1].second.is_dds);
  EXPECT_TRUE(ParseDdsSockets(table, 1).empty());
  const auto last = ParseDdsSockets(table, 232);  // the highest domain
  ASSERT_EQ(last.size(), 1u);
  EXPECT_EQ(last[0].second.port, 65410);
}

}  // namespace
}  // namespace gsv::app
