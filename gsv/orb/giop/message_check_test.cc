#include "gsv/orb/giop/message_check.h"

#include <array>
#include <string>

#include <gtest/gtest.h>

#include "gsv/orb/testing/raw_message.h"

namespace gsv::orb {
namespace {

constexpr std::uint32_t kTcLong = 3;

struct Case {
  const char* what;
  const char* types;
  RawCdr values;
};

RawCdr LongLong(RawCdr before) { return before.Align(8).ULong(1).ULong(2); }

// Each case has the values that its types require, and no more bytes.
const Case kCases[] = {
    {"numbers of each size", "1248", LongLong(RawCdr().Octet(1).UShort(2).ULong(3))},
    {"a string", "s", RawCdr().String("text")},
    {"a nil reference", "o", RawCdr().String("").ULong(0)},
    {"a reference", "o", RawCdr().String("IDL:T:1.0").ULong(1).ULong(0).Octets("profile")},
    {"an any", "a", RawCdr().ULong(kTcLong).ULong(7)},
    {"a TypeCode", "t", RawCdr().ULong(kTcLong)},
    {"an empty sequence", "[sa]", RawCdr().ULong(0)},
    {"a sequence of structs", "[sa]",
     RawCdr().ULong(2).String("p").ULong(kTcLong).ULong(7).String("q").ULong(kTcLong).ULong(8)},
    {"a sequence of sequences", "[[4]]",
     RawCdr().ULong(2).ULong(1).ULong(7).ULong(2).ULong(8).ULong(9)},
    {"a member of a union", "<4;1:[s];2:a;>", RawCdr().ULong(1).ULong(1).String("x")},
    {"another one", "<4;1:[s];2:a;>", RawCdr().ULong(2).ULong(kTcLong).ULong(7)},
    {"a union without the member", "<4;1:[s];>s", RawCdr().ULong(0).String("behind")},
    {"the default member", "<1;0:s;*:4;>", RawCdr().Octet(9).ULong(7)},
};

std::string Encapsulated(const RawCdr& values) {
  // Alignment is counted from the byte-order byte. The values begin four bytes later.
  return std::string("\x01\0\0\0", 4) + values.bytes();
}

// Whether the bytes after the byte-order byte and three bytes of padding are values of these types.
bool HasTypesOf(const Case& each, const std::string& bytes) {
  return HasTypes(bytes, "111" + std::string(each.types));
}

TEST(SignatureTest, ReadsEachType) {
  for (const Case& each : kCases) {
    if (std::string_view(each.types).find('8') != std::string_view::npos) continue;
    EXPECT_TRUE(HasTypesOf(each, Encapsulated(each.values))) << each.what;
  }
}

TEST(SignatureTest, AlignsEightByteNumbersToEight) {
  const RawCdr values = LongLong(RawCdr().Octet(1).Octet(2).UShort(3).ULong(4));
  EXPECT_TRUE(HasTypes(values.bytes(), "1248"));
}

TEST(SignatureTest, RejectsTruncatedValues) {
  for (const Case& each : kCases) {
    std::string bytes = Encapsulated(each.values);
    bytes.pop_back();
    EXPECT_FALSE(HasTypesOf(each, bytes)) << each.what;
  }
}

TEST(SignatureTest, RejectsMoreElementsThanBytes) {
  EXPECT_FALSE(HasTypes(Encapsulated(RawCdr().ULong(0xFFFFFFFF)), "111[s]"));
}

constexpr Signature kRequests[] = {{"put", "sa"}};
constexpr Signature kReplies[] = {{"get", "4"}};
constexpr Signature kExceptions[] = {{"IDL:Wrong:1.0", "a"}};
constexpr Signatures kSignatures{kRequests, kReplies, kExceptions};

const std::string kPut = RawCdr().String("p").ULong(kTcLong).ULong(7).bytes();

TEST(RequestCheckTest, RemovesArgumentsOfTheWrongTypes) {
  const std::string good = RawRequest("key", "put", kPut);
  std::string message = good;
  CheckRequest(kSignatures, message);
  EXPECT_EQ(message, good);
  message = RawRequest("key", "put", kPut.substr(0, kPut.size() - 1));
  CheckRequest(kSignatures, message);
  EXPECT_EQ(message, RawRequest("key", "put", ""));
}

TEST(RequestCheckTest, IgnoresUnlistedOperations) {
  const std::string other = RawRequest("key", "other", kPut.substr(0, 3));
  std::string message = other;
  CheckRequest(kSignatures, message);
  EXPECT_EQ(message, other);
}

// Checks a reply with `body` to a request of `operation`. Returns what is left of the reply.
std::string CheckedReply(const std::string& operation, const std::string& body) {
  ReplyCheck check(kSignatures);
  const std::string request = RawRequest("key", operation, "", 7);
  // The header is sent in one piece. The body may be sent in several pieces.
  check.Sending(request);
  check.Sent(request.size() - 1);
  check.Sending(request.substr(request.size() - 1));
  check.Sent(1);
  std::string reply = RawReply(7, body);
  check.Check(reply);
  return reply;
}

TEST(ReplyCheckTest, FindsTheTypesByTheRequest) {
  const std::string number = RawCdr().ULong(7).bytes();
  EXPECT_EQ(CheckedReply("get", number), RawReply(7, number));
  EXPECT_EQ(CheckedReply("get", "no"), RawReply(7, ""));
  EXPECT_EQ(CheckedReply("other", "no"), RawReply(7, "no"));
}

TEST(ReplyCheckTest, RejectsRepliesWithoutARequest) {
  ReplyCheck check(kSignatures);
  std::string reply = RawReply(7, RawCdr().ULong(7).bytes());
  check.Check(reply);
  EXPECT_EQ(reply, RawReply(7, ""));
}

}  // namespace
}  // namespace gsv::orb
