// The benchmarks of `gsv bench`, each with its own subcommand. All benchmarks except that of the
// broker run the step loop of `gsv run`.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "apps/gsv/commands/commands.h"
#include "gsv/base/sorting.h"

namespace gsv::app {

void AddTypicalBench(const CommandLine& bench);
void AddLockstepBench(const CommandLine& bench);
void AddCrowdBench(const CommandLine& bench);
void AddBrokerBench(const CommandLine& bench);
void AddCameraBench(const CommandLine& bench);
void AddLidarBench(const CommandLine& bench);
void AddRigidBench(const CommandLine& bench);

inline double Seconds(std::chrono::nanoseconds duration) {
  return std::chrono::duration<double>(duration).count();
}
inline double Milliseconds(std::chrono::nanoseconds duration) {
  return std::chrono::duration<double, std::milli>(duration).count();
}

// Returns the processor time in s that all threads of a process (default: this process) have used.
inline double ProcessorTime(clockid_t clock = CLOCK_PROCESS_CPUTIME_ID) {
  timespec now;
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Returns the `q`-quantile: of n sorted values, the value at index q n (rounded down). `q` is 0.5
// for the median, 0.99 for the 99th percentile. Returns 0 if there are no values.
inline double QuantileOf(std::vector<double> values, double q) {
  if (values.empty()) return 0;
  base::Sort(values);
  const auto rank = static_cast<std::size_t>(q * static_cast<double>(values.size()));
  return values[std::min(rank, values.size() - 1)];
}

// Returns a figure as text: numbers with 5 significant digits, and strings without quotes.
inline std::string TextOf(const nlohmann::ordered_json& figure) {
  if (figure.is_string()) return figure.get<std::string>();
  if (figure.is_array()) {
    std::string text;
    for (const auto& each : figure) text += (text.empty() ? "" : " ") + TextOf(each);
    return text;
  }
  if (!figure.is_number_float()) return figure.dump();
  char text[32];
  (void)std::snprintf(text, sizeof text, "%.5g", figure.get<double>());
  return text;
}

// Prints figures to stdout, as one JSON object or as one line per figure.
inline void PrintFigures(const nlohmann::ordered_json& figures, bool as_json) {
  if (as_json) {
    std::printf("%s\n", figures.dump().c_str());
    return;
  }
  for (const auto& [name, value] : figures.items()) {
    std::printf("%-18s %s\n", name.c_str(), TextOf(value).c_str());
  }
}

}  // namespace gsv::app
