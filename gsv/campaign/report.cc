#include "gsv/campaign/report.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace gsv::campaign {
namespace {

constexpr std::size_t kFewValues = 12;
// sizes of the drawing, px
constexpr double kWidth = 720, kHeight = 300, kLeft = 60, kBottom = 60, kTop = 20;

std::string ValueIn(const RunResult& result, const std::string& parameter) {
  const auto found = result.parameters.find(parameter);
  if (found == result.parameters.end()) return "";
  return found->is_string() ? found->get<std::string>() : found->dump();
}

std::string Escaped(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    escaped += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : std::string(1, c);
  }
  return escaped;
}

std::string InCsv(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

std::string Words(const Interval& interval) {
  return fmt::format("{:.4g} [{:.4g}, {:.4g}]", interval.middle, interval.low, interval.high);
}

std::vector<std::string> Header(const Report& report) {
  std::vector<std::string> header = report.parameters;
  header.insert(header.end(), {"runs", "passed", "share [95 %]"});
  for (const std::string& metric : report.metrics) header.push_back(metric + " [95 %]");
  return header;
}

std::vector<std::string> Row(const Report& report, const Group& group) {
  std::vector<std::string> row = group.values;
  row.push_back(std::to_string(group.runs));
  row.push_back(std::to_string(group.passed));
  row.push_back(Words(PassRate(group.passed, group.runs)));
  for (const std::string& metric : report.metrics) {
    const auto found = group.metrics.find(metric);
    row.push_back(found == group.metrics.end() ? "" : Words(Mean(found->second)));
  }
  return row;
}

}  // namespace

Report MakeReport(const std::vector<RunResult>& results, std::vector<std::string> by,
                  const std::vector<std::string>& parameters, std::vector<std::string> metrics) {
  if (by.empty()) {
    for (const std::string& parameter : parameters) {
      std::set<std::string> values;
      for (const RunResult& result : results) values.insert(ValueIn(result, parameter));
      if (values.size() <= kFewValues) by.push_back(parameter);
    }
  }
  Report report;
  report.parameters = std::move(by);
  report.metrics = std::move(metrics);
  std::map<std::vector<std::string>, std::size_t> index;
  for (const RunResult& result : results) {
    std::vector<std::string> values;
    for (const std::string& parameter : report.parameters)
      values.push_back(ValueIn(result, parameter));
    const auto [entry, is_new] = index.try_emplace(values, report.groups.size());
    if (is_new) report.groups.push_back({values});
    Group& group = report.groups[entry->second];
    ++group.runs;
    group.passed += result.status == "passed";
    for (const auto& [name, value] : result.metrics.items()) {
      if (value.is_number()) group.metrics[name].push_back(value.get<double>());
    }
  }
  return report;
}

std::string ToText(const Report& report) {
  std::vector<std::vector<std::string>> rows{Header(report)};
  for (const Group& group : report.groups) rows.push_back(Row(report, group));
  std::vector<std::size_t> widths(rows.front().size());
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text;
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) text += fmt::format("{:<{}}  ", row[i], widths[i]);
    text.erase(text.find_last_not_of(' ') + 1);
    text += "\n";
  }
  return report.queue.empty() ? text : text + report.queue + "\n";
}

