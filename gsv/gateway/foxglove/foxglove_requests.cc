#include "gsv/gateway/foxglove/foxglove_requests.h"

#include <bit>
#include <concepts>
#include <limits>

#include <nlohmann/json.hpp>

namespace gsv::gateway::foxglove {
namespace {

using Json = nlohmann::json;

base::Failure<base::Error> Malformed(std::string_view expected) {
  return base::Fail(base::ErrorCode::kCorrupt,
                    "a message does not follow the Foxglove protocol: " + std::string(expected));
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
    if (!id) return Malformed("'subscriptionIds' must contain only numbers");
    message.subscriptions.push_back(*id);
  }
  return message;
}

// Maximum length in bytes of a request's id, which the server sends back.
constexpr std::size_t kMaxRequestLength = 256;

base::Result<std::string> ParseRequest(const Json& json) {
  const Json& id = Member(json, "id");
  if (id.is_null()) return std::string();
  if (id.is_string() && id.get_ref<const std::string&>().size() <= kMaxRequestLength) {
    return id.get<std::string>();
  }
  return Malformed("'id' must be a string of at most 256 bytes");
}

base::Result<std::vector<std::string>> ParseNames(const Json& json) {
  const Json& list = Member(json, "parameterNames");
  std::vector<std::string> names;
  if (!list.is_array()) return Malformed("an array 'parameterNames' is missing");
  for (const Json& name : list) {
    if (!name.is_string()) return Malformed("a parameter's name must be a string");
    names.push_back(name.get<std::string>());
  }
  return names;
}

base::Result<ClientMessage> ParseGetParameters(const Json& json) {
  auto names = ParseNames(json);
  if (!names) return base::Fail(names.error());
  auto request = ParseRequest(json);
  if (!request) return base::Fail(request.error());
  return GetParameters{*std::move(names), *std::move(request)};
}

base::Result<ClientMessage> ParseWatchParameters(const Json& json, bool is_end) {
  auto names = ParseNames(json);
  if (!names) return base::Fail(names.error());
  return WatchParameters{*std::move(names), is_end};
}

ParameterValue ParseValue(const Json& json) {
  if (json.is_boolean()) return json.get<bool>();
  if (json.is_number()) return json.get<double>();
  if (json.is_string()) return json.get<std::string>();
  return std::monostate();
}

base::Result<ClientMessage> ParseSetParameters(const Json& json) {
  const Json& list = Member(json, "parameters");
  if (!list.is_array()) return Malformed("'setParameters' needs an array 'parameters'");
  auto request = ParseRequest(json);
  if (!request) return base::Fail(request.error());
  SetParameters message{{}, *std::move(request)};
  for (const Json& entry : list) {
    const Json& name = Member(entry, "name");
    if (!name.is_string()) return Malformed("a parameter needs the string 'name'");
    message.parameters.push_back({name.get<std::string>(), ParseValue(Member(entry, "value"))});
  }
  return message;
}

// Maximum length in bytes of a view's camera parameters.
constexpr std::size_t kMaxCameraLength = 1024;

base::Result<ClientMessage> ParseWatchView(const Json& json) {
  const std::optional<std::uint32_t> id = AsId(Member(json, "id"));
  const Json& camera = Member(json, "camera");
  const std::optional<std::uint32_t> sequence = AsId(Member(json, "sequence"));
  const bool is_short =
      camera.is_string() && camera.get_ref<const std::string&>().size() <= kMaxCameraLength;
  if (id && sequence && is_short) return WatchView{*id, camera.get<std::string>(), *sequence};
  return Malformed(
      "'gsvSubscribeView' needs the numbers 'id' and 'sequence' and the string 'camera' of at most "
      "1024 bytes");
}

base::Result<ClientMessage> ParseUnwatchView(const Json& json) {
  const std::optional<std::uint32_t> id = AsId(Member(json, "id"));
  if (id) return UnwatchView{*id};
  return Malformed("'gsvUnsubscribeView' needs the number 'id'");
}

base::Result<ClientMessage> ParseViewShown(const Json& json) {
  const std::optional<std::uint32_t> id = AsId(Member(json, "id"));
  const Json& image = Member(json, "image");
  if (id && image.is_number_unsigned()) return ViewShown{*id, image.get<std::uint64_t>()};
  return Malformed("'gsvViewShown' needs the numbers 'id' and 'image'");
}

// Reads values from bytes. A value beyond the end is 0.
class BytesReader {
 public:
  explicit BytesReader(std::string_view bytes) : rest_(bytes) {}

