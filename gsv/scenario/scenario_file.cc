#include "gsv/scenario/scenario_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>

#include <yaml-cpp/eventhandler.h>

#include "gsv/formats/xacro/arguments.h"
#include "gsv/scenario/scenario_keys.h"

namespace gsv::scenario {
namespace {

// Reports the start of each document and ignores all other events.
class Starts final : public YAML::EventHandler {
 public:
  void OnDocumentStart(const YAML::Mark& mark) override { latest = mark; }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark&, YAML::anchor_t) override {}
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override {}
  void OnScalar(const YAML::Mark&, const std::string&, YAML::anchor_t,
                const std::string&) override {}
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {}
  void OnSequenceEnd() override {}
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {}
  void OnMapEnd() override {}

  YAML::Mark latest;
};

// Returns the place of a second document, even if the content of this document is invalid.
// YAML::LoadAll() of yaml-cpp 0.7 is not used, because it never returns for some invalid texts.
std::optional<YAML::Mark> SecondDocument(const std::string& text) {
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  Starts starts;
  if (!parser.HandleNextDocument(starts) || !parser.HandleNextDocument(starts)) return std::nullopt;
  return starts.latest;
}

// Returns the number of bytes of the UTF-8 character with this first byte; 0 if the byte is
// invalid.
std::size_t LengthOfCharacter(unsigned char first) {
  if (first < 0x80) return 1;
  if (first >= 0xc2 && first < 0xe0) return 2;
  if (first >= 0xe0 && first < 0xf0) return 3;
  return first >= 0xf0 && first < 0xf5 ? 4 : 0;
}

// Returns the first line that is not UTF-8, counted from 1.
std::optional<std::size_t> LineThatIsNotUtf8(const std::string& text) {
  std::size_t line = 1;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = LengthOfCharacter(static_cast<unsigned char>(text[i]));
    if (length == 0 || length > text.size() - i) return line;
    for (std::size_t k = 1; k < length; ++k) {
      if ((static_cast<unsigned char>(text[i + k]) & 0xc0) != 0x80) return line;
    }
    if (text[i] == '\n') ++line;
    i += length;
  }
  return std::nullopt;
}

// Returns the first line, counted from 1, that contains a control character other than tab, line
// feed and carriage return. YAML forbids these characters, and YAML readers treat them differently.
std::optional<std::size_t> LineWithControlCharacter(const std::string& text) {
  const auto is_control = [](unsigned char c) {
    return (c < 0x20 && c != '\t' && c != '\n' && c != '\r') || c == 0x7f;
  };
  const auto found = std::find_if(text.begin(), text.end(), is_control);
  if (found == text.end()) return std::nullopt;
  return 1 + static_cast<std::size_t>(std::count(text.begin(), found, '\n'));
}

// Returns the absolute path if `name` exists relative to the file's folder. Otherwise returns
// `name`.
std::string SeenFrom(const std::filesystem::path& folder, const std::string& name) {
  std::error_code ignored;
  const std::string file = formats::xacro::FilePart(name);
  const std::filesystem::path path = folder / file;
  if (name.empty() || !std::filesystem::exists(path, ignored)) return name;
  return std::filesystem::absolute(path, ignored).lexically_normal().string() +
         name.substr(file.size());
}

}  // namespace

base::Result<Scenario> ParseScenario(const std::string& text, const std::string& file,
                                     base::Problems& problems) {
  const auto refuse = [&](std::string message, std::string where) {
    return base::Fail(base::ErrorCode::kBadModel, std::move(message), std::move(where));
  };
  if (text.size() > kMaxScenarioBytes) {
    return refuse("a scenario has at most " + std::to_string(kMaxScenarioBytes) + " bytes", file);
  }
  // A name with invalid bytes would be written and read back as a different name.
  if (const auto line = LineThatIsNotUtf8(text)) {
    return refuse("the text is not UTF-8", file + ":" + std::to_string(*line));
  }
  if (const auto line = LineWithControlCharacter(text)) {
    return refuse("the text contains a control character", file + ":" + std::to_string(*line));
  }
  const YamlPlace place(YamlPlace::Naming::kLines, file, problems);
  try {
    const YAML::Node document = YAML::Load(text);
    if (const auto second = SecondDocument(text)) {
      place.AddProblem(*second, "", "a file may contain one scenario; this is a second one");
    } else if (document.IsNull()) {
      return refuse("the file is empty; a scenario is a mapping with keys such as world and robots",
                    file);
    }
    Scenario scenario = ReadScenarioKeys(document, place);
    // yaml-cpp reads each of these escapes as one byte, 0x85 or 0xa0, which is not UTF-8.
    const bool has_them = text.find("\\N") != text.npos || text.find("\\_") != text.npos;
    if (has_them && LineThatIsNotUtf8(ToYaml(scenario))) {
      return refuse("\\N and \\_ are misread in quoted texts; write \\u0085 and \\u00a0", file);
    }
    return scenario;
  } catch (const YAML::Exception& error) {
    return refuse("this is not valid YAML: " + error.msg, place.Of(error.mark, ""));
  }
}

base::Result<Scenario> ReadScenario(const std::filesystem::path& file, base::Problems& problems) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    return base::Fail(base::ErrorCode::kNotFound,
                      std::string("cannot open the scenario file: ") + std::strerror(errno), file);
  }
  std::string text;
  std::array<char, 16384> part;
  while (text.size() <= kMaxScenarioBytes && stream.good()) {
    stream.read(part.data(), part.size());
    text.append(part.data(), static_cast<std::size_t>(stream.gcount()));
  }
  auto scenario = ParseScenario(text, file, problems);
  if (!scenario) return scenario;
  const std::filesystem::path folder = file.parent_path();
  scenario->world = SeenFrom(folder, scenario->world);
  for (auto* entries : {&scenario->robots, &scenario->avatars}) {
    for (RobotEntry& entry : *entries) entry.model = SeenFrom(folder, entry.model);
  }
  for (std::string& path : scenario->model_path) path = SeenFrom(folder, path);
  return scenario;
}

bool IsScenarioFileName(const std::string& name) {
  return name.ends_with(".yaml") || name.ends_with(".yml");
}

}  // namespace gsv::scenario
