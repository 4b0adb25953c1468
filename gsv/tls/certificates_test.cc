#include "gsv/tls/certificates.h"

#include <cstdlib>
#include <fstream>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "gsv/base/temporary_folder.h"

namespace gsv::tls {
namespace {

using std::chrono::hours;

class CertificatesTest : public ::testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(MakeAuthority(folder(), {})); }
  const std::filesystem::path& folder() const { return folder_.path(); }
  base::Status Make(const std::string& name, const Validity& validity = {}) const {
    return MakeCertificate(folder(), {name, {"lab-7", "10.0.0.7", "::1"}, validity});
  }
  base::Status Check(const std::string& name) const {
    return CheckKeyPair(folder() / (name + ".pem"), folder() / (name + "-key.pem"));
  }
  // Checks with the program openssl, which is independent of this code. Returns its exit code.
  int OpenSsl(const std::string& arguments) const {
    return std::system(
        ("cd " + folder().string() + " && openssl " + arguments + " >/dev/null 2>&1").c_str());
  }

  const base::TemporaryFolder folder_ = *base::TemporaryFolder::Make("gsv-certificates");
};

TEST_F(CertificatesTest, AreValidAndAcceptedByOpenSsl) {
  ASSERT_TRUE(Make("server"));
  EXPECT_TRUE(Check("server"));
  EXPECT_TRUE(CheckAuthority(folder() / "ca.pem"));
  for (const char* purpose : {"sslserver", "sslclient"}) {
    EXPECT_EQ(OpenSsl(std::string("verify -x509_strict -CAfile ca.pem -purpose ") + purpose +
                      " server.pem"),
              0)
        << purpose;
  }
  for (const char* name : {"-verify_hostname lab-7", "-verify_ip 10.0.0.7", "-verify_ip ::1"}) {
    EXPECT_EQ(OpenSsl(std::string("verify -CAfile ca.pem ") + name + " server.pem"), 0) << name;
  }
  EXPECT_NE(OpenSsl("verify -CAfile ca.pem -verify_hostname lab-8 server.pem"), 0);
}

TEST_F(CertificatesTest, RejectsCertificatesOfAnotherAuthority) {
  const auto other = base::TemporaryFolder::Make("gsv-certificates");
  ASSERT_TRUE(other);
  ASSERT_TRUE(MakeAuthority(other->path(), {}));
  ASSERT_TRUE(MakeCertificate(other->path(), {"stranger", {}, {}}));
  EXPECT_NE(OpenSsl("verify -CAfile ca.pem " + (other->path() / "stranger.pem").string()), 0);
}

TEST_F(CertificatesTest, KeyIsReadableByItsOwnerOnly) {
  ASSERT_TRUE(Make("server"));
  for (const char* name : {"ca-key.pem", "server-key.pem"}) {
    struct stat status {};
    ASSERT_EQ(stat((folder() / name).c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 0777, 0600u) << name;
  }
}

TEST_F(CertificatesTest, ExistingFilesAreNotOverwritten) {
  ASSERT_TRUE(Make("server"));
  const base::Status again = Make("server");
  ASSERT_FALSE(again);
  EXPECT_NE(again.error().Sentence().find("already exists"), std::string::npos);
  EXPECT_TRUE(Check("server"));
  EXPECT_FALSE(MakeAuthority(folder(), {}));
}

TEST_F(CertificatesTest, NamesWithPathsAreRejected) {
  for (const char* name : {"", "../x", "a/b", ".hidden", "ca", "with blank"}) {
    EXPECT_FALSE(Make(name)) << name;
  }
  EXPECT_FALSE(MakeCertificate(folder(), {"x", {"a,DNS:*"}, {}}));
}

TEST_F(CertificatesTest, ErrorNamesTheInvalidFile) {
  ASSERT_TRUE(Make("one"));
  ASSERT_TRUE(Make("two"));
  ASSERT_TRUE(Make("old", {-hours(48), -hours(24)}));
  ASSERT_TRUE(Make("early", {hours(24), hours(48)}));
  std::ofstream(folder() / "rubbish.pem") << "rubbish";
  const auto why = [](const base::Status& status) {
    EXPECT_FALSE(status);
    return status ? std::string() : status.error().Sentence();
  };
  const auto has = [&](const base::Status& status, const char* text) {
    const std::string sentence = why(status);
    EXPECT_NE(sentence.find(text), std::string::npos) << sentence;
  };
  has(Check("old"), "has expired");
  has(Check("early"), "not valid yet");
  has(CheckKeyPair(folder() / "one.pem", folder() / "two-key.pem"),
      "does not belong to the certificate");
  has(CheckKeyPair(folder() / "none.pem", folder() / "two-key.pem"), "No such file");
  has(CheckKeyPair(folder() / "rubbish.pem", folder() / "two-key.pem"), "cannot read a certif");
  has(CheckKeyPair(folder() / "one.pem", folder() / "rubbish.pem"), "cannot read a key");
  has(CheckAuthority(folder() / "one.pem"), "not the certificate of an authority");
}

}  // namespace
}  // namespace gsv::tls
