// Makes reports of a campaign's results: groups of runs with confidence intervals.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "gsv/campaign/results.h"
#include "gsv/campaign/statistics.h"

namespace gsv::campaign {

// The runs with equal values of the grouping parameters.
struct Group {
  std::vector<std::string> values;   // values of the grouping parameters
  std::size_t runs = 0, passed = 0;  // number of runs, and of those that have passed
  std::map<std::string, std::vector<double>> metrics;  // by metric, the values of the group's runs
};

// The content of a report.
struct Report {
  std::string title;
  std::int64_t planned = 0;             // number of runs of the whole campaign
  std::vector<std::string> parameters;  // the parameters by which the runs are grouped
  std::vector<std::string> metrics;     // the metrics to show
  std::vector<Group> groups;            // in the order of their first runs
  // A sentence about the queue's overhead. Empty if the campaign has no queue.
  std::string queue;
};

// `by` names the parameters to group by; if it is empty, the parameters with at most 12 values are
// used. `metrics` names the metrics to show, and may be empty.
Report MakeReport(const std::vector<RunResult>& results, std::vector<std::string> by,
                  const std::vector<std::string>& parameters, std::vector<std::string> metrics);

std::string ToText(const Report& report);
// Draws a chart: the fraction of passed runs in each group, with its 95 % interval.
std::string ToSvg(const Report& report);
// Returns the report as one HTML page without further files.
std::string ToHtml(const Report& report);
// Returns a header and one line per run: run, parameters, status, state_hash, times, recording,
// message, metrics (RFC 4180).
std::string ToCsv(const std::vector<RunResult>& results,
                  const std::vector<std::string>& parameters);

}  // namespace gsv::campaign
