#include "gsv/recording/reading/decoded_messages.h"

#include <cmath>

#include <fmt/format.h>

#include "gsv/recording/reading/content_hash.h"

namespace gsv::recording {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t kMaxColumns = 10'000;

base::Result<messages::Definition> DefinitionOf(const Summary& summary,
                                                const ChannelRecord& channel) {
  const auto schema = summary.schemas.find(channel.schema_id);
  if (schema == summary.schemas.end() || schema->second.encoding != "ros2msg" ||
      channel.message_encoding != "cdr") {
    return base::Fail(base::ErrorCode::kCorrupt,
                      "its messages are not in CDR with a ros2msg schema and cannot be decoded",
                      channel.topic);
  }
  return messages::Definition::Parse(schema->second.name, schema->second.data);
}

bool IsInfinite(const ordered_json& json) {
  return json.is_number_float() && std::isinf(json.get<double>());
}

std::string Text(const ordered_json& json) {
  if (json.is_number_float() && !std::isfinite(json.get<double>())) {
    return fmt::format("{}", json.get<double>());  // fmt prints inf, -inf or nan
  }
  return json.dump(-1, ' ', false, ordered_json::error_handler_t::replace);
}

// Finds the first different part of two values, depth first.
bool FindDifference(const ordered_json& a, const ordered_json& b, const std::string& path,
                    Difference& found) {
  if (a == b) return false;
  if (a.is_structured() && b.is_structured() && a.type() == b.type() && a.size() == b.size()) {
    auto in_b = b.begin();
    for (const auto& [key, value] : a.items()) {
      const std::string below = path.empty() ? key : path + "." + key;
      if (FindDifference(value, *in_b++, below, found)) return true;
    }
  }
  found.field = path;
  found.in_first = Text(a);
  found.in_second = Text(b);
  return true;
}

// Reads the messages of a recording for a comparison, one instant at a time. A message is
// identified by its topic and its sequence number. If one of the recordings may lack messages, the
// sequence numbers differ, so the messages of a topic are counted from 0 at each instant.
class InstantReader {
 public:
  InstantReader(const McapReader& reader, const Selection& selection, Gaps gaps)
      : reader_(reader), selection_(selection), gaps_(gaps), cursor_(reader.Messages()) {}

  using Messages = std::map<std::pair<std::string, std::uint32_t>, std::vector<std::byte>>;

  // Reads the next instant. Returns false at the end.
  base::Result<bool> Next() {
    messages.clear();
    if (!has_next_) {
      if (auto ok = Advance(); !ok) return base::Fail(ok.error());
    }
    if (!has_next_) return false;
    time = next_time_;
    std::map<std::string, std::uint32_t> counts;
    while (has_next_ && next_time_ == time) {
      if (gaps_ != Gaps::kNone) next_key_.second = counts[next_key_.first]++;
      messages.emplace(next_key_, std::move(next_data_));
      if (auto ok = Advance(); !ok) return base::Fail(ok.error());
    }
    return true;
  }

  base::Result<ordered_json> Decode(const std::string& topic,
                                    const std::vector<std::byte>& data) const {
    for (const auto& [id, channel] : reader_.summary().channels) {
      if (channel.topic != topic) continue;
      const auto definition = DefinitionOf(reader_.summary(), channel);
      if (!definition) return base::Fail(definition.error());
      return definition->Decode(data);
    }
    return base::Fail(base::ErrorCode::kNotFound, "there is no such topic", topic);
  }

  // Removes from both readers the topics for which they have different numbers of messages at this
  // instant.
  void KeepCommon(InstantReader& other) {
    std::map<std::string, std::int64_t> more;
    for (const auto& [key, data] : messages) ++more[key.first];
    for (const auto& [key, data] : other.messages) --more[key.first];
    const auto is_alone = [&](const auto& message) { return more[message.first.first] != 0; };
    std::erase_if(messages, is_alone);
    std::erase_if(other.messages, is_alone);
  }

  base::SimTime time{};
  Messages messages;

 private:
  base::Status Advance() {
    has_next_ = false;
    for (;;) {
      const auto message = cursor_.Next();
      if (!message) return base::Fail(message.error());
      if (!*message) return {};
      const auto channel = reader_.summary().channels.find((*message)->channel_id);
      if (channel == reader_.summary().channels.end()) continue;
      if (!selection_.Has(channel->second.topic)) continue;
      if (!IsReproducible(channel->second)) continue;
      next_time_ = (*message)->log_time;
      next_key_ = {channel->second.topic, (*message)->sequence};
      next_data_.assign((*message)->data.begin(), (*message)->data.end());
      has_next_ = true;
      return {};
    }
  }

