#include "apps/gsv/trials/test_report.h"

#include <algorithm>

#include <fmt/format.h>

namespace gsv::app {
namespace {

using Status = TestResult::Status;

const char* InWords(Status status) {
  switch (status) {
    case Status::kPassed:
      return "passed";
    case Status::kFailed:
      return "failed";
    case Status::kError:
      return "error";
    case Status::kInterrupted:
      break;
  }
  return "interrupted";
}

std::string Indented(const std::string& text) {
  std::string indented = "      ";
  for (const char c : text) indented += c == '\n' ? std::string("\n      ") : std::string(1, c);
  return indented;
}

// Returns the first lines of a text, and a line with the number of omitted lines.
std::string FirstLines(const std::string& text) {
  constexpr int kMaxTextLines = 8;
  std::size_t end = 0;
  for (int i = 0; i < kMaxTextLines && end != std::string::npos; ++i)
    end = text.find('\n', end + 1);
  if (end == std::string::npos) return text;
  const auto others = std::count(text.begin() + static_cast<std::ptrdiff_t>(end), text.end(), '\n');
  return text.substr(0, end) + fmt::format("\nand {} more, see README.txt", others);
}

// Escapes a text for XML, and omits characters that XML 1.0 does not allow.
std::string Escaped(const std::string& text) {
  std::string escaped;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '&') {
      escaped += "&amp;";
    } else if (c == '<') {
      escaped += "&lt;";
    } else if (c == '>') {
      escaped += "&gt;";
    } else if (c == '"') {
      escaped += "&quot;";
    } else if (c == '\n') {
      escaped += "&#10;";
    } else if (byte >= 0x20 || c == '\t') {
      escaped += c;
    }
  }
  return escaped;
}

std::string JUnitCase(const TestResult& result) {
  const std::size_t slash = result.test.name.rfind('/');
  const bool has_folder = slash != std::string::npos;
  std::string xml = fmt::format(
      "  <testcase classname=\"{}\" name=\"{}\" time=\"{:.3f}\"",
      Escaped(has_folder ? result.test.name.substr(0, slash) : "scenarios"),
      Escaped(result.test.name.substr(has_folder ? slash + 1 : 0)), result.wall_seconds);
  if (result.status == Status::kPassed) return xml + "/>\n";
  const char* const element = result.status == Status::kFailed        ? "failure"
                              : result.status == Status::kInterrupted ? "skipped"
                                                                      : "error";
  const std::string first = result.message.substr(0, result.message.find('\n'));
  std::string body = result.message;
  if (!result.health.empty()) body += "\n\nAt the end:\n" + result.health;
  body += "\n\nTo repeat the run: " + result.command;
  if (!result.folder.empty()) body += "\nFiles: " + result.folder;
  return xml + fmt::format(">\n    <{0} message=\"{1}\">{2}</{0}>\n  </testcase>\n", element,
                           Escaped(first), Escaped(body));
}

}  // namespace

std::size_t Count(const std::vector<TestResult>& results, Status status) {
  return static_cast<std::size_t>(std::count_if(
      results.begin(), results.end(), [&](const auto& each) { return each.status == status; }));
}

std::string ToText(const TestResult& result) {
  const char* const word = result.status == Status::kPassed   ? "PASS "
                           : result.status == Status::kFailed ? "FAIL "
                           : result.status == Status::kError  ? "ERROR"
                                                              : "STOP ";
  std::string text = fmt::format("{} {}  {:.1f} s", word, result.test.name, result.wall_seconds);
  if (!result.report.empty() && result.status != Status::kError) {
    text += fmt::format(" ({:g} s simulated", result.report.value("sim_time_s", 0.0));
    if (result.hashes.size() > 1) text += fmt::format(", {} times", result.hashes.size());
    text += ")";
  }
  text += "\n";
  if (result.status == Status::kPassed || result.message.empty()) return text;
  text += Indented(result.message) + "\n";
  if (!result.health.empty())
    text += "      at the end:\n" + Indented(FirstLines(result.health)) + "\n";
  if (!result.folder.empty()) text += "      see " + result.folder + "/README.txt\n";
  return text + "      again: " + result.command + "\n";
}

std::string ToJUnit(const std::vector<TestResult>& results, double wall_seconds) {
  const auto counts =
      fmt::format("tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"{}\" time=\"{:.3f}\"",
                  results.size(), Count(results, Status::kFailed), Count(results, Status::kError),
                  Count(results, Status::kInterrupted), wall_seconds);
  std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites " + counts +
                    ">\n <testsuite name=\"gsv test\" " + counts + ">\n";
  for (const TestResult& result : results) xml += JUnitCase(result);
  return xml + " </testsuite>\n</testsuites>\n";
}

std::string ToJson(const std::vector<TestResult>& results, double wall_seconds) {
  auto list = nlohmann::ordered_json::array();
  for (const TestResult& result : results) {
    list.push_back({{"scenario", result.test.name},
                    {"file", result.test.file},
                    {"status", InWords(result.status)},
                    {"message", result.message},
                    {"folder", result.folder},
                    {"command", result.command},
                    {"wall_s", result.wall_seconds},
                    {"state_hashes", result.hashes},
                    {"report", result.report}});
  }
  const nlohmann::ordered_json json{{"passed", Count(results, Status::kPassed)},
                                    {"failed", Count(results, Status::kFailed)},
                                    {"errors", Count(results, Status::kError)},
                                    {"wall_s", wall_seconds},
                                    {"results", std::move(list)}};
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace gsv::app
