#include "gsv/exchange/content.h"

#include <array>
#include <string>

#include <gtest/gtest.h>

namespace gsv::exchange {
namespace {

using namespace std::string_literals;

TEST(Content, ReaderReturnsWhatWasWritten) {
  alignas(8) std::array<std::byte, 128> buffer{};
  ContentWriter writer(buffer);
  writer.Add(std::int64_t{-7});
  writer.Add(std::string_view("front"));
  writer.Add(std::string_view(""));
  const std::array<double, 2> values{1.5, -2.0};
  writer.Add(std::span<const double>(values));
  ASSERT_TRUE(writer.ok());
  EXPECT_EQ(writer.size(), 8u + (8 + 8) + 8 + (8 + 16));

  ContentReader reader(std::span<const std::byte>(buffer.data(), writer.size()));
  EXPECT_EQ(reader.Take<std::int64_t>(), -7);
  EXPECT_EQ(reader.TakeText(), "front");
  EXPECT_EQ(reader.TakeText(), "");
  const auto read = reader.TakeValues();
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[0], 1.5);
  EXPECT_EQ(read[1], -2.0);
  EXPECT_TRUE(reader.ok());
  (void)reader.Take<std::uint64_t>();
  EXPECT_FALSE(reader.ok());
}

TEST(Content, WriterRefusesWhatDoesNotFit) {
  alignas(8) std::array<std::byte, 24> buffer{};
  ContentWriter writer(buffer);
  writer.Add(std::string_view("12345678"));
  EXPECT_TRUE(writer.ok());
  writer.Add(std::string_view("1"));
  EXPECT_FALSE(writer.ok());
}

// The sizes in the buffer come from another process.
TEST(Content, ReaderStaysInsideTheBuffer) {
  for (const std::uint64_t size : {std::uint64_t{9}, std::uint64_t{1} << 61U, ~std::uint64_t{0}}) {
    alignas(8) std::array<std::byte, 16> buffer{};
    std::memcpy(buffer.data(), &size, sizeof size);
    ContentReader text(buffer);
    EXPECT_EQ(text.TakeText(), "");
    EXPECT_FALSE(text.ok());
    ContentReader values(buffer);
    EXPECT_TRUE(values.TakeValues().empty());
    EXPECT_FALSE(values.ok());
    EXPECT_EQ(values.Take<std::int64_t>(), 0);
  }
}

}  // namespace
}  // namespace gsv::exchange
