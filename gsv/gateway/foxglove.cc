#include "gsv/gateway/foxglove.h"

#include <algorithm>
#include <concepts>
#include <limits>
#include <optional>

#include <nlohmann/json.hpp>

namespace gsv::gateway::foxglove {
namespace {

using Json = nlohmann::json;

std::string Dump(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::string_view Trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

bool Offers(std::string_view offered, std::string_view name) {
  while (!offered.empty()) {
    const std::size_t comma = offered.find(',');
    if (Trimmed(offered.substr(0, comma)) == name) return true;
    if (comma == std::string_view::npos) break;
    offered.remove_prefix(comma + 1);
  }
  return false;
}

tl::unexpected<base::Error> Malformed(std::string_view expected) {
  return base::Fail(base::ErrorCode::kCorrupt,
                    "a message is not one of the Foxglove protocol: " + std::string(expected));
}

std::optional<std::uint32_t> AsId(const Json& json) {
  if (!json.is_number_unsigned()) return std::nullopt;
  const auto value = json.get<std::uint64_t>();
  if (value > std::numeric_limits<std::uint32_t>::max()) return std::nullopt;
  return static_cast<std::uint32_t>(value);
}

const Json& Member(const Json& object, const char* name) {
  static const Json kNull;
  if (!object.is_object()) return kNull;
  const auto found = object.find(name);
  return found == object.end() ? kNull : *found;
}

base::Result<ClientMessage> ParseSubscribe(const Json& list) {
  if (!list.is_array()) return Malformed("'subscribe' needs an array 'subscriptions'");
  Subscribe message;
  for (const Json& entry : list) {
    const std::optional<std::uint32_t> id = AsId(Member(entry, "id"));
    const std::optional<std::uint32_t> channel = AsId(Member(entry, "channelId"));
    if (!id || !channel) return Malformed("a subscription needs the numbers 'id' and 'channelId'");
    message.subscriptions.push_back({*id, *channel});
  }
  return message;
}

base::Result<ClientMessage> ParseUnsubscribe(const Json& list) {
  if (!list.is_array()) return Malformed("'unsubscribe' needs an array 'subscriptionIds'");
  Unsubscribe message;
  for (const Json& entry : list) {
    const std::optional<std::uint32_t> id = AsId(entry);
    if (!id) return Malformed("'subscriptionIds' holds something that is not a number");
    message.subscriptions.push_back(*id);
  }
  return message;
}

template <std::unsigned_integral Number>
void Append(Number value, BinaryHeader& header) {
  for (std::size_t i = 0; i < sizeof value; ++i) {
    header.bytes[header.size++] = static_cast<std::uint8_t>(value >> (8 * i));
  }
}

}  // namespace

std::string_view ChooseSubprotocol(std::string_view offered) {
  const auto* found = std::find_if(kSubprotocols.begin(), kSubprotocols.end(),
                                   [&](std::string_view name) { return Offers(offered, name); });
  return found == kSubprotocols.end() ? std::string_view() : *found;
}

std::string ServerInfoText(const ServerInfo& info) {
  return Dump({{"op", "serverInfo"},
               {"name", info.name},
               {"capabilities", info.capabilities},
               {"metadata", info.metadata},
               {"sessionId", info.session_id}});
}

std::string AdvertiseText(std::span<const Channel> channels) {
  Json list = Json::array();
  for (const Channel& channel : channels) {
    list.push_back({{"id", channel.id},
                    {"topic", channel.topic},
                    {"encoding", channel.encoding},
                    {"schemaName", channel.schema_name},
                    {"schemaEncoding", channel.schema_encoding},
                    {"schema", channel.schema}});
  }
  return Dump({{"op", "advertise"}, {"channels", std::move(list)}});
}

std::string UnadvertiseText(std::span<const ChannelId> channels) {
  return Dump({{"op", "unadvertise"},
               {"channelIds", std::vector<ChannelId>(channels.begin(), channels.end())}});
}

std::string StatusText(StatusLevel level, std::string_view message) {
  return Dump({{"op", "status"}, {"level", static_cast<int>(level)}, {"message", message}});
}

base::Result<ClientMessage> ParseClientMessage(std::string_view text) {
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) return Malformed("a text must be a JSON object");
  const Json& op = Member(json, "op");
  if (!op.is_string()) return Malformed("the string 'op' is missing");
  const auto& name = op.get_ref<const std::string&>();
  if (name == "subscribe") return ParseSubscribe(Member(json, "subscriptions"));
  if (name == "unsubscribe") return ParseUnsubscribe(Member(json, "subscriptionIds"));
  return Unsupported{name.substr(0, 64)};
}

BinaryHeader MessageDataHeader(SubscriptionId subscription, std::uint64_t time_ns) {
  BinaryHeader header;
  Append(std::uint8_t{1}, header);
  Append(subscription, header);
  Append(time_ns, header);
  return header;
}

BinaryHeader TimeHeader(std::uint64_t time_ns) {
  BinaryHeader header;
  Append(std::uint8_t{2}, header);
  Append(time_ns, header);
  return header;
}

}  // namespace gsv::gateway::foxglove
