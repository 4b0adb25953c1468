#include "gsv/orb/giop/type_code_check.h"

#include <string>

#include <gtest/gtest.h>

#include "gsv/orb/testing/raw_message.h"

namespace gsv::orb {
namespace {

using namespace std::string_literals;

constexpr std::uint32_t kLong = 3;
constexpr std::uint32_t kOctet = 10;
constexpr std::uint32_t kAny = 11;
constexpr std::uint32_t kStruct = 15;
constexpr std::uint32_t kUnion = 16;
constexpr std::uint32_t kEnum = 17;
constexpr std::uint32_t kString = 18;
constexpr std::uint32_t kSequence = 19;
constexpr std::uint32_t kArray = 20;
constexpr std::uint32_t kAlias = 21;
constexpr std::uint32_t kFixed = 28;

// Returns the start of encapsulated parameters of a TypeCode.
RawCdr Parameters() { return RawCdr().Octet(1); }
RawCdr Named() { return Parameters().String("IDL:T:1.0").String("T"); }
// Returns `before`, followed by a TypeCode of `kind` with `parameters`.
RawCdr With(RawCdr before, std::uint32_t kind, const RawCdr& parameters) {
  return before.ULong(kind).Octets(parameters.bytes());
}
RawCdr SequenceOf(std::uint32_t element) {
  return With({}, kSequence, Parameters().ULong(element).ULong(0));
}

bool IsTypeCode(const RawCdr& cdr) {
  CdrReader in(cdr.bytes(), true);
  TypeCodeCheck().TypeCode(in);
  return in.ok() && in.remaining() == 0;
}
bool IsAny(const RawCdr& cdr) {
  CdrReader in(cdr.bytes(), true);
  TypeCodeCheck().Any(in);
  return in.ok() && in.remaining() == 0;
}

TEST(TypeCodeCheckTest, AcceptsCompleteTypeCodes) {
  EXPECT_TRUE(IsTypeCode(RawCdr().ULong(kLong)));
  EXPECT_TRUE(IsTypeCode(RawCdr().ULong(kString).ULong(0)));
  EXPECT_TRUE(IsTypeCode(SequenceOf(kLong)));
  EXPECT_TRUE(IsTypeCode(With({}, kAlias, Named().ULong(kLong))));
  EXPECT_TRUE(IsTypeCode(With({}, kEnum, Named().ULong(2).String("a").String("b"))));
  EXPECT_TRUE(IsTypeCode(With({}, kStruct, Named().ULong(1).String("x").ULong(kLong))));
}

TEST(TypeCodeCheckTest, RejectsMissingMembers) {
  EXPECT_FALSE(IsTypeCode(With({}, kStruct, Named().ULong(2).String("x").ULong(kLong))));
  EXPECT_FALSE(IsTypeCode(With({}, kStruct, Named().ULong(0x00FFFFFF))));
  EXPECT_FALSE(IsTypeCode(With({}, kStruct, Named())));
  EXPECT_FALSE(IsTypeCode(With({}, kStruct, Parameters())));
  EXPECT_FALSE(IsTypeCode(With({}, kEnum, Named().ULong(3).String("a").String("b"))));
  EXPECT_FALSE(IsTypeCode(With({}, kSequence, Parameters())));
  EXPECT_FALSE(IsTypeCode(RawCdr().ULong(kStruct).ULong(0)));
  EXPECT_FALSE(IsTypeCode(RawCdr().ULong(kStruct).ULong(100)));
}

// If a type had a NUL inside its repository id, the broker would store an offer with the type, but
// could not read the offer again.
TEST(TypeCodeCheckTest, RejectsNamesWithAnEmbeddedZero) {
  const auto named = [](RawCdr id) { return With({}, kAlias, id.String("T").ULong(kLong)); };
  EXPECT_TRUE(IsTypeCode(named(Parameters().Octets("IDL:T:1.0\0"s))));
  EXPECT_FALSE(IsTypeCode(named(Parameters().Octets("IDL:\0T:1.0\0"s))));
  EXPECT_FALSE(IsTypeCode(named(Parameters().Octets("IDL:T:1.0\0\0"s))));
  EXPECT_FALSE(IsTypeCode(named(Parameters().Octets("\0\0"s))));
}

TEST(TypeCodeCheckTest, RejectsUnusableKinds) {
  for (const std::uint32_t kind : {13u, 29u, 30u, 31u, 32u, 33u, 1000u, 0xFFFFFFFEu}) {
    EXPECT_FALSE(IsTypeCode(RawCdr().ULong(kind))) << kind;
  }
}

// Regression: a type with a scale of 108 crashed the broker.
TEST(TypeCodeCheckTest, RejectsFixedWithMoreDecimalsThanDigits) {
  EXPECT_TRUE(IsTypeCode(RawCdr().ULong(kFixed).UShort(19).UShort(4)));
  EXPECT_TRUE(IsTypeCode(RawCdr().ULong(kFixed).UShort(31).UShort(31)));
  EXPECT_FALSE(IsTypeCode(RawCdr().ULong(kFixed).UShort(19).UShort(0x6c)));
  EXPECT_FALSE(IsTypeCode(RawCdr().ULong(kFixed).UShort(19).UShort(20)));
  EXPECT_FALSE(IsTypeCode(RawCdr().ULong(kFixed).UShort(19).UShort(0xFFFF)));
  EXPECT_FALSE(IsTypeCode(RawCdr().ULong(kFixed).UShort(0).UShort(0)));
}

TEST(TypeCodeCheckTest, RejectsUnterminatedNames) {
  EXPECT_FALSE(IsTypeCode(With({}, kAlias, Parameters().Octets("T").String("T").ULong(kLong))));
  EXPECT_FALSE(IsTypeCode(With({}, kAlias, Parameters().Octets("").String("T").ULong(kLong))));
}

TEST(TypeCodeCheckTest, AcceptsAReferenceToAnEarlierType) {
  const RawCdr inner = With({}, kStruct, Named().ULong(1).String("x").ULong(kLong));
  const auto pair = [&](std::uint32_t back) {
    RawCdr members = Named().ULong(2).String("a").Align(4);
    members.Raw(inner.bytes()).String("b").ULong(0xFFFFFFFF);
    return With({}, kStruct, members.ULong(back));
  };
  // The distance is from the offset back to the inner type: the indirection mark, "b" and its
  // length, and the type itself.
  const auto distance = static_cast<std::uint32_t>(inner.bytes().size() + 4 + 4 + 4);
  EXPECT_TRUE(IsTypeCode(pair(0u - distance)));
  EXPECT_FALSE(IsTypeCode(pair(0u - distance + 4)));
  EXPECT_FALSE(IsTypeCode(pair(0u - 4)));
  EXPECT_FALSE(IsTypeCode(pair(8)));
}

TEST(TypeCodeCheckTest, RejectsATypeThatContainsItself) {
  // The offset of the element type points to the sequence itself.
  EXPECT_FALSE(
      IsTypeCode(With({}, kSequence, Parameters().ULong(0xFFFFFFFF).ULong(0u - 16).ULong(0))));
}

TEST(TypeCodeCheckTest, RejectsTypesThatAreTooDeep) {
  const auto nested = [](int depth) {
    RawCdr type = RawCdr().ULong(kLong);
    for (int i = 1; i < depth; ++i) {
      type = With({}, kSequence, Parameters().Align(4).Raw(type.bytes()).ULong(0));
    }
    return type;
  };
  EXPECT_TRUE(IsTypeCode(nested(64)));
  EXPECT_FALSE(IsTypeCode(nested(65)));
  EXPECT_FALSE(IsTypeCode(nested(4000)));
}

TEST(TypeCodeCheckTest, ReadsTheValueByItsType) {
  EXPECT_TRUE(IsAny(RawCdr().ULong(kLong).ULong(7)));
  EXPECT_FALSE(IsAny(RawCdr().ULong(kLong)));
  EXPECT_TRUE(IsAny(SequenceOf(kLong).ULong(2).ULong(7).ULong(8)));
  EXPECT_FALSE(IsAny(SequenceOf(kLong).ULong(2).ULong(7)));
  EXPECT_FALSE(IsAny(SequenceOf(kOctet).ULong(0xFFFFFFFF)));
  EXPECT_TRUE(IsAny(SequenceOf(kAny).ULong(1).ULong(kLong).ULong(7)));
  EXPECT_FALSE(IsAny(SequenceOf(kAny).ULong(1).ULong(kStruct).ULong(9)));
  const RawCdr colour = With({}, kEnum, Named().ULong(2).String("a").String("b"));
  EXPECT_TRUE(IsAny(RawCdr(colour).ULong(1)));
  EXPECT_FALSE(IsAny(RawCdr(colour).ULong(2)));
}

TEST(TypeCodeCheckTest, ReadsValuesOfSimpleTypes) {
  EXPECT_TRUE(IsAny(RawCdr().ULong(kString).ULong(0).String("text")));
  EXPECT_FALSE(IsAny(RawCdr().ULong(kString).ULong(0).Octets("text")));
  EXPECT_FALSE(IsAny(RawCdr().ULong(kString).ULong(0)));
  EXPECT_TRUE(IsAny(RawCdr().ULong(kOctet).Octet(1)));
  constexpr std::uint32_t kDouble = 7;
  EXPECT_TRUE(IsAny(RawCdr().ULong(kDouble).Align(8).ULong(0).ULong(0)));
  EXPECT_FALSE(IsAny(RawCdr().ULong(kDouble).ULong(0)));
}

TEST(TypeCodeCheckTest, CountsTheTypesOfAMessage) {
  const auto longs = [](std::uint32_t count) {
    RawCdr any = SequenceOf(kAny).ULong(count);
    for (std::uint32_t i = 0; i < count; ++i) any.ULong(kLong).ULong(i);
    return any;
  };
  EXPECT_TRUE(IsAny(longs(4000)));
  EXPECT_FALSE(IsAny(longs(4100)));
}

TEST(TypeCodeCheckTest, ReadsTheUnionMemberOfTheDiscriminator) {
  RawCdr members = Named().ULong(kLong).ULong(1).ULong(2);
  members.ULong(5).String("text").ULong(kString).ULong(0);
  members.ULong(0).String("otherwise").ULong(kLong);
  const RawCdr type = With({}, kUnion, members);
  EXPECT_TRUE(IsAny(RawCdr(type).ULong(5).String("hello")));
  EXPECT_FALSE(IsAny(RawCdr(type).ULong(5).ULong(100)));
  EXPECT_TRUE(IsAny(RawCdr(type).ULong(6).ULong(100)));
  EXPECT_FALSE(IsTypeCode(With({}, kUnion, Named().ULong(kString).ULong(0).ULong(0).ULong(0))));
}

TEST(TypeCodeCheckTest, AcceptsArraysOfEmptyElementsWithoutLooping) {
  RawCdr type = With({}, kStruct, Named().ULong(0));
  for (int i = 0; i < 4; ++i) {
    type = With({}, kArray, Parameters().Align(4).Raw(type.bytes()).ULong(0xFFFFFFFF));
  }
  EXPECT_FALSE(IsAny(type));
}

}  // namespace
}  // namespace gsv::orb
