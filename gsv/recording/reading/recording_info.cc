#include "gsv/recording/reading/recording_info.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "gsv/base/sorting.h"
#include "gsv/recording/reading/content_hash.h"

namespace gsv::recording {
namespace {

using Json = nlohmann::ordered_json;

std::vector<RecordingInfo::Channel> ChannelsOf(const Summary& summary) {
  std::vector<RecordingInfo::Channel> channels;
  for (const auto& [id, channel] : summary.channels) {
    const auto schema = summary.schemas.find(channel.schema_id);
    const auto count = summary.message_counts.find(id);
    channels.push_back({channel.topic, schema == summary.schemas.end() ? "" : schema->second.name,
                        count == summary.message_counts.end() ? 0 : count->second});
  }
  base::Sort(channels, [](const auto& a, const auto& b) { return a.topic < b.topic; });
  return channels;
}

// The function divides, because multiplying by 1e-9 would give 1.9900000000000002 for 1.99 s.
double Seconds(base::SimTime time) { return static_cast<double>(time.count()) / 1e9; }

base::Problem Warning(const base::Error& error) {
  return {base::Problem::Severity::kWarning, error.message, error.where};
}

}  // namespace

base::Result<RecordingInfo> ReadInfo(const std::string& path, const Limits& limits) {
  const auto opened = McapReader::Open(path, limits);
  if (!opened) return base::Fail(opened.error());
  const McapReader& reader = **opened;
  const Summary& summary = reader.summary();
  RecordingInfo info{.path = path,
                     .size = reader.size(),
                     .profile = summary.profile,
                     .library = summary.library,
                     .start = summary.start,
                     .end = summary.end,
                     .messages = summary.message_count,
                     .chunks = summary.blocks.size(),
                     .indexed = summary.indexed,
                     .channels = ChannelsOf(summary),
                     .attachments = {},
                     .metadata = {},
                     .content_hash = {},
                     .problems = summary.problems};
  for (const AttachmentIndexRecord& each : summary.attachments) {
    info.attachments.push_back({each.name, each.media_type, each.data_size});
  }
  for (const MetadataIndexRecord& each : summary.metadata) {
    auto metadata = reader.Read(each);
    if (metadata) info.metadata.push_back(std::move(*metadata));
    if (!metadata) info.problems.push_back(Warning(metadata.error()));
  }
  auto hash = ContentHash(reader);
  if (hash) info.content_hash = std::move(*hash);
  if (!hash) info.problems.push_back(Warning(hash.error()));
  return info;
}

base::Result<base::SimTime> EndOfSteps(const McapReader& reader) {
  const auto& channels = reader.summary().channels;
  base::SimTime end{};
  MessageCursor cursor = reader.Messages();
  for (;;) {
    const auto message = cursor.Next();
    if (!message) return base::Fail(message.error());
    if (!*message) return end;
    const auto channel = channels.find((*message)->channel_id);
    if (channel == channels.end() || !IsReproducible(channel->second)) continue;
    const auto& people = kUserTopics;
    if (std::find(std::begin(people), std::end(people), channel->second.topic) != std::end(people))
      continue;
    end = std::max(end, (*message)->log_time);
  }
}

std::string ToText(const RecordingInfo& info) {
  std::string text = fmt::format(
      "{}\n"
      "  duration      {:.3f} s, from {:.3f} s to {:.3f} s\n"
      "  messages      {} on {} topics, in {} chunks\n"
      "  size          {} bytes\n"
      "  content hash  {}\n"
      "  written by    {}, profile {}\n",
      info.path, Seconds(info.duration()), Seconds(info.start), Seconds(info.end), info.messages,
      info.channels.size(), info.chunks, info.size,
      info.content_hash.empty() ? "unknown" : info.content_hash, info.library, info.profile);
  for (const auto& channel : info.channels) {
    text += fmt::format("  {:>9}  {}  ({})\n", channel.messages, channel.topic, channel.type);
  }
  for (const auto& file : info.attachments) {
    text += fmt::format("  attachment {}, {} bytes, {}\n", file.name, file.size, file.media_type);
  }
  for (const MetadataRecord& record : info.metadata) {
    for (const auto& [key, value] : record.values) {
      text += fmt::format("  {}: {} = {}\n", record.name, key, value);
    }
  }
  for (const base::Problem& problem : info.problems) {
    text += "warning: " + problem.Sentence() + "\n";
  }
  return text;
}

std::string ToJson(const RecordingInfo& info) {
  Json channels = Json::array();
  for (const auto& channel : info.channels) {
    channels.push_back(
        {{"topic", channel.topic}, {"type", channel.type}, {"messages", channel.messages}});
  }
  Json attachments = Json::array();
  for (const auto& file : info.attachments) {
    attachments.push_back(
        {{"name", file.name}, {"media_type", file.media_type}, {"size_bytes", file.size}});
  }
  Json metadata = Json::object();
  for (const MetadataRecord& record : info.metadata) {
    for (const auto& [key, value] : record.values) metadata[record.name][key] = value;
  }
  Json warnings = Json::array();
  for (const base::Problem& problem : info.problems) warnings.push_back(problem.Sentence());
  const Json json{{"file", info.path},
                  {"size_bytes", info.size},
                  {"duration_s", Seconds(info.duration())},
                  {"start_s", Seconds(info.start)},
                  {"end_s", Seconds(info.end)},
                  {"messages", info.messages},
                  {"chunks", info.chunks},
                  {"indexed", info.indexed},
                  {"profile", info.profile},
                  {"library", info.library},
                  {"content_hash", info.content_hash.empty() ? Json() : Json(info.content_hash)},
                  {"channels", std::move(channels)},
                  {"attachments", std::move(attachments)},
                  {"metadata", std::move(metadata)},
                  {"warnings", std::move(warnings)}};
  // Texts in a file may contain invalid UTF-8, which is replaced.
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace gsv::recording
