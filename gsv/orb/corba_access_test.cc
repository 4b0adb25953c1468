#include "gsv/orb/corba_access.h"

#include <cstdlib>

#include <gtest/gtest.h>

#include "gsv/orb/transport/transports.h"

namespace gsv::orb {
namespace {

class CorbaAccessTest : public ::testing::Test {
 protected:
  void TearDown() override {
    for (const char* name :
         {"GSV_CORBA_CERTIFICATE", "GSV_CORBA_KEY", "GSV_CORBA_AUTHORITY", "GSV_INSECURE_CORBA"}) {
      unsetenv(name);
    }
  }
  static void Set(const char* name, const char* value) { setenv(name, value, 1); }
};

TEST_F(CorbaAccessTest, FindsKeyAndAuthorityBesideTheCertificate) {
  EXPECT_FALSE(AccessFromEnvironment().certificate);
  Set("GSV_CORBA_CERTIFICATE", "/tls/arm.left.pem");
  const CorbaCertificate beside{"/tls/arm.left.pem", "/tls/arm.left-key.pem", "/tls/ca.pem"};
  EXPECT_EQ(AccessFromEnvironment().certificate, beside);
  Set("GSV_CORBA_KEY", "/keys/arm");
  Set("GSV_CORBA_AUTHORITY", "/group.pem");
  const CorbaCertificate elsewhere{"/tls/arm.left.pem", "/keys/arm", "/group.pem"};
  EXPECT_EQ(AccessFromEnvironment().certificate, elsewhere);
}

TEST_F(CorbaAccessTest, RemoteAccessNeedsACertificateOrTheInsecureOption) {
  for (const char* host : {"", "0.0.0.0", "::", "10.0.0.7", "lab-7"}) {
    EXPECT_FALSE(CheckListening({}, host)) << host;
    EXPECT_TRUE(CheckListening({CorbaCertificate{}, false}, host)) << host;
    EXPECT_TRUE(CheckListening({std::nullopt, true}, host)) << host;
  }
  EXPECT_TRUE(CheckListening({}, "127.0.0.1"));
  EXPECT_FALSE(AccessFromEnvironment().is_insecure);
  Set("GSV_INSECURE_CORBA", "0");
  EXPECT_FALSE(AccessFromEnvironment().is_insecure);
  Set("GSV_INSECURE_CORBA", "1");
  EXPECT_TRUE(AccessFromEnvironment().is_insecure);
}

TEST_F(CorbaAccessTest, RecognisesLoopbackAddresses) {
  for (const char* host : {"127.0.0.1", "127.9.8.7", "::1", "localhost"}) {
    EXPECT_TRUE(IsLoopback(host)) << host;
  }
  for (const char* host : {"", "10.0.0.1", "128.0.0.1", "::", "127.example.org", "lab-7"}) {
    EXPECT_FALSE(IsLoopback(host)) << host;
  }
}

TEST_F(CorbaAccessTest, FailsForInvalidFiles) {
  Set("GSV_CORBA_CERTIFICATE", "/nowhere/lab.pem");
  const auto access = PrepareAccess("127.0.0.1", 0);
  ASSERT_FALSE(access);
  EXPECT_NE(access.error().Sentence().find("/nowhere/lab.pem"), std::string::npos);
  EXPECT_FALSE(SpeaksTls());
}

}  // namespace
}  // namespace gsv::orb
