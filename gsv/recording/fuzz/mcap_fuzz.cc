// Fuzz test: reads arbitrary bytes as a recording. The reader must reject them, or return their
// valid part. Recover() must make a recording without errors from that part.
#include <cstdint>

#include "gsv/base/check.h"
#include "gsv/recording/reading/content_hash.h"
#include "gsv/recording/reading/newest_messages.h"
#include "gsv/recording/reading/recover.h"

using namespace gsv;
using namespace gsv::recording;

namespace {

constexpr std::uint64_t kMaxMessages = 100'000;

// Returns the number of messages from `from` on. Checks that they are ordered by time, and that the
// channel of each message exists.
std::uint64_t CountInOrder(const McapReader& reader, base::SimTime from) {
  MessageCursor cursor = reader.Messages(from);
  base::SimTime last = base::SimTime::min();
  for (std::uint64_t count = 0, errors = 0; count + errors < kMaxMessages;) {
    const auto next = cursor.Next();
    if (!next) {
      GSV_CHECK(!next.error().message.empty());
      ++errors;
      continue;
    }
    if (!*next) return count;
    GSV_CHECK(reader.summary().channels.contains((*next)->channel_id));
    GSV_CHECK((*next)->log_time >= last && (*next)->log_time >= from);
    last = (*next)->log_time;
    ++count;
  }
  return kMaxMessages;
}

void Use(const McapReader& reader) {
  const Summary& summary = reader.summary();
  CountInOrder(reader, base::SimTime::min());
  const base::SimTime middle = summary.start + (summary.end - summary.start) / 2;
  CountInOrder(reader, middle);
  for (const auto& [id, message] : FindNewestMessages(reader, middle).by_channel) {
    GSV_CHECK(message.log_time <= middle);
  }
  (void)ContentHash(reader);
  for (const AttachmentIndexRecord& index : summary.attachments) (void)reader.Read(index);
  for (const MetadataIndexRecord& index : summary.metadata) (void)reader.Read(index);
}

void Mend(const McapReader& reader) {
  Bytes bytes;
  MemorySink sink(bytes);
  const auto recovery = Recover(reader, sink);
  GSV_CHECK(recovery.has_value());
  const auto mended = McapReader::Open(std::make_unique<MemorySource>(bytes));
  GSV_CHECK(mended.has_value());
  GSV_CHECK((*mended)->summary().indexed && (*mended)->summary().problems.empty());
  GSV_CHECK((*mended)->summary().message_count == recovery->messages);
  GSV_CHECK(CountInOrder(**mended, base::SimTime::min()) == recovery->messages);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Limits limits;
  limits.record_size = std::uint64_t{1} << 20;
  limits.open_blocks_size = std::uint64_t{4} << 20;
  const auto reader = McapReader::Open(
      std::make_unique<MemorySource>(std::as_bytes(std::span(data, size))), limits);
  if (!reader) {
    GSV_CHECK(!reader.error().message.empty());
    return 0;
  }
  Use(**reader);
  Mend(**reader);
  return 0;
}
