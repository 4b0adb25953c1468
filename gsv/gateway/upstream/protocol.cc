#include "gsv/gateway/upstream/protocol.h"

#include <algorithm>
#include <concepts>

#include <nlohmann/json.hpp>

namespace gsv::gateway::upstream {
namespace {

using Json = nlohmann::json;

base::Failure<base::Error> Malformed(const std::string& what) {
  return base::Fail(
      base::ErrorCode::kCorrupt,
      "the other gsv server sent a message that does not follow the Foxglove protocol: " + what);
}

std::string TextOf(const Json& object, const char* name) {
  const auto found = object.find(name);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

std::optional<std::uint32_t> ChannelIdOf(const Json& json) {
  if (!json.is_number_unsigned() || json.get<std::uint64_t>() > 0xffffffffu) return std::nullopt;
  return json.get<std::uint32_t>();
}

base::Result<ServerText> ParseAdvertise(const Json& json) {
  const auto list = json.find("channels");
  if (list == json.end() || !list->is_array()) return Malformed("'advertise' has no 'channels'");
  Advertise message;
  for (const Json& entry : *list) {
    if (!entry.is_object() || !entry.contains("id")) return Malformed("a channel has no 'id'");
    const std::optional<std::uint32_t> id = ChannelIdOf(entry["id"]);
    if (!id) return Malformed("a channel's 'id' is not a number");
    message.channels.push_back({*id, TextOf(entry, "topic"), TextOf(entry, "encoding"),
                                TextOf(entry, "schemaName"), TextOf(entry, "schemaEncoding"),
                                TextOf(entry, "schema")});
  }
  return message;
}

base::Result<ServerText> ParseUnadvertise(const Json& json) {
  const auto list = json.find("channelIds");
  if (list == json.end() || !list->is_array()) {
    return Malformed("'unadvertise' has no 'channelIds'");
  }
  Unadvertise message;
  for (const Json& entry : *list) {
    const std::optional<std::uint32_t> id = ChannelIdOf(entry);
    if (!id) return Malformed("a channel's 'id' must be a whole number from 0 to 4294967295");
    message.channels.push_back(*id);
  }
  return message;
}

base::Result<ServerText> ParseStatus(const Json& json) {
  // This status is about the relay's own connection, so viewers do not get it.
  if (TextOf(json, "id") == foxglove::kSlowConnectionId) return Other{};
  const auto level = json.find("level");
  const bool has_level = level != json.end() && level->is_number_unsigned();
  const auto number = has_level ? std::min<std::uint64_t>(level->get<std::uint64_t>(), 2) : 0;
  return StatusMessage{static_cast<foxglove::StatusLevel>(number), TextOf(json, "message")};
}

template <std::unsigned_integral Number>
Number Read(std::string_view bytes, std::size_t at) {
  Number value = 0;
  for (std::size_t i = 0; i < sizeof value; ++i) {
    value |= static_cast<Number>(static_cast<std::uint8_t>(bytes[at + i])) << (8 * i);
  }
  return value;
}

}  // namespace

base::Result<ServerText> ParseServerText(std::string_view text) {
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) return Malformed("a text message is not a JSON object");
  const std::string op = TextOf(json, "op");
  if (op == "advertise") return ParseAdvertise(json);
  if (op == "unadvertise") return ParseUnadvertise(json);
  if (op == "status") return ParseStatus(json);
  return Other{};
}

base::Result<ServerData> ParseServerData(std::string_view bytes) {
  constexpr std::size_t kDataHeader = 13, kTimeHeader = 9;
  if (bytes.empty()) return Malformed("a binary message is empty");
  switch (bytes[0]) {
    case 1:
      if (bytes.size() < kDataHeader) return Malformed("a data message is shorter than its header");
      return MessageData{Read<std::uint32_t>(bytes, 1), Read<std::uint64_t>(bytes, 5),
                         bytes.substr(kDataHeader)};
    case 2:
      if (bytes.size() < kTimeHeader)
        return Malformed("a time message is shorter than its 9 bytes");
      return Time{Read<std::uint64_t>(bytes, 1)};
    default:
      return Other{};
  }
}

std::string SubscribeText(std::span<const foxglove::Subscription> subscriptions) {
  Json list = Json::array();
  for (const foxglove::Subscription& subscription : subscriptions) {
    list.push_back(Json{{"id", subscription.id}, {"channelId", subscription.channel}});
  }
  return Json{{"op", "subscribe"}, {"subscriptions", std::move(list)}}.dump();
}

std::string UnsubscribeText(std::span<const foxglove::SubscriptionId> subscriptions) {
  return Json{
      {"op", "unsubscribe"},
      {"subscriptionIds", std::vector<std::uint32_t>(subscriptions.begin(), subscriptions.end())}}
      .dump();
}

}  // namespace gsv::gateway::upstream