  const McapReader& reader_;
  const Selection& selection_;
  const Gaps gaps_;
  MessageCursor cursor_;
  bool has_next_ = false;
  base::SimTime next_time_{};
  std::pair<std::string, std::uint32_t> next_key_;
  std::vector<std::byte> next_data_;
};

// Returns the difference for a message that only one recording has. `there` reads this recording;
// `topic` and `data` are the message's topic and bytes.
base::Result<std::optional<Difference>> Missing(const InstantReader& there,
                                                const std::string& topic,
                                                const std::vector<std::byte>& data, bool in_first) {
  auto message = there.Decode(topic, data);
  if (!message) return base::Fail(message.error());
  return Difference{
      there.time,         topic, "", in_first ? "missing" : "there", in_first ? "there" : "missing",
      *std::move(message)};
}

base::Result<Difference> Compare(const InstantReader& first, const InstantReader& second,
                                 const std::string& topic, const std::vector<std::byte>& a,
                                 const std::vector<std::byte>& b) {
  Difference difference{first.time, topic, "", "", ""};
  auto decoded_a = first.Decode(topic, a);
  if (!decoded_a) return base::Fail(decoded_a.error());
  const auto decoded_b = second.Decode(topic, b);
  if (!decoded_b) return base::Fail(decoded_b.error());
  if (!FindDifference(*decoded_a, *decoded_b, "", difference)) {
    // All decoded fields are equal. Then the bytes of an image or of padding differ, which are not
    // decoded.
    difference.field = "bytes";
    difference.in_first = fmt::format("{} bytes", a.size());
    difference.in_second = fmt::format("{} others", b.size());
  }
  difference.message = *std::move(decoded_a);
  return difference;
}

base::Result<std::optional<Difference>> DifferenceAtInstant(const InstantReader& a,
                                                            const InstantReader& b) {
  auto in_a = a.messages.begin();
  auto in_b = b.messages.begin();
  for (; in_a != a.messages.end() || in_b != b.messages.end(); ++in_a, ++in_b) {
    const bool only_a =
        in_b == b.messages.end() || (in_a != a.messages.end() && in_a->first < in_b->first);
    if (only_a) return Missing(a, in_a->first.first, in_a->second, false);
    if (in_a == a.messages.end() || in_b->first < in_a->first) {
      return Missing(b, in_b->first.first, in_b->second, true);
    }
    if (in_a->second == in_b->second) continue;
    auto difference = Compare(a, b, in_a->first.first, in_a->second, in_b->second);
    if (!difference) return base::Fail(difference.error());
    return *std::move(difference);
  }
  return std::nullopt;
}

std::string Quoted(std::string text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char character : text) {
    quoted += character;
    if (character == '"') quoted += '"';
  }
  return quoted + '"';
}

// Calls `use(path, text)` for each number, flag and text.
template <typename Use>
void ForEachLeaf(const ordered_json& value, const std::string& path, const Use& use) {
  if (value.is_structured()) {
    for (const auto& [key, below] : value.items()) {
      ForEachLeaf(below, path.empty() ? key : path + "." + key, use);
    }
  } else {
    use(path, value.is_string() ? value.get<std::string>() : Text(value));
  }
}

}  // namespace

base::Result<DecodedMessages> DecodedMessages::Open(const McapReader& reader,
                                                    const Selection& selection) {
  DecodedMessages messages(reader, selection);
  for (const auto& [id, channel] : reader.summary().channels) {
    if (!selection.Has(channel.topic)) continue;
    auto definition = DefinitionOf(reader.summary(), channel);
    if (!definition) return base::Fail(definition.error());
    messages.topics_.emplace(
        id, Topic{channel.topic, reader.summary().schemas.at(channel.schema_id).name,
                  *std::move(definition)});
  }
  for (const std::string& topic : selection.topics) {
    const auto is_there = [&](const auto& each) {
      return Selection{{topic}}.Has(each.second.name);
    };
    if (std::none_of(messages.topics_.begin(), messages.topics_.end(), is_there)) {
      return base::Fail(base::ErrorCode::kNotFound,
                        "the recording has no such topic; see `gsv rec info`", topic);
    }
  }
  return messages;
}

