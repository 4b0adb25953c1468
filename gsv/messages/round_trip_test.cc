// Writes and reads every message type, both complete and damaged.
#include <gtest/gtest.h>

#include "gsv/messages/sample_filler.h"
#include "samples.h"

namespace gsv::messages {
namespace {

template <typename Message>
Bytes Sample(Message& message, std::uint32_t seed) {
  SampleFiller filler(seed);
  Fill(message, filler);
  Bytes bytes;
  Encode(message, bytes);
  return bytes;
}

TEST(RoundTrip, EveryTypeIsReadBackUnchanged) {
  ForEachType([](const Schema& schema, auto message) {
    for (std::uint32_t seed = 0; seed < 56; ++seed) {
      const Bytes bytes = Sample(message, seed);
      const auto decoded = Decode<decltype(message)>(bytes);
      ASSERT_TRUE(decoded) << decoded.error().Sentence();
      EXPECT_EQ(*decoded, message) << schema.name << " " << seed;
    }
  });
}

TEST(RoundTrip, TruncatedMessagesAreRejected) {
  ForEachType([](const Schema& schema, auto message) {
    const Bytes bytes = Sample(message, 1);
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      EXPECT_FALSE(Decode<decltype(message)>(std::span(bytes).first(size)))
          << schema.name << " " << size;
    }
  });
}

// A flipped bit may change lengths and counts. The result must be a message or an error.
TEST(RoundTrip, FlippedBitsCauseNoReadOutsideTheMessage) {
  ForEachType([](const Schema& schema, auto message) {
    Bytes bytes = Sample(message, 3);
    for (std::size_t bit = 0; bit < bytes.size() * 8; ++bit) {
      const std::byte mask{static_cast<unsigned char>(1U << (bit % 8))};
      bytes[bit / 8] ^= mask;
      if (const auto decoded = Decode<decltype(message)>(bytes); !decoded) {
        EXPECT_EQ(decoded.error().where, schema.name);
      }
      bytes[bit / 8] ^= mask;
    }
  });
}

TEST(AllSchemas, ContainsEachTypeOnce) {
  std::string last;
  for (const Schema& schema : AllSchemas()) {
    EXPECT_LT(last, schema.name);
    last = schema.name;
  }
  std::size_t types = 0;
  ForEachType([&](const Schema&, const auto&) { ++types; });
  EXPECT_EQ(AllSchemas().size(), types);
}

}  // namespace
}  // namespace gsv::messages
