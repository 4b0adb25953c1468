// Runs a fuzz target on each file of its corpus, and then for five seconds on random changes of
// these files. The target is compiled like all other tests. `make fuzz` selects changes that lead
// to new code, but requires clang.
#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::chrono::seconds kTime{5};
constexpr std::size_t kMaxBytes = 16'384;

// The files are ordered by name, so that a seed has the same meaning on every machine.
std::map<std::string, Bytes> Corpus() {
  std::map<std::string, Bytes> corpus;
  for (const auto& entry : std::filesystem::directory_iterator(GSV_FUZZ_CORPUS)) {
    std::ifstream file(entry.path(), std::ios::binary);
    corpus[entry.path().filename()] = Bytes(std::istreambuf_iterator<char>(file), {});
  }
  return corpus;
}

class Mutator {
 public:
  Mutator(const std::map<std::string, Bytes>& corpus, unsigned seed) : random_(seed) {
    for (const auto& [name, bytes] : corpus) inputs_.push_back(bytes);
  }

  Bytes Next() {
    Bytes bytes = Any();
    for (std::size_t changes = 1 + Below(4); changes > 0; --changes) Change(bytes);
    if (bytes.size() > kMaxBytes) bytes.resize(kMaxBytes);
    return bytes;
  }

 private:
  std::size_t Below(std::size_t end) { return random_() % end; }
  const Bytes& Any() { return inputs_[Below(inputs_.size())]; }

  // Changes the input: flips a bit, sets a byte to an extreme value, truncates, removes,
  // duplicates, or inserts a piece of another input.
  void Change(Bytes& bytes) {
    constexpr std::uint8_t kExtremes[] = {0, 1, 0x7f, 0x80, 0xff};
    if (bytes.empty()) bytes.push_back(0);
    const std::size_t at = Below(bytes.size());
    const auto from = bytes.begin() + static_cast<std::ptrdiff_t>(at);
    const auto to =
        from + static_cast<std::ptrdiff_t>(1 + Below(std::min(bytes.size() - at, std::size_t{64})));
    switch (Below(6)) {
      case 0:
        bytes[at] ^= static_cast<std::uint8_t>(1u << Below(8));
        break;
      case 1:
        bytes[at] = kExtremes[Below(std::size(kExtremes))];
        break;
      case 2:
        bytes.resize(at);
        break;
      case 3:
        bytes.erase(from, to);
        break;
      case 4: {
        const Bytes piece(from, to);
        bytes.insert(from, piece.begin(), piece.end());
        break;
      }
      default: {
        const Bytes& other = Any();
        const std::size_t start = Below(other.size() + 1);
        const std::size_t length = std::min(other.size() - start, Below(64));
        const auto piece = other.begin() + static_cast<std::ptrdiff_t>(start);
        bytes.insert(from, piece, piece + static_cast<std::ptrdiff_t>(length));
      }
    }
  }

  std::mt19937 random_;
  std::vector<Bytes> inputs_;
};

// The current input. It is saved if it crashes the program.
Bytes g_input;
std::string g_kept;

void KeepInput(int signal) {
  const int file = open(g_kept.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0644);
  const bool is_kept = file >= 0 && write(file, g_input.data(), g_input.size()) >= 0;
  if (is_kept) dprintf(STDERR_FILENO, "what failed is in %s\n", g_kept.c_str());
  std::signal(signal, SIG_DFL);
  raise(signal);
}

TEST(Fuzz, GSV_FUZZ_TEST_NAME) {
  const char* const folder = std::getenv("GSV_BUILD_DIR");
  g_kept = std::string(folder != nullptr ? folder : ".") + "/fuzz_" +
           ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".input";
  for (const int signal : {SIGABRT, SIGSEGV, SIGFPE}) std::signal(signal, KeepInput);
  const auto corpus = Corpus();
  ASSERT_FALSE(corpus.empty());
  for (const auto& [name, bytes] : corpus) {
    SCOPED_TRACE(name);
    EXPECT_EQ(LLVMFuzzerTestOneInput(bytes.data(), bytes.size()), 0);
  }
  const char* const given = std::getenv("GSV_FUZZ_SEED");
  const unsigned seed = given != nullptr ? static_cast<unsigned>(std::atoi(given)) : 1;
  Mutator mutator(corpus, seed);
  std::uint64_t inputs = 0;
  const auto end = std::chrono::steady_clock::now() + kTime;
  for (; std::chrono::steady_clock::now() < end; ++inputs) {
    SCOPED_TRACE("GSV_FUZZ_SEED=" + std::to_string(seed) + ", input " + std::to_string(inputs));
    g_input = mutator.Next();
    ASSERT_EQ(LLVMFuzzerTestOneInput(g_input.data(), g_input.size()), 0);
  }
  std::printf("%llu inputs\n", static_cast<unsigned long long>(inputs));
}

}  // namespace