std::string ToSvg(const Report& report) {
  const double plot_width = kWidth - kLeft - 10, plot_height = kHeight - kTop - kBottom;
  const double stride =
      plot_width / static_cast<double>(std::max<std::size_t>(report.groups.size(), 1));
  const auto y_of = [&](double share) { return kTop + plot_height * (1 - share); };
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
      "height=\"{1}\" font-family=\"sans-serif\" font-size=\"11\" role=\"img\" "
      "aria-label=\"The share of runs that passed\">\n<rect width=\"{0}\" height=\"{1}\" "
      "fill=\"white\"/>\n",
      kWidth, kHeight);
  for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
    svg += fmt::format(
        "<line x1=\"{}\" x2=\"{}\" y1=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"#ddd\"/>"
        "<text x=\"{}\" y=\"{:.1f}\" text-anchor=\"end\">{:.0f} %</text>\n",
        kLeft, kWidth - 10, y_of(share), y_of(share), kLeft - 6, y_of(share) + 4, 100 * share);
  }
  for (std::size_t i = 0; i < report.groups.size(); ++i) {
    const Group& group = report.groups[i];
    const Interval rate = PassRate(group.passed, group.runs);
    const double x = kLeft + (static_cast<double>(i) + 0.5) * stride;
    svg += fmt::format(
        "<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1:.1f}\" y2=\"{2:.1f}\" stroke=\"#1f5fa8\" "
        "stroke-width=\"2\"/><circle cx=\"{0:.1f}\" cy=\"{3:.1f}\" r=\"4\" fill=\"#1f5fa8\"/>\n",
        x, y_of(rate.low), y_of(rate.high), y_of(rate.middle));
    svg += fmt::format("<text x=\"{:.1f}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n", x,
                       kHeight - kBottom + 16,
                       Escaped(fmt::format("{}", fmt::join(group.values, ", ")).substr(0, 24)));
  }
  return svg + fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n</svg>\n",
                           kLeft + plot_width / 2, kHeight - 12,
                           Escaped(fmt::format("{}", fmt::join(report.parameters, ", "))));
}

std::string ToHtml(const Report& report) {
  std::size_t runs = 0, passed = 0;
  for (const Group& group : report.groups) {
    runs += group.runs;
    passed += group.passed;
  }
  const auto cells = [](const std::vector<std::string>& row, const char* cell) {
    std::string html = "<tr>";
    for (const std::string& text : row) html += fmt::format("<{0}>{1}</{0}>", cell, Escaped(text));
    return html + "</tr>\n";
  };
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{0}</title>\n"
      "<style>body{{font:15px sans-serif;margin:2em;max-width:60em}}table{{border-collapse:"
      "collapse}}td,th{{border:1px solid #ccc;padding:.3em .6em;text-align:left}}</style>"
      "</head><body>\n<h1>{0}</h1>\n<p>{1} of {2} runs are done, {3} passed: {4}.</p>\n",
      Escaped(report.title), runs, report.planned, passed, Words(PassRate(passed, runs)));
  html += ToSvg(report) + "<table>\n" + cells(Header(report), "th");
  for (const Group& group : report.groups) html += cells(Row(report, group), "td");
  html += "</table>\n";
  if (!report.queue.empty()) html += "<p>" + Escaped(report.queue) + "</p>\n";
  return html +
         "<p>The intervals are 95 % confidence intervals: Wilson's for fractions of passed runs, "
         "Student's for means.</p>\n</body></html>\n";
}

std::string ToCsv(const std::vector<RunResult>& results,
                  const std::vector<std::string>& parameters) {
  std::set<std::string> metrics;
  for (const RunResult& result : results) {
    for (const auto& [name, value] : result.metrics.items()) metrics.insert(name);
  }
  std::string csv = "run";
  for (const std::string& parameter : parameters) csv += "," + InCsv(parameter);
  csv += ",status,state_hash,sim_time_s,wall_s,recording,message";
  for (const std::string& metric : metrics) csv += "," + InCsv(metric);
  csv += "\r\n";
  for (const RunResult& result : results) {
    csv += std::to_string(result.run);
    for (const std::string& parameter : parameters) csv += "," + InCsv(ValueIn(result, parameter));
    csv += fmt::format(",{},{},{},{},{},{}", result.status, result.state_hash, result.sim_time,
                       result.wall_time, InCsv(result.recording), InCsv(result.message));
    for (const std::string& metric : metrics) {
      const auto found = result.metrics.find(metric);
      csv += "," + (found == result.metrics.end() ? "" : found->dump());
    }
    csv += "\r\n";
  }
  return csv;
}

}  // namespace gsv::campaign
