#include "gsv/gateway/server/send_queue.h"

#include <gtest/gtest.h>

namespace gsv::gateway {
namespace {

constexpr std::size_t kHeader = 13;

SharedBytes Bytes(std::size_t size, char filler = 'x') {
  return SharedBytes(std::string(size, filler));
}

void PushData(SendQueue& queue, char name, std::size_t size = 1) {
  queue.PushData(foxglove::MessageDataHeader(1, 2), Bytes(size, name));
}

std::string Order(SendQueue& queue) {
  std::string order;
  while (const auto message = queue.Pop()) order += message->payload.view().front();
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
  PushData(queue, 'd', 11);  // this exceeds the limit by one byte, so two messages must be dropped
  EXPECT_EQ(queue.dropped(), 2u);
  EXPECT_EQ(Order(queue), "cd");
}

TEST(SendQueue, KeepsTheNewestHoweverLargeItIs) {
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
  ASSERT_TRUE(queue.Pop());
  EXPECT_TRUE(queue.PushControl(Bytes(5)));
}

}  // namespace
}  // namespace gsv::gateway
