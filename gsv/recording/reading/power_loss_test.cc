// Simulates a loss of power at 200 moments, with a simulated disk that writes its cache in any
// order.
#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "gsv/recording/reading/recover.h"
#include "gsv/recording/testing/test_recording.h"

namespace gsv::recording {
namespace {

constexpr std::size_t kSector = 512;

// A disk with a cache. Synchronised data are safe. Any sector that was written after the last
// synchronisation may be on the disk or may be missing.
class CachingDisk : public ByteSink {
 public:
  base::Status Write(std::span<const std::byte> bytes) override {
    PutBytes(written_, bytes);
    return {};
  }
  base::Status Sync() override {
    safe_ = written_.size();
    return {};
  }
  base::Status Truncate(std::uint64_t size) override {
    written_.resize(size);
    return {};
  }

  Bytes AfterPowerLoss(std::mt19937_64& random) const {
    Bytes left(written_.begin(), written_.begin() + static_cast<std::ptrdiff_t>(safe_));
    for (std::size_t begin = safe_; begin < written_.size();) {
      const std::size_t end = std::min(written_.size(), (begin / kSector + 1) * kSector);
      if (random() % 2 == 0) {
        left.resize(end);  // a missing sector in front of others is read as zeros
        std::copy(written_.begin() + static_cast<std::ptrdiff_t>(begin),
                  written_.begin() + static_cast<std::ptrdiff_t>(end),
                  left.begin() + static_cast<std::ptrdiff_t>(begin));
      }
      begin = end;
    }
    return left;
  }

 private:
  Bytes written_;
  std::size_t safe_ = 0;
};

struct Loss {
  Bytes left;            // content of the disk after the loss of power
  int synchronised = 0;  // number of messages (at 0, 1, 2, … ms) that are synchronised
};

Loss LosePower(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  CachingDisk disk;
  McapFileWriter writer(disk, {.chunk_size = 200 + random() % 2000});
  (void)writer.AddSchema(SchemaOfClock());
  (void)writer.AddChannel(ChannelOf(0, "/clock"));
  Loss loss;
  const int count = static_cast<int>(random() % 1000);
  for (int i = 0; i < count; ++i) {
    const Bytes data = ClockMessage(i * 1ms);
    (void)writer.Write({0, static_cast<std::uint32_t>(i), i * 1ms, i * 1ms, data});
    if (random() % 100 != 0) continue;
    (void)writer.Flush();
    loss.synchronised = i + 1;
  }
  if (random() % 10 == 0) {
    (void)writer.Close();
    loss.synchronised = count;
  }
  loss.left = disk.AfterPowerLoss(random);
  return loss;
}

TEST(PowerLoss, KeepsSynchronisedMessages) {
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    const Loss loss = LosePower(seed);
    const auto reader = Open(loss.left);
    if (loss.synchronised == 0 && !reader) continue;
    ASSERT_TRUE(reader) << reader.error().Sentence();
    Bytes mended;
    MemorySink sink(mended);
    ASSERT_TRUE(Recover(**reader, sink));
    const auto whole = Open(mended);
    ASSERT_TRUE(whole);
    EXPECT_TRUE((*whole)->summary().indexed);
    const auto found = TimesIn(**whole);
    EXPECT_EQ(found.errors, 0);
    ASSERT_GE(found.times.size(), static_cast<std::size_t>(loss.synchronised));
    for (int i = 0; i < loss.synchronised; ++i) ASSERT_EQ(found.times[i], i * 1ms);
  }
}

}  // namespace
}  // namespace gsv::recording
