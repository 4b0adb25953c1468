// What a campaign's results say: by parameters, with confidence intervals.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "gsv/campaign/results.h"
#include "gsv/campaign/statistics.h"

namespace gsv::campaign {

// The runs that agree in the parameters that are looked at.
struct Group {
  std::vector<std::string> values;  // of those parameters
  std::size_t runs = 0, passed = 0;
  std::map<std::string, std::vector<double>> metrics;
};

struct Report {
  std::string title;
  std::int64_t planned = 0;
  std::vector<std::string> parameters;  // that are looked at
  std::vector<std::string> metrics;     // that are shown
  std::vector<Group> groups;            // in the order of their first runs
  std::string queue;                    // what the queue cost, a sentence; empty: there was none
};

// `by`: the parameters to look at; empty: those with 12 values at most. `metrics`: the names to
// show; empty: none.
Report MakeReport(const std::vector<RunResult>& results, std::vector<std::string> by,
                  const std::vector<std::string>& parameters, std::vector<std::string> metrics);

std::string ToText(const Report& report);
std::string ToSvg(const Report& report);   // the share that passed, by group
std::string ToHtml(const Report& report);  // one page that needs no other file
// One line a run: run, parameters, status, state_hash, times, metrics (RFC 4180).
std::string ToCsv(const std::vector<RunResult>& results,
                  const std::vector<std::string>& parameters);

}  // namespace gsv::campaign
