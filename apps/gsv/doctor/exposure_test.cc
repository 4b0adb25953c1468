#include "apps/gsv/doctor/exposure.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gsv::app {
namespace {

using ::testing::HasSubstr;

const Listener kOpen{"0.0.0.0", 8080}, kLocal{"127.0.0.1", 8080};

TEST(Exposure, GivesNoWarningForASocketOfThisMachineOnly) {
  for (const Speaks speaks :
       {Speaks::kHttp, Speaks::kHttps, Speaks::kCorba, Speaks::kCorbaTls, Speaks::kUnknown}) {
    EXPECT_EQ(ExposureWarning(kLocal, {speaks}), "");
  }
}

TEST(Exposure, ViewerBeyondThisMachineNeedsTokensAndTls) {
  Exposure exposure{Speaks::kHttp};
  EXPECT_THAT(ExposureWarning(kOpen, exposure),
              HasSubstr("everyone who can reach this address can control the program"));
  exposure.acting_takes_token = true;
  EXPECT_THAT(ExposureWarning(kOpen, exposure), HasSubstr("can read the traffic"));
  exposure.speaks = Speaks::kHttps;
  EXPECT_EQ(ExposureWarning(kOpen, exposure), "") << "watching may be free";
  exposure.acting_takes_token = false;
  EXPECT_THAT(ExposureWarning(kOpen, exposure), HasSubstr("--control-token"));
}

TEST(Exposure, CorbaBeyondThisMachineNeedsCertificates) {
  EXPECT_THAT(ExposureWarning(kOpen, {Speaks::kCorba}), HasSubstr("--insecure-corba"));
  Exposure exposure{Speaks::kCorbaTls};
  EXPECT_EQ(ExposureWarning(kOpen, exposure),
            "everyone who can reach this address can call the program");
  exposure.takes_certificate = true;
  EXPECT_EQ(ExposureWarning(kOpen, exposure), "");
}

TEST(Exposure, Ros2BeyondThisMachineNeedsKeys) {
  Listener listener{"0.0.0.0", 7410, true};
  EXPECT_THAT(ExposureWarning(listener, Probe(listener)), HasSubstr("--ros2-range localhost"));
  listener.takes_keys = true;
  EXPECT_EQ(ExposureWarning(listener, Probe(listener)), "");
  EXPECT_EQ(ExposureWarning({"127.0.0.1", 7410, true}, {Speaks::kRos2}), "");
}

TEST(Exposure, WarnsAboutASocketThatDoesNotAnswer) {
  EXPECT_THAT(ExposureWarning(kOpen, {Speaks::kUnknown}),
              HasSubstr("the program does not respond"));
}

}  // namespace
}  // namespace gsv::app
