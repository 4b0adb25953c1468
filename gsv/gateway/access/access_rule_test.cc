#include "gsv/gateway/access/access_rule.h"

#include <gtest/gtest.h>

namespace gsv::gateway {
namespace {

const AccessRule& Local() {
  static const AccessRule kRule("127.0.0.1", 8080, {"robot.lan"}, {"https://app.example.org"});
  return kRule;
}

TEST(AccessRule, AllowsNamesOfThisMachineWithThePort) {
  for (const char* host :
       {"127.0.0.1:8080", "localhost:8080", "LocalHost:8080", "[::1]:8080", "robot.lan:8080"}) {
    EXPECT_TRUE(Local().Check(host, "")) << host;
    EXPECT_TRUE(Local().Check(host, "http://" + std::string(host))) << host;
  }
  EXPECT_TRUE(Local().Check("localhost:8080", "https://app.example.org"));
}

TEST(AccessRule, RefusesOtherNamesAndPorts) {
  for (const char* host : {"", "127.0.0.1", "127.0.0.1:80", "evil.example:8080",
                           "127.0.0.1:8080.evil", "localhost:8080 "}) {
    EXPECT_FALSE(Local().Check(host, "")) << host;
  }
}

TEST(AccessRule, RefusesPagesOfOtherOrigins) {
  for (const char* origin :
       {"null", "http://evil.example", "https://localhost:8080", "http://localhost:5173",
        "http://localhost", "http://localhost:8080/"}) {
    const base::Status status = Local().Check("localhost:8080", origin);
    ASSERT_FALSE(status) << origin;
    EXPECT_NE(status.error().message.find("http://127.0.0.1:8080/"), std::string::npos);
  }
}

TEST(AccessRule, AcceptsAnyIpAddressButNoOtherNameIfAllAddressesAreServed) {
  const AccessRule rule("lab-pc", 8080, {}, {}, true);
  for (const char* host : {"192.168.1.7:8080", "[fe80::1]:8080", "lab-pc:8080"}) {
    EXPECT_TRUE(rule.Check(host, "")) << host;
    EXPECT_TRUE(rule.Check(host, "http://" + std::string(host))) << host;
    EXPECT_FALSE(rule.Check(host, "http://192.168.1.8:8080")) << host;
  }
  for (const char* host : {"evil.example:8080", "192.168.1.7", "192.168.1.7:80", "192.168.1:8080",
                           "[]:8080", ":8080"}) {
    EXPECT_FALSE(rule.Check(host, "")) << host;
  }
  EXPECT_FALSE(Local().Check("192.168.1.7:8080", ""));
}

TEST(AccessRule, AcceptsHostsWithoutAPortIfThePortIs80) {
  const AccessRule rule("::1", 80, {}, {});
  EXPECT_TRUE(rule.Check("[::1]", "http://localhost"));
  EXPECT_TRUE(rule.Check("127.0.0.1:80", ""));
}

}  // namespace
}  // namespace gsv::gateway
