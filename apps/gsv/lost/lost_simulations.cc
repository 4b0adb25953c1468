#include "apps/gsv/lost/lost_simulations.h"

#include <chrono>
#include <ctime>
#include <utility>

#include "gsv/base/atomic_file.h"
#include "gsv/base/log.h"
#include "gsv/base/sorting.h"
#include "gsv/recording/mcap/mcap_reader.h"

namespace gsv::app {
namespace {

namespace fs = std::filesystem;
using simulation::Phase;

constexpr std::chrono::milliseconds kPeriod{500};

// Returns the simulated time of the last readable message, or nullopt if the file is no recording.
std::optional<double> WholeUntil(const std::string& path) {
  const auto reader = recording::McapReader::Open(path);
  if (!reader) return std::nullopt;
  return base::ToSeconds((*reader)->summary().end);
}

}  // namespace

LostSimulations::LostSimulations(const Server& server, services::SimulationHost& host,
                                 gateway::RecordingSwitch& recordings)
    : host_(host), recordings_(recordings), note_(NewNote()) {
  note_.server = server.name;
  note_.broker = server.broker;
  note_.recordings = server.recordings;
  const auto folder = NotesFolder();
  if (!folder) {
    spdlog::warn("cannot write crash reports for this server: {}", folder.error().Sentence());
    return;
  }
  file_ = NoteFile(*folder, note_);
  TakeOver(*folder);
  examiner_ = std::jthread([this](const std::stop_token& stop) { Examine(stop); });
  watcher_ = std::jthread([this](const std::stop_token& stop) { WatchOver(stop); });
}

LostSimulations::~LostSimulations() {
  for (std::jthread* thread : {&examiner_, &watcher_}) {
    thread->request_stop();
    if (thread->joinable()) thread->join();
  }
  std::error_code ignored;
  if (!file_.empty()) fs::remove(file_, ignored);
}

void LostSimulations::TakeOver(const fs::path& folder) {
  const NotesFound found = ReadNotes(folder);
  for (const base::Problem& problem : found.problems) spdlog::warn("{}", problem.Sentence());
  std::vector<fs::path> done = found.broken;
  std::vector<LostSimulation> lost;
  for (const NoteFound& each : found.notes) {
    if (each.note.recordings != note_.recordings || IsProcessRunning(each.note)) continue;
    for (const auto* list : {&each.note.lost, &each.note.simulations}) {
      lost.insert(lost.end(), list->begin(), list->end());
    }
    done.push_back(each.file);
    done.push_back(base::DraftPath(each.file, each.note.pid));
  }
  Keep(std::move(lost));
  Write();
  // If this server cannot write its own note, it leaves the old notes to a later server.
  if (!could_write_) return;
  std::error_code ignored;
  for (const fs::path& file : done) fs::remove(file, ignored);
}

void LostSimulations::Keep(std::vector<LostSimulation> lost) {
  base::Sort(lost, [](const auto& a, const auto& b) { return a.noted < b.noted; });
  if (lost.size() > kMaxKept) lost.erase(lost.begin(), lost.end() - kMaxKept);
  const base::MutexLock lock(mutex_);
  for (LostSimulation& each : lost) lost_[next_++] = std::move(each);
}

void LostSimulations::Examine(const std::stop_token& stop) {
  for (auto& [number, simulation] : List()) {
    // Reading a recording may take long. So if this server is ending, it does not read the
    // recording, and the crash report has no recorded time.
    if (!simulation.recording.empty() && !stop.stop_requested()) {
      simulation.whole_until_s = WholeUntil(simulation.recording);
    }
    spdlog::warn("{}", Sentence(simulation));
    const base::MutexLock lock(mutex_);
    const auto kept = lost_.find(number);
    if (kept != lost_.end()) kept->second.whole_until_s = simulation.whole_until_s;
  }
}

void LostSimulations::WatchOver(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    Write();
    base::MutexLock lock(mutex_);
    changed_.wait_for(lock, stop, kPeriod, [] { return false; });
  }
}

void LostSimulations::Write() {
  ServerNote note = note_;
  note.simulations = Running();
  note.lost.clear();
  for (auto& [number, each] : List()) note.lost.push_back(std::move(each));
  const auto written = WriteNote(file_, note);
  if (!written && std::exchange(could_write_, false)) {
    spdlog::warn("cannot write crash reports for this server: {}", written.error().Sentence());
  }
  if (written) could_write_ = true;
}

std::vector<LostSimulation> LostSimulations::Running() const {
  std::vector<LostSimulation> running;
  const std::int64_t now = std::time(nullptr);
  const std::string server = note_.server + " (process " + std::to_string(note_.pid) + ")";
  for (const auto& simulation : host_.List()) {
    const simulation::Specification& specification = simulation->specification();
    LostSimulation noted;
    noted.name = specification.name;
    noted.world = specification.world->source;
    noted.phase = ToString(simulation->WaitForPhase({}, std::chrono::milliseconds(0)));
    noted.time_s = base::ToSeconds(simulation->snapshot()->state.time);
    noted.noted = now;
    noted.server = server;
    const auto recording = recordings_.RecordingOf(specification.name);
    if (recording.is_recording) {
      std::error_code ignored;
      noted.recording = fs::absolute(recording.path, ignored);
    }
    running.push_back(std::move(noted));
  }
  return running;
}

std::map<int, LostSimulation> LostSimulations::List() const {
  const base::MutexLock lock(mutex_);
  return lost_;
}

std::string LostSimulations::NameInFolder(const LostSimulation& lost) const {
  const fs::path recording = lost.recording;
  return recording.parent_path() == note_.recordings ? recording.filename().string() : "";
}

bool LostSimulations::Dismiss(int number) {
  const base::MutexLock lock(mutex_);
  return lost_.erase(number) > 0;
}

}  // namespace gsv::app
