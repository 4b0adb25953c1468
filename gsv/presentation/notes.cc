#include "gsv/presentation/notes.h"

#include <charconv>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "gsv/messages/time.h"

namespace gsv::presentation {
namespace {

constexpr std::string_view kAt = "at ";
constexpr std::string_view kEnd = " s: ";
constexpr double kMaxNoteTime = 9e9;  // s; the latest time that fits in 64 bits of nanoseconds

struct ParsedNote {
  base::SimTime time{};
  std::string_view text;
};

std::optional<ParsedNote> ParseNote(std::string_view detail) {
  if (!detail.starts_with(kAt)) return std::nullopt;
  const std::size_t end = detail.find(kEnd);
  if (end == std::string_view::npos) return std::nullopt;
  double seconds = 0;
  const auto parsed = std::from_chars(detail.data() + kAt.size(), detail.data() + end, seconds);
  const bool is_number = parsed.ec == std::errc() && parsed.ptr == detail.data() + end;
  if (!is_number || !(seconds >= 0 && seconds < kMaxNoteTime)) return std::nullopt;
  return ParsedNote{base::FromSeconds(seconds), detail.substr(end + kEnd.size())};
}

}  // namespace

std::string NoteDetail(base::SimTime time, std::string_view text) {
  return fmt::format("{}{:.9g}{}{}", kAt, base::ToSeconds(time), kEnd, text);
}

base::SimTime TimeOfNote(const simulation::Event& event) {
  const auto note = ParseNote(event.detail);
  return note ? note->time : event.time;
}

messages::gsv_msgs::LifecycleEvent NoteMessage(const simulation::Event& event) {
  const auto note = ParseNote(event.detail);
  messages::gsv_msgs::LifecycleEvent message;
  message.stamp = messages::ToMessage(note ? note->time : event.time);
  message.step = static_cast<std::uint64_t>(event.step);
  message.event = event.kind;
  message.robot = event.robot;
  message.detail = note ? std::string(note->text) : event.detail;
  return message;
}

}  // namespace gsv::presentation
