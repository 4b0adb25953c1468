#include "gsv/broker/transport/message_check.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "gsv/broker/testing/raw_message.h"

namespace gsv::broker {
namespace {

// A property "p" with a struct whose members are missing.
RawCdr BadProperty(RawCdr before) {
  const RawCdr members = RawCdr().Octet(1).String("IDL:T:1.0").String("T").ULong(0x00FFFFFF);
  return before.String("p").ULong(15).Octets(members.bytes());
}

std::string Checked(std::string message) {
  CheckRequest(message);
  return message;
}

TEST(MessageCheckTest, LeavesGoodRequestsAsTheyAre) {
  const RawCdr arguments =
      RawCdr().String("T").String("x > 1").String("").ULong(1).String("p").ULong(3).ULong(5);
  const std::string query =
      RawRequest("TradingService", "query", RawCdr(arguments).ULong(2).ULong(10).bytes());
  EXPECT_EQ(Checked(query), query);
  const std::string withdraw = RawRequest("R", "withdraw", RawCdr().String("id").bytes());
  EXPECT_EQ(Checked(withdraw), withdraw);
}

TEST(MessageCheckTest, CutsOffArgumentsThatAreRefused) {
  const std::string good_part = RawRequest("TradingService", "query", "");
  const RawCdr bad = BadProperty(RawCdr().String("T").String("").String("").ULong(1));
  EXPECT_EQ(Checked(RawRequest("TradingService", "query", bad.bytes())), good_part);
  const RawCdr too_many = RawCdr().String("T").String("").String("").ULong(0xFFFFFFFF);
  EXPECT_EQ(Checked(RawRequest("TradingService", "query", too_many.bytes())), good_part);
}

TEST(MessageCheckTest, KnowsWhatRepliesAnswer) {
  ReplyCheck check;
  const std::string request = RawRequest("E", "evalDP", "", 7);
  check.Sending(request, request.size());
  const RawCdr good = RawCdr().ULong(3).ULong(5);
  std::string reply = RawReply(7, good.bytes());
  check.Check(reply);
  EXPECT_EQ(reply, RawReply(7, good.bytes()));
  // Nobody waits for a second one.
  check.Check(reply);
  EXPECT_EQ(reply, RawReply(7, ""));

  check.Sending(request, request.size());
  reply = RawReply(7, RawCdr().ULong(15).Octets(BadProperty({}).bytes()).bytes());
  check.Check(reply);
  EXPECT_EQ(reply, RawReply(7, ""));
}

// Feeds all bytes, `piece` at a time; the messages that came out, "refused" at the end of them.
std::vector<std::string> Assembled(std::string_view bytes, std::size_t piece) {
  MessageAssembly assembly(65'536);
  std::vector<std::string> messages;
  while (!bytes.empty()) {
    const auto room = assembly.Next();
    const std::size_t count = std::min({room.size, piece, bytes.size()});
    std::copy_n(bytes.data(), count, room.bytes);
    assembly.Take(count);
    bytes.remove_prefix(count);
    if (assembly.state() == MessageAssembly::State::kRefused) {
      messages.emplace_back("refused");
      return messages;
    }
    if (assembly.state() == MessageAssembly::State::kIncomplete) continue;
    messages.push_back(assembly.message());
    assembly.Reset();
  }
  return messages;
}

TEST(MessageAssemblyTest, PutsMessagesTogetherFromPieces) {
  const std::string small = RawRequest("R", "withdraw", RawCdr().String("id").bytes());
  const std::string large = RawRequest("R", "export", std::string(30'000, 'x'));
  const std::vector<std::string> expected = {small, large, small};
  for (const std::size_t piece : {std::size_t{1}, std::size_t{7}, std::size_t{100'000}}) {
    EXPECT_EQ(Assembled(small + large + small, piece), expected) << piece;
  }
}

TEST(MessageAssemblyTest, JoinsFragments) {
  const std::string whole = RawRequest("R", "export", std::string(400, 'x') + std::string(96, 'y'));
  const std::size_t half = whole.size() - 96;
  std::string first = whole.substr(12, half - 12);
  const std::string id = whole.substr(12, 4);
  const std::string message =
      RawMessage(MessageType::kRequest, first, true) +
      RawMessage(MessageType::kFragment, id + whole.substr(half, 48), true) +
      RawMessage(MessageType::kFragment, id + whole.substr(half + 48));
  EXPECT_EQ(Assembled(message, 5), std::vector<std::string>{whole});
}

TEST(MessageAssemblyTest, RefusesWhatIsNoMessage) {
  const std::vector<std::string> refused = {"refused"};
  EXPECT_EQ(Assembled("GIOX\x01\x02\x01\x01\x01\x01\x01\x01", 3), refused);
  EXPECT_EQ(Assembled(std::string_view("GIOP\x01\x03\x01\x00\x00\x00\x00\x00", 12), 12), refused);
  EXPECT_EQ(Assembled(std::string_view("GIOP\x01\x02\x01\x00\xFF\xFF\x00\x00", 12), 12), refused);
  const std::string begun = RawMessage(MessageType::kRequest, RawCdr().ULong(1).bytes(), true);
  const std::string of_another = RawMessage(MessageType::kFragment, RawCdr().ULong(2).bytes());
  EXPECT_EQ(Assembled(begun + of_another, 8), refused);
  EXPECT_EQ(Assembled(begun + begun, 8), refused);
  EXPECT_EQ(Assembled(of_another, 8), refused);
}

}  // namespace
}  // namespace gsv::broker
