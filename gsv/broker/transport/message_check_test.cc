#include "gsv/broker/transport/message_check.h"

#include <gtest/gtest.h>

#include "gsv/orb/testing/raw_message.h"

namespace gsv::broker {
namespace {

using orb::RawCdr;
using orb::RawReply;
using orb::RawRequest;

// Returns a property "p" with a struct whose members are missing.
RawCdr BadProperty(RawCdr before) {
  const RawCdr members = RawCdr().Octet(1).String("IDL:T:1.0").String("T").ULong(0x00FFFFFF);
  return before.String("p").ULong(15).Octets(members.bytes());
}

std::string Checked(std::string message) {
  CheckRequest(message);
  return message;
}

TEST(MessageCheckTest, LeavesValidRequestsUnchanged) {
  const RawCdr arguments =
      RawCdr().String("T").String("x > 1").String("").ULong(1).String("p").ULong(3).ULong(5);
  const std::string query =
      RawRequest("TradingService", "query", RawCdr(arguments).ULong(2).ULong(10).bytes());
  EXPECT_EQ(Checked(query), query);
  const std::string withdraw = RawRequest("R", "withdraw", RawCdr().String("id").bytes());
  EXPECT_EQ(Checked(withdraw), withdraw);
}

TEST(MessageCheckTest, RemovesInvalidArguments) {
  const std::string good_part = RawRequest("TradingService", "query", "");
  const RawCdr bad = BadProperty(RawCdr().String("T").String("").String("").ULong(1));
  EXPECT_EQ(Checked(RawRequest("TradingService", "query", bad.bytes())), good_part);
  const RawCdr too_many = RawCdr().String("T").String("").String("").ULong(0xFFFFFFFF);
  EXPECT_EQ(Checked(RawRequest("TradingService", "query", too_many.bytes())), good_part);
}

TEST(MessageCheckTest, ChecksAReplyAgainstItsRequest) {
  orb::ReplyCheck check(TradingSignatures());
  const std::string request = RawRequest("E", "evalDP", "", 7);
  check.Sending(request);
  check.Sent(request.size());
  const RawCdr good = RawCdr().ULong(3).ULong(5);
  std::string reply = RawReply(7, good.bytes());
  check.Check(reply);
  EXPECT_EQ(reply, RawReply(7, good.bytes()));
  // No request waits for a second reply, so the contents of the reply are removed.
  check.Check(reply);
  EXPECT_EQ(reply, RawReply(7, ""));

  check.Sending(request);
  check.Sent(request.size());
  reply = RawReply(7, RawCdr().ULong(15).Octets(BadProperty({}).bytes()).bytes());
  check.Check(reply);
  EXPECT_EQ(reply, RawReply(7, ""));
}

}  // namespace
}  // namespace gsv::broker
