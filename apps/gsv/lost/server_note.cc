#include "apps/gsv/lost/server_note.h"

#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iterator>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "apps/gsv/machine/running_instances.h"
#include "gsv/base/atomic_file.h"
#include "gsv/base/host_name.h"

namespace gsv::app {
namespace {

namespace fs = std::filesystem;
using NoteJson = nlohmann::json;

// maximum size of a note: 10,000 simulations with long names
constexpr std::streamsize kMaxBytes = 8 << 20;
constexpr std::size_t kMaxNotes = 1000;
constexpr std::size_t kMaxSimulations = 10'000;
constexpr double kMaxTime = 1e12;  // in s

std::string LineOf(const fs::path& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  return line;
}

NoteJson ToJson(const LostSimulation& simulation) {
  NoteJson told = {{"name", simulation.name},    {"world", simulation.world},
                   {"phase", simulation.phase},  {"time_s", simulation.time_s},
                   {"noted", simulation.noted},  {"recording", simulation.recording},
                   {"server", simulation.server}};
  if (simulation.whole_until_s) told["whole_until_s"] = *simulation.whole_until_s;
  return told;
}

NoteJson ToJson(const std::vector<LostSimulation>& simulations) {
  NoteJson list = NoteJson::array();
  for (const LostSimulation& each : simulations) list.push_back(ToJson(each));
  return list;
}

// Reads fields of a JSON object. If a field is missing or has the wrong type, ok() returns false.
class Fields {
 public:
  explicit Fields(const NoteJson& object) : object_(object), ok_(object.is_object()) {}

  bool ok() const { return ok_; }
  std::string Text(const char* key) { return Take<std::string>(key, &NoteJson::is_string); }
  std::uint64_t Count(const char* key) {
    return Take<std::uint64_t>(key, &NoteJson::is_number_unsigned);
  }
  std::int64_t Whole(const char* key) {
    return Take<std::int64_t>(key, &NoteJson::is_number_integer);
  }
  double Time(const char* key) {
    const double time = Take<double>(key, &NoteJson::is_number);
    if (!(std::abs(time) <= kMaxTime)) ok_ = false;
    return time;
  }
  bool Has(const char* key) const { return ok_ && object_.contains(key); }
  std::vector<LostSimulation> List(const char* key);

 private:
  template <typename T>
  T Take(const char* key, bool (NoteJson::*is_kind)() const noexcept) {
    ok_ = ok_ && object_.contains(key) && (object_[key].*is_kind)();
    return ok_ ? object_[key].get<T>() : T{};
  }

