#include "gsv/messages/definition.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "gsv/messages/sample_filler.h"
#include "samples.h"

namespace gsv::messages {
namespace {

using nlohmann::ordered_json;

Definition Parsed(std::string_view name, std::string_view text) {
  auto definition = Definition::Parse(name, text);
  EXPECT_TRUE(definition) << definition.error().Sentence();
  return *std::move(definition);
}

std::vector<std::byte> Cdr(std::initializer_list<int> bytes) {
  std::vector<std::byte> cdr;
  for (const int byte : bytes) cdr.push_back(static_cast<std::byte>(byte));
  return cdr;
}

TEST(Definition, DecodesByTheRulesOfCdr) {
  const Definition definition = Parsed("a/msg/Thing", R"(# a comment
uint8 KIND=3
uint8 kind 3
float64[2] at   # aligned to eight
string name
int16[] steps
b/Part part
================================================================================
MSG: b/Part
bool on
string<=10 unit)");
  // The fields in the message are: kind 7, padding, position (1.0, -2.0), "ab", two steps after
  // their count, on = true, padding, "m".
  const auto message =
      definition.Decode(Cdr({0, 1, 0, 0,                                                     //
                             7, 0, 0, 0, 0,   0,   0,    0,                                  //
                             0, 0, 0, 0, 0,   0,   0xf0, 0x3f, 0,   0, 0, 0, 0, 0, 0, 0xc0,  //
                             3, 0, 0, 0, 'a', 'b', 0,    0,                                  //
                             2, 0, 0, 0, 5,   0,   0xff, 0xff,                               //
                             1, 0, 0, 0, 2,   0,   0,    0,    'm', 0}));
  ASSERT_TRUE(message) << message.error().Sentence();
  EXPECT_EQ(message->dump(), R"({"kind":7,"at":[1.0,-2.0],"name":"ab","steps":[5,-1],)"
                             R"("part":{"on":true,"unit":"m"}})");
}

TEST(Definition, DecodesBigEndian) {
  const Definition definition = Parsed("a/Number", "uint32 n\n");
  const auto message = definition.Decode(Cdr({0, 0, 0, 0, 1, 2, 3, 4}));
  ASSERT_TRUE(message);
  EXPECT_EQ((*message)["n"], 0x01020304);
}

TEST(Definition, ReplacesOctetsByTheirNumber) {
  const Definition definition = Parsed("a/Picture", "uint8[] data\nuint8 last\n");
  const auto message = definition.Decode(Cdr({0, 1, 0, 0, 3, 0, 0, 0, 1, 2, 3, 9}));
  ASSERT_TRUE(message);
  EXPECT_EQ((*message)["data"]["bytes"], 3);
  EXPECT_EQ((*message)["last"], 9);
}

// The decoder must consume every message of the generated code exactly.
TEST(Definition, DecodesEveryMessageTypeOfGsv) {
  ForEachType([](const Schema& schema, auto message) {
    const Definition definition = Parsed(schema.name, schema.text);
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
      SampleFiller filler(seed);
      Fill(message, filler);
      Bytes bytes;
      Encode(message, bytes);
      const auto decoded = definition.Decode(bytes);
      ASSERT_TRUE(decoded) << schema.name << ": " << decoded.error().Sentence();
      // The time of the following loop is quadratic in the size of the message, so it runs for the
      // first two seeds only.
      if (seed > 1) continue;
      for (std::size_t size = 0; size < bytes.size(); ++size) {
        EXPECT_FALSE(definition.Decode(std::span(bytes).first(size))) << schema.name << " " << size;
      }
    }
  });
}

TEST(Definition, InvalidSchemasAreRejected) {
  EXPECT_FALSE(Definition::Parse("a/A", "b/B thing\n"));     // the type b/B is missing
  EXPECT_FALSE(Definition::Parse("a/A", "A[] children\n"));  // the type contains itself
  EXPECT_FALSE(Definition::Parse("a/A", "wstring wide\n"));
}

TEST(Definition, WrongLengthsAreRejected) {
  const Definition numbers = Parsed("a/A", "float64[] values\n");
  EXPECT_FALSE(numbers.Decode(Cdr({0, 1, 0, 0, 0xff, 0xff, 0xff, 0xff})));
  // An empty struct has no bytes, so the number of such structs is limited.
  const Definition nothings = Parsed("a/A", "B[] values\n====\nMSG: a/B\n");
  EXPECT_FALSE(nothings.Decode(Cdr({0, 1, 0, 0, 0xff, 0xff, 0xff, 0x7f})));
  EXPECT_FALSE(nothings.Decode({}));
}

}  // namespace
}  // namespace gsv::messages
