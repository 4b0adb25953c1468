#include "gsv/gateway/metrics/exposition.h"

#include <cmath>

#include <fmt/format.h>

namespace gsv::gateway::metrics {
namespace {

std::string Escaped(std::string_view text, bool is_label) {
  std::string escaped;
  for (const char c : text) {
    if (c == '\\') {
      escaped += "\\\\";
    } else if (c == '\n') {
      escaped += "\\n";
    } else if (c == '"' && is_label) {
      escaped += "\\\"";
    } else {
      escaped += c;
    }
  }
  return escaped;
}

std::string NumberText(double value) {
  if (std::isnan(value)) return "NaN";
  if (std::isinf(value)) return value > 0 ? "+Inf" : "-Inf";
  return fmt::format("{}", value);
}

}  // namespace

void Exposition::Begin(std::string_view name, Kind kind, std::string_view help) {
  name_ = name;
  text_ += fmt::format("# HELP {} {}\n# TYPE {} {}\n", name, Escaped(help, false), name,
                       kind == Kind::kCounter ? "counter" : "gauge");
}

void Exposition::Add(double value, std::initializer_list<Label> labels) {
  Line(labels, NumberText(value));
}

void Exposition::Add(std::uint64_t value, std::initializer_list<Label> labels) {
  Line(labels, fmt::format("{}", value));
}

void Exposition::Line(std::initializer_list<Label> labels, const std::string& value) {
  text_ += name_;
  if (labels.size() > 0) {
    char before = '{';
    for (const Label& label : labels) {
      text_ += fmt::format("{}{}=\"{}\"", before, label.name, Escaped(label.value, true));
      before = ',';
    }
    text_ += '}';
  }
  text_ += ' ' + value + '\n';
}

}  // namespace gsv::gateway::metrics
