#include "apps/gsv/serving/server_limits.h"

#include <charconv>
#include <cstdint>

namespace gsv::app {
namespace {

struct NamedLimit {
  const char* name;
  std::uint64_t most;  // the value to which the limit can be raised
  void (*set)(ServerLimits&, std::uint64_t);
};

constexpr std::uint64_t kAnyNumber = std::uint64_t{1} << 40;

constexpr NamedLimit kServerLimits[] = {
    {"simulations", 10'000, [](ServerLimits& l, std::uint64_t n) { l.simulations = n; }},
    {"robots", 10'000'000, [](ServerLimits& l, std::uint64_t n) { l.simulation.robots = n; }},
    {"sensors_of_a_robot", 100'000,
     [](ServerLimits& l, std::uint64_t n) { l.simulation.sensors_of_a_robot = n; }},
    {"reading_bytes", kAnyNumber,
     [](ServerLimits& l, std::uint64_t n) { l.reading.sandbox.memory_bytes = n; }},
    {"reading_seconds", 86'400,
     [](ServerLimits& l, std::uint64_t n) {
       l.reading.wall_time = std::chrono::seconds(n);
       l.reading.sandbox.processor_time = std::chrono::seconds(n);
     }},
    {"connections", 100'000, [](ServerLimits& l, std::uint64_t n) { l.web.connections = n; }},
    {"request_bytes", std::uint64_t{1} << 30,
     [](ServerLimits& l, std::uint64_t n) { l.web.body_bytes = n; }},
    {"message_bytes", std::uint64_t{1} << 30,
     [](ServerLimits& l, std::uint64_t n) { l.web.message_bytes = n; }},
    {"viewer_queue_bytes", kAnyNumber,
     [](ServerLimits& l, std::uint64_t n) { l.web.send.data_bytes = n; }},
    {"viewer_queue_messages", 1'000'000,
     [](ServerLimits& l, std::uint64_t n) { l.web.send.data_messages = n; }},
    {"upload_bytes", std::uint64_t{1} << 34,
     [](ServerLimits& l, std::uint64_t n) { l.web.upload_bytes = n; }},
    {"uploads_at_once", 1000, [](ServerLimits& l, std::uint64_t n) { l.web.uploads_at_once = n; }},
    {"uploaded_bytes", kAnyNumber, [](ServerLimits& l, std::uint64_t n) { l.uploads.bytes = n; }},
    {"uploaded_files", 10'000'000, [](ServerLimits& l, std::uint64_t n) { l.uploads.files = n; }},
    {"replays", 10'000, [](ServerLimits& l, std::uint64_t n) { l.replays.sessions = n; }},
};

const NamedLimit* FindServerLimit(const std::string& name) {
  for (const NamedLimit& limit : kServerLimits) {
    if (name == limit.name) return &limit;
  }
  return nullptr;
}

}  // namespace

bool IsServerLimit(const std::string& name) { return FindServerLimit(name) != nullptr; }

std::string ServerLimitNames() {
  std::string names;
  for (const NamedLimit& limit : kServerLimits) {
    names += (names.empty() ? "" : ", ") + std::string(limit.name);
  }
  return names;
}

base::Status SetServerLimit(const std::string& text, ServerLimits& limits) {
  const std::size_t equals = text.find('=');
  const std::string name = text.substr(0, equals);
  const std::string number = equals == std::string::npos ? "" : text.substr(equals + 1);
  const NamedLimit& limit = *FindServerLimit(name);
  std::uint64_t value = 0;
  const char* const last = number.data() + number.size();
  const auto [end, error] = std::from_chars(number.data(), last, value);
  if (error != std::errc() || end != last || value == 0 || value > limit.most) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      name + " must be a whole number from 1 to " + std::to_string(limit.most) +
                          ", not \"" + number + "\"");
  }
  limit.set(limits, value);
  return {};
}

}  // namespace gsv::app
