#include "apps/gsv/machine/running_instances.h"

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include <nlohmann/json.hpp>

#include "gsv/base/atomic_file.h"
#include "gsv/base/sorting.h"
#include "gsv/base/user_folder.h"

namespace gsv::app {
namespace {

namespace fs = std::filesystem;

constexpr std::streamsize kMaxFile = 16 * 1024;

std::optional<Instance> ReadInstance(const fs::path& file) {
  std::ifstream stream(file);
  std::string text(kMaxFile, '\0');
  stream.read(text.data(), kMaxFile);
  text.resize(static_cast<std::size_t>(stream.gcount()));
  const auto json = nlohmann::json::parse(text, nullptr, false);
  if (!json.is_object() || !json.contains("pid") || !json["pid"].is_number_integer() ||
      !json.contains("started") || !json["started"].is_number_unsigned() ||
      !json.contains("broker") || !json["broker"].is_string()) {
    return std::nullopt;
  }
  return Instance{json["pid"].get<pid_t>(), json["started"].get<std::uint64_t>(),
                  json["broker"].get<std::string>()};
}

}  // namespace

std::optional<std::uint64_t> ProcessStart(pid_t pid) {
  // The start time is field 22 of /proc/PID/stat, see proc(5).
  std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
  std::string text;
  if (!std::getline(file, text)) return std::nullopt;
  // The second field is the program's name in parentheses, which may contain any characters.
  const std::size_t name_end = text.rfind(')');
  if (name_end == std::string::npos) return std::nullopt;
  std::istringstream fields(text.substr(name_end + 1));
  std::string skipped;
  for (int field = 3; field < 22; ++field) fields >> skipped;
  std::uint64_t start = 0;
  if (!(fields >> start)) return std::nullopt;
  return start;
}

base::Result<std::unique_ptr<InstanceRecord>> InstanceRecord::Write(const std::string& broker) {
  const auto folder = base::UserFolder();
  if (!folder) return base::Fail(folder.error());
  const fs::path file = *folder / (std::to_string(getpid()) + ".json");
  const nlohmann::json json = {
      {"pid", getpid()}, {"started", ProcessStart(getpid()).value_or(0)}, {"broker", broker}};
  if (auto ok = base::WriteAtomically(file, json.dump() + "\n", base::Durability::kProcess); !ok) {
    return base::Fail(ok.error());
  }
  return std::unique_ptr<InstanceRecord>(new InstanceRecord(file));
}

InstanceRecord::~InstanceRecord() {
  std::error_code ignored;
  fs::remove(file_, ignored);
}

std::vector<Instance> RunningInstances() {
  std::vector<Instance> instances;
  const auto folder = base::UserFolder();
  if (!folder) return instances;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(*folder, error)) {
    if (entry.path().extension() != ".json") continue;
    const auto instance = ReadInstance(entry.path());
    if (instance && ProcessStart(instance->pid) == instance->started) {
      instances.push_back(*instance);
    } else {
      fs::remove(entry.path(), error);
    }
  }
  base::Sort(instances, [](const Instance& a, const Instance& b) {
    return a.started != b.started ? a.started > b.started : a.pid > b.pid;
  });
  return instances;
}

}  // namespace gsv::app
