#include "gsv/gateway/foxglove/foxglove.h"

#include <algorithm>
#include <concepts>

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

Json ToJson(std::uint64_t time_ns) {
  constexpr std::uint64_t kSecond = 1'000'000'000;
  return {{"sec", time_ns / kSecond}, {"nsec", time_ns % kSecond}};
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
  Json json{{"op", "serverInfo"},
            {"name", info.name},
            {"capabilities", info.capabilities},
            {"metadata", info.metadata},
            {"sessionId", info.session_id}};
  const auto& capabilities = info.capabilities;
  if (std::find(capabilities.begin(), capabilities.end(), "services") != capabilities.end()) {
    json["supportedEncodings"] = {"cdr"};
  }
  if (info.playback) {
    json["capabilities"].push_back("playbackControl");
    json["dataStartTime"] = ToJson(info.playback->start_ns);
    json["dataEndTime"] = ToJson(info.playback->end_ns);
  }
  return Dump(json);
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

std::string StatusText(StatusLevel level, std::string_view message, std::string_view id) {
  Json json{{"op", "status"}, {"level", static_cast<int>(level)}, {"message", message}};
  if (!id.empty()) json["id"] = id;
  return Dump(json);
}

std::string RemoveStatusText(std::string_view id) {
  return Dump({{"op", "removeStatus"}, {"statusIds", Json::array({id})}});
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
