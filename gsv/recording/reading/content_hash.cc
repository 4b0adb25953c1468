#include "gsv/recording/reading/content_hash.h"

#include <cinttypes>
#include <cstdio>

#include "gsv/base/hash.h"

namespace gsv::recording {
namespace {

std::uint64_t HashOf(const MessageRecord& message, const Summary& summary) {
  const ChannelRecord& channel = summary.channels.at(message.channel_id);
  const auto schema = summary.schemas.find(channel.schema_id);
  base::Hash hash;
  hash.Add(std::string_view(channel.topic));
  hash.Add(schema == summary.schemas.end() ? std::string_view()
                                           : std::string_view(schema->second.name));
  hash.Add(std::int64_t{message.log_time.count()});
  hash.Add(std::uint64_t{message.sequence});
  hash.Add(
      std::string_view(reinterpret_cast<const char*>(message.data.data()), message.data.size()));
  return hash.Digest();
}

}  // namespace

bool IsReproducible(const ChannelRecord& channel) {
  const auto found = channel.metadata.find("reproducible");
  return found == channel.metadata.end() || found->second != "false";
}

base::Result<std::string> ContentHash(const McapReader& reader) {
  std::uint64_t sum = 0;
  for (const MessageBlock& block : reader.summary().blocks) {
    const auto content = reader.Messages(block);
    if (!content) return base::Fail(content.error());
    for (const MessageRecord& message : content->messages) {
      if (IsReproducible(reader.summary().channels.at(message.channel_id))) {
        sum += HashOf(message, reader.summary());
      }
    }
  }
  char text[17];
  std::snprintf(text, sizeof text, "%016" PRIx64, sum);
  return std::string(text);
}

}  // namespace gsv::recording
