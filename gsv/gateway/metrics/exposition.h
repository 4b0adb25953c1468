// An Exposition formats metrics for monitoring systems.
//
// Format  Prometheus' text format 0.0.4
//         (https://prometheus.io/docs/instrumenting/exposition_formats/).
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

namespace gsv::gateway::metrics {

// Writes metrics in Prometheus' text format.
class Exposition {
 public:
  enum class Kind { kCounter, kGauge };
  // A name and a value that distinguish the samples of a family.
  struct Label {
    std::string_view name, value;
  };

  // Begins a family of samples. Each name may be used once.
  void Begin(std::string_view name, Kind kind, std::string_view help);
  // Adds a sample to the current family.
  void Add(double value, std::initializer_list<Label> labels = {});
  void Add(std::uint64_t value, std::initializer_list<Label> labels = {});

  // Adds a family of one sample.
  template <typename Number>
  void Put(std::string_view name, Kind kind, std::string_view help, Number value) {
    Begin(name, kind, help);
    Add(value);
  }

  const std::string& text() const { return text_; }

 private:
  // Writes the line of one sample.
  void Line(std::initializer_list<Label> labels, const std::string& value);

  std::string name_;  // name of the current family
  std::string text_;
};

// The content type of the text.
inline constexpr std::string_view kContentType = "text/plain; version=0.0.4; charset=utf-8";

}  // namespace gsv::gateway::metrics
