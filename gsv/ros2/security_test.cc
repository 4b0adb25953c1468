#include "gsv/ros2/security.h"

#include <filesystem>
#include <fstream>
#include <map>

#include <gtest/gtest.h>

namespace gsv::ros2 {
namespace {

namespace fs = std::filesystem;

class SecurityTest : public ::testing::Test {
 protected:
  SecurityTest() {
    std::string name = (fs::temp_directory_path() / "gsv-keystore-XXXXXX").string();
    keystore_ = mkdtemp(name.data());
    fs::create_directories(fs::path(keystore_) / "enclaves/gsv");
    for (const char* file : kEnclaveFiles) std::ofstream(Enclave() / file) << "key";
  }
  ~SecurityTest() override { fs::remove_all(keystore_); }

  fs::path Enclave() const { return fs::path(keystore_) / "enclaves/gsv"; }
  base::Result<dds::ParticipantOptions> With(std::map<std::string, std::string> values) const {
    return ParticipantFor({}, [&](const char* name) { return values[name]; });
  }

  std::string keystore_;
};

TEST_F(SecurityTest, IsOffByDefault) {
  const auto participant = With({{"ROS_SECURITY_KEYSTORE", keystore_}});
  ASSERT_TRUE(participant);
  EXPECT_EQ(participant->enclave_folder, "");
  EXPECT_EQ(participant->user_data, "enclave=/;");
}

TEST_F(SecurityTest, TakesTheKeysOfTheEnclave) {
  const auto participant = With({{"ROS_SECURITY_ENABLE", "true"},
                                 {"ROS_SECURITY_STRATEGY", "Enforce"},
                                 {"ROS_SECURITY_ENCLAVE_OVERRIDE", "/gsv"},
                                 {"ROS_SECURITY_KEYSTORE", keystore_}});
  ASSERT_TRUE(participant);
  EXPECT_EQ(participant->enclave_folder, Enclave());
  EXPECT_EQ(participant->user_data, "enclave=/gsv;");
}

TEST_F(SecurityTest, WithoutKeysStartsOnlyIfPermitted) {
  fs::remove(Enclave() / "key.pem");
  std::map<std::string, std::string> values{{"ROS_SECURITY_ENABLE", "true"},
                                            {"ROS_SECURITY_ENCLAVE_OVERRIDE", "/gsv"},
                                            {"ROS_SECURITY_KEYSTORE", keystore_}};
  const auto permissive = With(values);
  ASSERT_TRUE(permissive);
  EXPECT_EQ(permissive->enclave_folder, "");
  EXPECT_NE(permissive->insecure_reason.find("no key.pem in"), std::string::npos);
  values["ROS_SECURITY_STRATEGY"] = "Enforce";
  const auto enforced = With(values);
  ASSERT_FALSE(enforced);
  EXPECT_EQ(enforced.error().where, "ROS_SECURITY_KEYSTORE");
  values["ROS_SECURITY_KEYSTORE"] = "";
  EXPECT_FALSE(With(values));
}

TEST_F(SecurityTest, RefusesInvalidValuesInsteadOfDisablingSecurity) {
  const std::map<std::string, std::string> bad[] = {
      {{"ROS_SECURITY_ENABLE", "1"}},
      {{"ROS_SECURITY_STRATEGY", "enforce"}, {"ROS_SECURITY_ENABLE", "true"}},
      {{"ROS_SECURITY_ENCLAVE_OVERRIDE", "/../gsv"}, {"ROS_SECURITY_ENABLE", "true"}}};
  for (const auto& values : bad) EXPECT_FALSE(With(values)) << values.begin()->second;
}

}  // namespace
}  // namespace gsv::ros2