  template <std::unsigned_integral Number>
  Number Take() {
    Number value = 0;
    const std::string_view bytes = Take(sizeof value);
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      value |= static_cast<Number>(static_cast<std::uint8_t>(bytes[i])) << (8 * i);
    }
    return value;
  }
  std::string_view Take(std::size_t size) {
    if (size > rest_.size()) is_short_ = true;
    if (is_short_) return {};
    const std::string_view taken = rest_.substr(0, size);
    rest_.remove_prefix(size);
    return taken;
  }
  std::string_view rest() const { return rest_; }
  bool is_short() const { return is_short_; }

 private:
  std::string_view rest_;
  bool is_short_ = false;
};

base::Result<ClientMessage> ParseServiceCall(BytesReader reader) {
  ServiceCall message;
  message.service = reader.Take<std::uint32_t>();
  message.call = reader.Take<std::uint32_t>();
  message.encoding = reader.Take(reader.Take<std::uint32_t>());
  if (reader.is_short()) return Malformed("a service call ends too early");
  message.request = reader.rest();
  return message;
}

base::Result<ClientMessage> ParsePlaybackControl(BytesReader reader) {
  PlaybackControl message;
  const auto command = reader.Take<std::uint8_t>();
  message.speed = std::bit_cast<float>(reader.Take<std::uint32_t>());
  const bool has_seek = reader.Take<std::uint8_t>() != 0;
  const auto seek = reader.Take<std::uint64_t>();
  message.request = reader.Take(reader.Take<std::uint32_t>());
  if (reader.is_short()) return Malformed("a playback request ends too early");
  if (!reader.rest().empty()) return Malformed("a playback request has bytes after its end");
  if (command > 1) {
    return Malformed("the command of a playback request must be 0 (play) or 1 (pause), not " +
                     std::to_string(command));
  }
  if (message.request.size() > kMaxRequestLength) {
    return Malformed("the id of a playback request must have at most 256 bytes");
  }
  message.play = command == 0;
  if (has_seek) message.seek_ns = seek;
  return message;
}

}  // namespace

base::Result<ClientMessage> ParseClientMessage(std::string_view text) {
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) return Malformed("a text message must be a JSON object");
  const Json& op = Member(json, "op");
  if (!op.is_string()) return Malformed("the string 'op' is missing");
  const auto& name = op.get_ref<const std::string&>();
  if (name == "subscribe") return ParseSubscribe(Member(json, "subscriptions"));
  if (name == "unsubscribe") return ParseUnsubscribe(Member(json, "subscriptionIds"));
  if (name == "getParameters") return ParseGetParameters(json);
  if (name == "setParameters") return ParseSetParameters(json);
  if (name == "subscribeParameterUpdates") return ParseWatchParameters(json, false);
  if (name == "unsubscribeParameterUpdates") return ParseWatchParameters(json, true);
  if (name == "subscribeConnectionGraph") return WatchGraph{false};
  if (name == "unsubscribeConnectionGraph") return WatchGraph{true};
  if (name == "gsvSubscribeView") return ParseWatchView(json);
  if (name == "gsvUnsubscribeView") return ParseUnwatchView(json);
  if (name == "gsvViewShown") return ParseViewShown(json);
  return Unsupported{name.substr(0, 64)};
}

base::Result<ClientMessage> ParseClientBytes(std::string_view bytes) {
  if (bytes.empty()) return Malformed("a binary message must begin with its opcode");
  const BytesReader content(bytes.substr(1));
  switch (bytes.front()) {
    case 1:
      return Unsupported{"message data"};
    case 2:
      return ParseServiceCall(content);
    case 3:
      return ParsePlaybackControl(content);
    default:
      return Malformed("a binary message has an unknown opcode");
  }
}

}  // namespace gsv::gateway::foxglove
