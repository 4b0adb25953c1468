// Prints messages of every type for interop_test.mjs, one per line with fields separated by blanks:
// the type's name, its schema in hexadecimal, the seed, the message in hexadecimal.
#include <cstdio>
#include <span>
#include <string>

#include "gsv/messages/sample_filler.h"
#include "samples.h"

namespace {

std::string Hex(std::span<const std::byte> bytes) {
  constexpr char kDigits[] = "0123456789abcdef";
  std::string text;
  for (const std::byte byte : bytes) {
    text += kDigits[std::to_integer<int>(byte >> 4)];
    text += kDigits[std::to_integer<int>(byte & std::byte{15})];
  }
  return text;
}

// With these seeds, every count and string length occurs at every alignment.
constexpr std::uint32_t kSeeds = 56;

}  // namespace

int main() {
  using namespace gsv::messages;
  ForEachType([](const Schema& schema, auto empty) {
    const std::string definition = Hex(std::as_bytes(std::span(schema.text)));
    for (std::uint32_t seed = 0; seed < kSeeds; ++seed) {
      auto message = empty;
      SampleFiller filler(seed);
      Fill(message, filler);
      Bytes bytes;
      Encode(message, bytes);
      std::printf("%s %s %u %s\n", std::string(schema.name).c_str(), definition.c_str(), seed,
                  Hex(bytes).c_str());
    }
  });
  return 0;
}
