#include "gsv/gateway/foxglove/foxglove_operations.h"

#include <algorithm>
#include <bit>
#include <concepts>

#include <nlohmann/json.hpp>

namespace gsv::gateway::foxglove {
namespace {

using Json = nlohmann::json;

constexpr std::string_view kEncoding = "cdr", kSchemaEncoding = "ros2msg";

std::string OperationText(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json ToJson(const ServiceMessage& message) {
  return {{"encoding", kEncoding},
          {"schemaName", message.schema_name},
          {"schemaEncoding", kSchemaEncoding},
          {"schema", message.schema}};
}

Json ToJson(const Parameter& parameter) {
  Json json{{"name", parameter.name}};
  if (const auto* flag = std::get_if<bool>(&parameter.value)) json["value"] = *flag;
  if (const auto* text = std::get_if<std::string>(&parameter.value)) json["value"] = *text;
  if (const auto* number = std::get_if<double>(&parameter.value)) {
    json["value"] = *number;
    json["type"] = "float64";
  }
  return json;
}

// Returns the entries of `after` that are missing in `before` or differ from it.
Json Changed(const ConnectionGraph::Parties& before, const ConnectionGraph::Parties& after,
             const char* parties_name) {
  Json list = Json::array();
  for (const auto& [name, parties] : after) {
    const auto known = before.find(name);
    if (known != before.end() && known->second == parties) continue;
    list.push_back({{"name", name}, {parties_name, parties}});
  }
  return list;
}

Json Removed(const ConnectionGraph::Parties& before, const ConnectionGraph::Parties& after) {
  Json list = Json::array();
  for (const auto& [name, parties] : before) {
    if (!after.contains(name)) list.push_back(name);
  }
  return list;
}

// Appends numbers to bytes, in little endian.
class BytesWriter {
 public:
  explicit BytesWriter(std::uint8_t opcode) { Put(opcode); }

  template <std::unsigned_integral Number>
  void Put(Number value) {
    for (std::size_t i = 0; i < sizeof value; ++i) {
      bytes_.push_back(static_cast<std::byte>(value >> (8 * i)));
    }
  }
  void Put(std::string_view text) {
    Put(static_cast<std::uint32_t>(text.size()));
    Append(std::as_bytes(std::span(text)));
  }
  void Append(std::span<const std::byte> bytes) {
    bytes_.insert(bytes_.end(), bytes.begin(), bytes.end());
  }
  std::vector<std::byte> Take() { return std::move(bytes_); }

 private:
  std::vector<std::byte> bytes_;
};

}  // namespace

std::string AdvertiseServicesText(std::span<const Service> services) {
  Json list = Json::array();
  for (const Service& service : services) {
    // The schemas are sent twice, because clients of the older protocol read only the last two
    // members.
    list.push_back({{"id", service.id},
                    {"name", service.name},
                    {"type", service.type},
                    {"request", ToJson(service.request)},
                    {"response", ToJson(service.response)},
                    {"requestSchema", service.request.schema},
                    {"responseSchema", service.response.schema}});
  }
  return OperationText({{"op", "advertiseServices"}, {"services", std::move(list)}});
}

std::string ServiceFailureText(std::uint32_t service, std::uint32_t call,
                               std::string_view message) {
  return OperationText({{"op", "serviceCallFailure"},
                        {"serviceId", service},
                        {"callId", call},
                        {"message", message}});
}

std::string ViewFailureText(std::uint32_t view, std::string_view message) {
  return OperationText({{"op", "gsvViewFailure"}, {"id", view}, {"message", message}});
}

std::string ParameterValuesText(std::span<const Parameter> parameters, const std::string& request) {
  Json list = Json::array();
  for (const Parameter& parameter : parameters) list.push_back(ToJson(parameter));
  Json json{{"op", "parameterValues"}, {"parameters", std::move(list)}};
  if (!request.empty()) json["id"] = request;
  return OperationText(json);
}

std::string GraphUpdateText(const ConnectionGraph& before, const ConnectionGraph& after) {
  Json json{{"publishedTopics", Changed(before.publishers, after.publishers, "publisherIds")},
            {"subscribedTopics", Changed(before.subscribers, after.subscribers, "subscriberIds")},
            {"advertisedServices", Changed(before.providers, after.providers, "providerIds")},
            {"removedTopics", Removed(before.publishers, after.publishers)},
            {"removedServices", Removed(before.providers, after.providers)}};
  // A topic that has lost its last subscriber has an empty list.
  for (const auto& [topic, subscribers] : before.subscribers) {
    if (after.subscribers.contains(topic) || !after.publishers.contains(topic)) continue;
    json["subscribedTopics"].push_back({{"name", topic}, {"subscriberIds", Json::array()}});
  }
  const bool is_same =
      std::all_of(json.begin(), json.end(), [](const Json& list) { return list.empty(); });
  if (is_same) return {};
  json["op"] = "connectionGraphUpdate";
  return OperationText(json);
}

std::vector<std::byte> ServiceResponseBytes(std::uint32_t service, std::uint32_t call,
                                            std::span<const std::byte> response) {
  BytesWriter writer(3);
  writer.Put(service);
  writer.Put(call);
  writer.Put(kEncoding);
  writer.Append(response);
  return writer.Take();
}

std::vector<std::byte> PlaybackStateBytes(const PlaybackState& state) {
  BytesWriter writer(5);
  writer.Put(static_cast<std::uint8_t>(state.status));
  writer.Put(state.time_ns);
  writer.Put(std::bit_cast<std::uint32_t>(state.speed));
  writer.Put(static_cast<std::uint8_t>(state.did_seek ? 1 : 0));
  writer.Put(std::string_view(state.request));
  return writer.Take();
}

}  // namespace gsv::gateway::foxglove
