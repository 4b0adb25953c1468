#include "apps/gsv/trials/test_cases.h"

#include <algorithm>
#include <cctype>
#include <charconv>

#include "gsv/base/sorting.h"
#include "gsv/scenario/scenario_file.h"

namespace gsv::app {
namespace {

namespace fs = std::filesystem;

base::Result<std::vector<std::string>> FilesOf(const std::string& name) {
  std::error_code error;
  if (!fs::is_directory(name, error)) {
    if (fs::exists(name, error)) return std::vector<std::string>{name};
    return base::Fail(base::ErrorCode::kNotFound,
                      "there is no scenario file or folder of this name", name);
  }
  std::vector<std::string> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(name, error)) {
    if (scenario::IsScenarioFileName(entry.path().filename())) files.push_back(entry.path());
  }
  base::Sort(files);
  if (!files.empty()) return files;
  return base::Fail(base::ErrorCode::kNotFound, "the folder has no scenario files (*.yaml, *.yml)",
                    name);
}

void Check(const std::string& file, base::Problems& problems) {
  const auto scenario = scenario::ReadScenario(file, problems);
  if (!scenario) {
    problems.push_back(
        {base::Problem::Severity::kError, scenario.error().message, scenario.error().where});
  } else if (scenario->duration.value_or(0) <= 0) {
    problems.push_back({base::Problem::Severity::kError,
                        "a test needs an end: set duration, in simulated seconds", file});
  }
}

// Returns a name for the folder of a case which no case in `cases` has.
std::string FolderFor(std::string name, const std::vector<TestCase>& cases) {
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  std::string folder = name;
  const auto has_folder = [&](const TestCase& test) { return test.folder == folder; };
  for (int i = 2; std::any_of(cases.begin(), cases.end(), has_folder); ++i) {
    folder = name + "_" + std::to_string(i);
  }
  return folder;
}

}  // namespace

base::Result<std::vector<TestCase>> FindTestCases(const std::vector<std::string>& names,
                                                  base::Problems& problems) {
  std::vector<TestCase> cases;
  for (const std::string& name : names) {
    const auto files = FilesOf(name);
    if (!files) return base::Fail(files.error());
    for (const std::string& file : *files) {
      const bool is_known = std::any_of(cases.begin(), cases.end(),
                                        [&](const TestCase& test) { return test.file == file; });
      if (is_known) continue;
      Check(file, problems);
      const std::string title = fs::path(file).lexically_normal().replace_extension().string();
      cases.push_back({file, title, FolderFor(title, cases)});
    }
  }
  return cases;
}

base::Result<Shard> ParseShard(const std::string& text) {
  Shard shard;
  const std::size_t slash = std::min(text.find('/'), text.size());
  const char* const end = text.data() + text.size();
  const auto index = std::from_chars(text.data(), text.data() + slash, shard.index);
  const auto count = std::from_chars(std::min(text.data() + slash + 1, end), end, shard.count);
  const bool is_whole = index.ec == std::errc() && index.ptr == text.data() + slash &&
                        count.ec == std::errc() && count.ptr == end;
  if (is_whole && shard.index >= 1 && shard.index <= shard.count) return shard;
  return base::Fail(base::ErrorCode::kInvalidArgument,
                    "expected I/N, for the I-th of N shares, counted from 1", "--shard " + text);
}

std::vector<TestCase> ShareOf(std::vector<TestCase> cases, const Shard& shard) {
  std::vector<TestCase> share;
  for (std::size_t i = shard.index - 1; i < cases.size(); i += shard.count) {
    share.push_back(std::move(cases[i]));
  }
  return share;
}

}  // namespace gsv::app
