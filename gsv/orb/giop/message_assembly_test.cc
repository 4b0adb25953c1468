#include "gsv/orb/giop/message_assembly.h"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "gsv/orb/testing/raw_message.h"

namespace gsv::orb {
namespace {

// Feeds the bytes in pieces of `piece` bytes. Returns the messages, followed by "refused" if there
// was an error.
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

TEST(MessageAssemblyTest, AssemblesMessagesFromPieces) {
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

TEST(MessageAssemblyTest, RejectsBytesThatAreNotAMessage) {
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
}  // namespace gsv::orb
