#include "gsv/base/base64.h"

#include <gtest/gtest.h>

namespace gsv::base {
namespace {

// The test vectors of RFC 4648, section 10.
const std::pair<const char*, const char*> kVectors[] = {{"", ""},
                                                        {"f", "Zg=="},
                                                        {"fo", "Zm8="},
                                                        {"foo", "Zm9v"},
                                                        {"foob", "Zm9vYg=="},
                                                        {"fooba", "Zm9vYmE="},
                                                        {"foobar", "Zm9vYmFy"}};

TEST(Base64, EncodesAndDecodesTheVectorsOfRfc4648) {
  for (const auto& [bytes, text] : kVectors) {
    EXPECT_EQ(ToBase64(bytes), text);
    EXPECT_EQ(FromBase64(text), bytes);
  }
}

TEST(Base64, EncodesAndDecodesEveryByte) {
  std::string bytes;
  for (int i = 0; i < 256; ++i) bytes.push_back(static_cast<char>(i));
  EXPECT_EQ(FromBase64(ToBase64(bytes)), bytes);
}

TEST(Base64, RejectsTextThatIsNotCanonicalBase64) {
  for (const char* text :
       {"Z", "Zg=", "Zg", "Z===", "====", "Zm9v\n", "Zm 9", "Zh==", "=m9v", "Zg==Zg=="}) {
    EXPECT_FALSE(FromBase64(text)) << text;
  }
}

}  // namespace
}  // namespace gsv::base