  const NoteJson& object_;
  bool ok_;
};

std::vector<LostSimulation> Fields::List(const char* key) {
  std::vector<LostSimulation> list;
  ok_ = ok_ && object_.contains(key) && object_[key].is_array() &&
        object_[key].size() <= kMaxSimulations;
  if (!ok_) return list;
  for (const NoteJson& each : object_[key]) {
    Fields fields(each);
    LostSimulation simulation{fields.Text("name"), fields.Text("world"), fields.Text("phase")};
    simulation.time_s = fields.Time("time_s");
    simulation.noted = fields.Whole("noted");
    simulation.recording = fields.Text("recording");
    simulation.server = fields.Text("server");
    if (fields.Has("whole_until_s")) simulation.whole_until_s = fields.Time("whole_until_s");
    ok_ = ok_ && fields.ok();
    list.push_back(std::move(simulation));
  }
  return list;
}

std::optional<ServerNote> ReadNote(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::string text(std::istreambuf_iterator<char>(stream.rdbuf()), {});
  const NoteJson told = NoteJson::parse(text, nullptr, false);
  Fields fields(told);
  ServerNote note;
  note.pid = static_cast<pid_t>(fields.Count("pid"));
  note.started = fields.Count("started");
  note.boot = fields.Text("boot");
  note.host = fields.Text("host");
  note.server = fields.Text("server");
  note.broker = fields.Text("broker");
  note.recordings = fields.Text("recordings");
  note.simulations = fields.List("simulations");
  note.lost = fields.List("lost");
  if (!fields.ok()) return std::nullopt;
  return note;
}

}  // namespace

std::string Sentence(const LostSimulation& lost) {
  std::string recording = "it was not recorded";
  if (!lost.recording.empty()) {
    recording = "recording " + lost.recording;
    if (lost.whole_until_s)
      recording += fmt::format(", complete until {:.1f} s", *lost.whole_until_s);
  }
  return fmt::format("{} on {} was lost at about {:.1f} s ({}), when its server was killed; {}",
                     lost.name, lost.server, lost.time_s, lost.phase, recording);
}

nlohmann::ordered_json Describe(const LostSimulation& lost) {
  nlohmann::ordered_json told = {
      {"name", lost.name},        {"world", lost.world},         {"phase", "lost"},
      {"last_phase", lost.phase}, {"time_s", lost.time_s},       {"noted", lost.noted},
      {"server", lost.server},    {"recording", lost.recording}, {"sentence", Sentence(lost)}};
  if (lost.whole_until_s) told["whole_until_s"] = *lost.whole_until_s;
  return told;
}

ServerNote NewNote() {
  ServerNote note;
  note.pid = getpid();
  note.started = ProcessStart(note.pid).value_or(0);
  note.boot = LineOf("/proc/sys/kernel/random/boot_id");
  note.host = base::HostName();
  return note;
}

bool IsProcessRunning(const ServerNote& note) {
  if (note.host != base::HostName()) return true;
  return note.boot == LineOf("/proc/sys/kernel/random/boot_id") &&
         ProcessStart(note.pid) == note.started;
}

base::Result<fs::path> NotesFolder() {
  const char* state = std::getenv("XDG_STATE_HOME");
  const char* home = std::getenv("HOME");
  fs::path folder;
  if (state != nullptr && *state == '/') {
    folder = state;
  } else if (home != nullptr && *home == '/') {
    folder = fs::path(home) / ".local/state";
  } else {
    return base::Fail(base::ErrorCode::kUnavailable, "neither XDG_STATE_HOME nor HOME is a folder");
  }
  folder /= "gsv/servers";
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return base::Fail(base::ErrorCode::kUnavailable, error.message(), folder);
  fs::permissions(folder, fs::perms::owner_all, error);
  return folder;
}

fs::path NoteFile(const fs::path& folder, const ServerNote& note) {
  return folder / fmt::format("{}-{}.json", note.pid, note.started);
}

base::Status WriteNote(const fs::path& file, const ServerNote& note) {
  const NoteJson told = {{"pid", note.pid},
                         {"started", note.started},
                         {"boot", note.boot},
                         {"host", note.host},
                         {"server", note.server},
                         {"broker", note.broker},
                         {"recordings", note.recordings},
                         {"simulations", ToJson(note.simulations)},
                         {"lost", ToJson(note.lost)}};
  return base::WriteAtomically(file,
                               told.dump(-1, ' ', false, NoteJson::error_handler_t::replace) + "\n",
                               base::Durability::kProcess);
}

NotesFound ReadNotes(const fs::path& folder) {
  NotesFound found;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const fs::path& file = entry->path();
    if (file.extension() != ".json" || found.notes.size() >= kMaxNotes) continue;
    std::error_code gone;
    const bool is_file = fs::is_regular_file(fs::symlink_status(file, gone));
    const bool is_small = is_file && fs::file_size(file, gone) <= kMaxBytes;
    std::optional<ServerNote> note = is_small ? ReadNote(file) : std::nullopt;
    if (note) {
      found.notes.push_back({file, *std::move(note)});
    } else if (fs::exists(fs::symlink_status(file, gone))) {
      found.problems.push_back({base::Problem::Severity::kWarning,
                                "the file is not a note of a server; it is ignored",
                                file.string()});
      found.broken.push_back(file);
    }
  }
  return found;
}

std::vector<LostSimulation> LostSimulationsNoted(const std::string& broker) {
  std::vector<LostSimulation> lost;
  const auto folder = NotesFolder();
  if (!folder) return lost;
  for (NoteFound& found : ReadNotes(*folder).notes) {
    if (!broker.empty() && found.note.broker != broker) continue;
    std::move(found.note.lost.begin(), found.note.lost.end(), std::back_inserter(lost));
    if (IsProcessRunning(found.note)) continue;
    std::move(found.note.simulations.begin(), found.note.simulations.end(),
              std::back_inserter(lost));
  }
  return lost;
}

}  // namespace gsv::app
