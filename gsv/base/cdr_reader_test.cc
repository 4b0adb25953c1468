#include "gsv/base/cdr_reader.h"

#include <string>
#include <string_view>

#include <gtest/gtest.h>

namespace gsv::base {
namespace {

using namespace std::string_view_literals;

TEST(CdrReader, ReadsBothByteOrders) {
  constexpr std::string_view kBytes = "\x01\x00\x02\x03\x00\x00\x80\x3F"sv;
  CdrReader little(kBytes, true);
  EXPECT_EQ(little.UShort(), 0x0001);
  EXPECT_EQ(little.UShort(), 0x0302);
  EXPECT_EQ(little.Number<float>(), 1.0f);
  CdrReader big(kBytes, false);
  EXPECT_EQ(big.UShort(), 0x0100);
  EXPECT_EQ(big.UShort(), 0x0203);
  EXPECT_EQ(big.ULong(), 0x0000803Fu);
}

TEST(CdrReader, AlignsEachNumberToItsSize) {
  CdrReader in("\x01.\x02\x00\x03\x00\x00\x00\x04\x00\x00\x00\x00\x00\x00\x00"sv, true);
  EXPECT_EQ(in.Octet(), 1);
  EXPECT_EQ(in.UShort(), 2);
  EXPECT_EQ(in.ULong(), 3u);
  EXPECT_EQ(in.ULongLong(), 4u);
  EXPECT_TRUE(in.ok());
  EXPECT_EQ(in.remaining(), 0u);
}

TEST(CdrReader, ReadsZerosAfterAValueBeyondTheEnd) {
  CdrReader in("\x01\x02\x03"sv, true);
  EXPECT_EQ(in.ULong(), 0u);
  EXPECT_FALSE(in.ok());
  EXPECT_EQ(in.Octet(), 0);
  EXPECT_EQ(in.String(), "");
}

TEST(CdrReader, RejectsStringsWithoutATerminatorOrWithAnEmbeddedZero) {
  for (const std::string_view bytes : {"\x02\x00\x00\x00ab"sv, "\x03\x00\x00\x00\x61\x00\x00"sv,
                                       "\x00\x00\x00\x00"sv, "\x09\x00\x00\x00\x61\x00"sv}) {
    CdrReader in(bytes, true);
    EXPECT_EQ(in.String(), "");
    EXPECT_FALSE(in.ok());
  }
  CdrReader good("\x02\x00\x00\x00\x61\x00"sv, true);
  EXPECT_EQ(good.String(), "a");
  EXPECT_TRUE(good.ok());
}

TEST(CdrReader, ReadsEncapsulationsInTheirOwnByteOrder) {
  CdrReader in("\x08\x00\x00\x00\x00...\x00\x00\x00\x05\x07"sv, true);
  CdrReader inner = in.Encapsulation();
  EXPECT_EQ(inner.ULong(), 5u);
  EXPECT_TRUE(inner.ok());
  EXPECT_EQ(in.Octet(), 7);
}

TEST(CdrReader, RejectsEncapsulationsWithoutAByteOrder) {
  EXPECT_FALSE(CdrReader::OfEncapsulation("").ok());
  EXPECT_FALSE(CdrReader::OfEncapsulation("\x02").ok());
  EXPECT_TRUE(CdrReader::OfEncapsulation("\x01").ok());
}

}  // namespace
}  // namespace gsv::base
