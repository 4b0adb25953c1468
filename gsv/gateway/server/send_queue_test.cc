#include "gsv/gateway/server/send_queue.h"

#include <gtest/gtest.h>

namespace gsv::gateway {
namespace {

using std::chrono::milliseconds;

constexpr std::size_t kHeader = 13;

SharedBytes Bytes(std::size_t size, char filler = 'x') {
  return SharedBytes(std::string(size, filler));
}

SendQueue::Time At(int time_ms) { return SendQueue::Time(milliseconds(time_ms)); }

void PushData(SendQueue& queue, char name, std::size_t size = 1) {
  queue.PushData(foxglove::MessageDataHeader(1, 2), Bytes(size, name), Delivery::kEach, At(0));
}

void PushAt(SendQueue& queue, int time_ms, char name, foxglove::SubscriptionId subscription,
            Delivery delivery = Delivery::kNewest) {
  queue.PushData(foxglove::MessageDataHeader(subscription, 2), Bytes(1, name), delivery,
                 At(time_ms));
}

std::string Order(SendQueue& queue, int time_ms = 0) {
  std::string order;
  while (const auto message = queue.Pop(At(time_ms)).message) {
    order += message->payload.view().front();
  }
  return order;
}

TEST(SendQueue, ReturnsControlBeforeDataEachInOrder) {
  SendQueue queue({});
  PushData(queue, 'a');
  PushData(queue, 'b');
  EXPECT_TRUE(queue.PushControl(Bytes(1, 'T')));
  EXPECT_TRUE(queue.PushControl(Bytes(1, 'U')));
  EXPECT_EQ(Order(queue), "TUab");
  EXPECT_TRUE(queue.empty());
}

TEST(SendQueue, DropsTheOldestDataBeyondTheirNumber) {
  SendQueue queue({.control_bytes = 100, .data_bytes = 1000, .data_messages = 3});
  for (const char name : {'a', 'b', 'c', 'd', 'e'}) PushData(queue, name);
  EXPECT_EQ(queue.dropped(), 2u);
  EXPECT_EQ(Order(queue), "cde");
}

TEST(SendQueue, DropsTheOldestDataBeyondTheirSize) {
  SendQueue queue({.control_bytes = 100, .data_bytes = 3 * (kHeader + 10), .data_messages = 99});
  for (const char name : {'a', 'b', 'c'}) PushData(queue, name, 10);
  EXPECT_EQ(queue.dropped(), 0u);
  PushData(queue, 'd', 11);  // b, c and d exceed the limit by one byte, so a and b are dropped
  EXPECT_EQ(queue.dropped(), 2u);
  EXPECT_EQ(Order(queue), "cd");
}

TEST(SendQueue, KeepsTheNewestMessageOfAnySize) {
  SendQueue queue({.control_bytes = 100, .data_bytes = 50, .data_messages = 9});
  PushData(queue, 'a');
  PushData(queue, 'b', 1000);
  EXPECT_EQ(Order(queue), "b");
  PushData(queue, 'c');
  EXPECT_EQ(Order(queue), "c");
}

TEST(SendQueue, RefusesControlThatDoesNotFit) {
  SendQueue queue({.control_bytes = 10, .data_bytes = 10, .data_messages = 1});
  EXPECT_TRUE(queue.PushControl(Bytes(6)));
  EXPECT_FALSE(queue.PushControl(Bytes(5)));
  ASSERT_TRUE(queue.Pop(At(0)).message);
  EXPECT_TRUE(queue.PushControl(Bytes(5)));
}

TEST(SendQueue, DropsOldStateThatANewerMessageReplaces) {
  SendQueue queue({});
  PushAt(queue, 0, 'a', 1);
  PushAt(queue, 0, 'A', 2);
  PushAt(queue, 50, 'b', 1);
  PushAt(queue, 100, 'c', 1);
  PushAt(queue, 250, 'd', 1);
  EXPECT_EQ(Order(queue, 299), "Acd");
  EXPECT_EQ(queue.dropped(), 2u);
}

TEST(SendQueue, KeepsStateThatIsRecentOrTheNewest) {
  SendQueue queue({});
  for (const char name : {'a', 'b', 'c'}) PushAt(queue, 0, name, 1);
  EXPECT_EQ(Order(queue, 199), "abc");
  PushAt(queue, 0, 'd', 1);
  EXPECT_EQ(Order(queue, 60'000), "d");
}

TEST(SendQueue, KeepsEachEvent) {
  SendQueue queue({});
  for (const char name : {'a', 'b', 'c'}) PushAt(queue, 0, name, 1, Delivery::kEach);
  EXPECT_EQ(Order(queue, 60'000), "abc");
  EXPECT_EQ(queue.dropped(), 0u);
}

TEST(SendQueue, DropsReplacedStateBeforeEventsAndOtherState) {
  SendQueue queue({.control_bytes = 100, .data_bytes = 1000, .data_messages = 4});
  PushAt(queue, 0, 'E', 1, Delivery::kEach);
  PushAt(queue, 0, 'h', 2);  // published once
  for (const char name : {'a', 'b', 'c', 'd'}) PushAt(queue, 0, name, 3);
  PushAt(queue, 0, 'F', 1, Delivery::kEach);
  EXPECT_EQ(queue.dropped(), 3u);
  EXPECT_EQ(Order(queue), "EhdF");
}

TEST(SendQueue, DropsOldTimeMessages) {
  SendQueue queue({});
  for (const std::uint64_t time : {1u, 2u, 3u}) {
    queue.PushData(foxglove::TimeHeader(time), {}, Delivery::kNewest, At(0));
  }
  const SendQueue::Popped popped = queue.Pop(At(1000));
  EXPECT_EQ(popped.left_out, 2u);
  EXPECT_EQ(popped.message->header.bytes[1], 3);
}

TEST(SendQueue, ReturnsOnlyControlWhileDataAreNotAllowed) {
  SendQueue queue({});
  PushData(queue, 'a');
  EXPECT_TRUE(queue.PushControl(Bytes(1, 'T')));
  EXPECT_EQ(queue.Pop(At(0), false).message->payload.view(), "T");
  EXPECT_FALSE(queue.Pop(At(0), false).message);
  EXPECT_EQ(Order(queue), "a");
}

}  // namespace
}  // namespace gsv::gateway