base::Result<std::optional<DecodedMessage>> DecodedMessages::Next() {
  for (;;) {
    const auto message = cursor_.Next();
    if (!message) return base::Fail(message.error());
    if (!*message || (*message)->log_time > selection_.to) return std::nullopt;
    const auto topic = topics_.find((*message)->channel_id);
    if (topic == topics_.end()) continue;
    auto content = topic->second.definition.Decode((*message)->data);
    if (!content) return base::Fail(content.error());
    return DecodedMessage{topic->second.name, topic->second.type, (*message)->log_time,
                          *std::move(content)};
  }
}

nlohmann::ordered_json WithInfinitiesAsText(nlohmann::ordered_json content) {
  if (content.is_structured()) {
    for (ordered_json& below : content) below = WithInfinitiesAsText(std::move(below));
  } else if (IsInfinite(content)) {
    content = content.get<double>() > 0 ? "Infinity" : "-Infinity";
  }
  return content;
}

nlohmann::ordered_json ToJson(const Difference& difference) {
  return {{"time_s", base::ToSeconds(difference.time)},
          {"topic", difference.topic},
          {"field", difference.field},
          {"first", difference.in_first},
          {"second", difference.in_second}};
}

std::string Difference::Sentence() const {
  if (field.empty()) {
    return fmt::format("{:.6f} s, {}: a message is {} in the first and {} in the second",
                       base::ToSeconds(time), topic, in_first, in_second);
  }
  return fmt::format("{:.6f} s, {}, {}: {} in the first, {} in the second", base::ToSeconds(time),
                     topic, field, in_first, in_second);
}

base::Result<std::optional<Difference>> FirstDifference(const McapReader& first,
                                                        const McapReader& second,
                                                        const std::vector<std::string>& topics,
                                                        Gaps gaps) {
  const Selection selection{topics};
  InstantReader a(first, selection, gaps), b(second, selection, gaps);
  auto more_a = a.Next(), more_b = b.Next();
  for (;;) {
    if (!more_a) return base::Fail(more_a.error());
    if (!more_b) return base::Fail(more_b.error());
    if (!*more_a && !*more_b) return std::nullopt;
    const bool only_a = !*more_b || (*more_a && a.time < b.time);
    const bool only_b = !*more_a || (*more_b && b.time < a.time);
    if (only_a || only_b) {
      InstantReader& alone = only_a ? a : b;
      if (gaps == Gaps::kNone) {
        const auto& [key, data] = *alone.messages.begin();
        return Missing(alone, key.first, data, only_b);
      }
      (only_a ? more_a : more_b) = alone.Next();
      continue;
    }
    if (gaps != Gaps::kNone) a.KeepCommon(b);
    auto difference = DifferenceAtInstant(a, b);
    if (!difference || *difference) return difference;
    more_a = a.Next();
    more_b = b.Next();
  }
}

base::Result<std::string> ToCsv(const McapReader& reader, const Selection& selection) {
  std::map<std::string, std::size_t> columns;
  std::string header = "time_s";
  std::vector<std::vector<std::string>> rows;
  auto messages = DecodedMessages::Open(reader, selection);
  if (!messages) return base::Fail(messages.error());
  for (;;) {
    const auto message = messages->Next();
    if (!message) return base::Fail(message.error());
    if (!*message) break;
    std::vector<std::string> row{fmt::format("{:.9f}", base::ToSeconds((*message)->time))};
    ForEachLeaf((*message)->content, "", [&](const std::string& path, std::string text) {
      const auto [column, is_new] = columns.try_emplace(path, columns.size() + 1);
      if (is_new) header += "," + Quoted(path);
      if (row.size() <= column->second) row.resize(column->second + 1);
      row[column->second] = std::move(text);
    });
    if (columns.size() > kMaxColumns) {
      return base::Fail(base::ErrorCode::kInvalidArgument,
                        "its messages have more than 10,000 values; export another topic",
                        (*message)->topic);
    }
    rows.push_back(std::move(row));
  }
  std::string csv = header + "\r\n";
  for (std::vector<std::string>& row : rows) {
    row.resize(columns.size() + 1);
    for (std::size_t i = 0; i < row.size(); ++i) csv += (i > 0 ? "," : "") + Quoted(row[i]);
    csv += "\r\n";
  }
  return csv;
}

}  // namespace gsv::recording
