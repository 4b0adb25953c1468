#include "gsv/recording/reading/lasting_messages.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>

#include <nlohmann/json.hpp>

#include "gsv/base/sorting.h"
#include "gsv/messages/definition.h"

namespace gsv::recording {
namespace {

struct Known {
  std::string_view topic;
  Lasting lasting;
};
constexpr std::array kKnown{
    Known{"/gsv/commands", Lasting::kOfEach},
    Known{"/gsv/actuators", Lasting::kOfEach},
    Known{"/gsv/edits", Lasting::kAll},
};

std::string ValueOr(const StringMap& metadata, const std::string& key) {
  const auto found = metadata.find(key);
  return found == metadata.end() ? std::string() : found->second;
}

bool IsKeptForLateSubscribers(const StringMap& metadata) {
  if (ValueOr(metadata, "latching") == "1") return true;
  const std::string qos = ValueOr(metadata, "offered_qos_profiles");
  return qos.find("durability: 1") != std::string::npos ||
         qos.find("durability: transient_local") != std::string::npos;
}

class LastingSearch {
 public:
  LastingSearch(const McapReader& reader, base::SimTime time) : reader_(reader), time_(time) {
    const Summary& summary = reader.summary();
    for (const auto& [id, channel] : summary.channels) {
      const Lasting lasting = LastingOf(summary, channel);
      if (lasting == Lasting::kNo) continue;
      Channel& known = channels_[id];
      known.lasting = lasting;
      const auto schema = summary.schemas.find(channel.schema_id);
      if (lasting != Lasting::kOfEach || schema == summary.schemas.end()) continue;
      auto definition = messages::Definition::Parse(schema->second.name, schema->second.data);
      if (definition) known.definition = *std::move(definition);
    }
  }

  LastingMessages Run() {
    if (channels_.empty()) return {};
    for (const MessageBlock& block : reader_.summary().blocks) {
      if (block.start < time_ && MayHoldOne(block)) ReadBlock(block);
    }
    // The last message for each key, ordered by offset in the file.
    std::vector<std::pair<std::uint64_t, LastingMessage>> found;
    for (auto& [key, each] : newest_) found.emplace_back(each.place, std::move(each.message));
    base::Sort(found, [](const auto& a, const auto& b) { return a.first < b.first; });
    for (auto& [place, message] : found) result_.messages.push_back(std::move(message));
    return std::move(result_);
  }

 private:
  struct Channel {
    Lasting lasting = Lasting::kNo;
    std::optional<messages::Definition> definition;  // set for channels of the kind kOfEach
  };
  struct Found {
    std::uint64_t place = 0;  // number of the message in the order of the file
    base::SimTime log_time{};
    LastingMessage message;
  };
  using Key = std::pair<std::uint16_t, std::string>;

  bool MayHoldOne(const MessageBlock& block) const {
    return block.channels.empty() ||
           std::any_of(block.channels.begin(), block.channels.end(),
                       [&](std::uint16_t channel) { return channels_.contains(channel); });
  }

  void ReadBlock(const MessageBlock& block) {
    const base::Result<BlockMessages> content = reader_.Messages(block);
    if (!content) {
      result_.problems.push_back(
          {base::Problem::Severity::kWarning, content.error().message, content.error().where});
      return;
    }
    for (const MessageRecord& message : content->messages) {
      const auto channel = channels_.find(message.channel_id);
      if (channel == channels_.end() || message.log_time >= time_) continue;
      Found& found = newest_[{message.channel_id, KeyOf(channel->second, message)}];
      if (!found.message.data.empty() && found.log_time > message.log_time) continue;
      found = {++place_,
               message.log_time,
               {message.channel_id, message.sequence, message.publish_time,
                Bytes(message.data.begin(), message.data.end())}};
    }
  }

  // Returns the key of a message. A message replaces the earlier message with the same key.
  std::string KeyOf(const Channel& channel, const MessageRecord& message) const {
    if (channel.lasting == Lasting::kAll) return std::to_string(place_);
    if (!channel.definition) return {};
    const auto content = channel.definition->Decode(message.data);
    if (!content || !content->is_object()) return {};
    std::string key;
    for (const char* const field : {"robot", "actuator"}) {
      const auto value = content->find(field);
      if (value != content->end() && value->is_string()) key += value->get<std::string>() + "\n";
    }
    return key;
  }

  const McapReader& reader_;
  const base::SimTime time_;
  std::map<std::uint16_t, Channel> channels_;
  std::map<Key, Found> newest_;
  std::uint64_t place_ = 0;
  LastingMessages result_;
};

}  // namespace

Lasting LastingOf(const Summary& summary, const ChannelRecord& channel) {
  for (const Known& known : kKnown) {
    if (channel.topic == known.topic) return known.lasting;
  }
  if (channel.topic == "/tf_static" || channel.topic.ends_with("/tf_static"))
    return Lasting::kNewest;
  if (channel.topic.starts_with("/gsv/") || channel.topic == "/rosout") return Lasting::kNo;
  if (IsKeptForLateSubscribers(channel.metadata)) return Lasting::kNewest;
  const auto count = summary.message_counts.find(channel.id);
  const bool is_single = count != summary.message_counts.end() && count->second == 1;
  return is_single ? Lasting::kNewest : Lasting::kNo;
}

LastingMessages FindLastingMessages(const McapReader& reader, base::SimTime time) {
  return LastingSearch(reader, time).Run();
}

}  // namespace gsv::recording
