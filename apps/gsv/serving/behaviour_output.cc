#include "apps/gsv/serving/behaviour_output.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <utility>

#include "apps/gsv/machine/child_process.h"
#include "gsv/base/host_name.h"

namespace gsv::app {
namespace {

constexpr std::size_t kMaxLineLength = 2000;
constexpr std::size_t kMaxWaiting = 200;
constexpr std::size_t kErrorLinesKept = 100;
constexpr int kMaxLinesPerSecond = 200;

// Returns "wander.py line 12" for `  File "/home/me/wander.py", line 12, in run`, and an empty text
// for other lines.
std::string PlaceIn(const std::string& line) {
  constexpr std::string_view kFile = "  File \"", kLine = "\", line ";
  if (!line.starts_with(kFile)) return {};
  const std::size_t end = line.find(kLine, kFile.size());
  if (end == std::string::npos) return {};
  const std::filesystem::path file = line.substr(kFile.size(), end - kFile.size());
  const std::size_t number = end + kLine.size();
  return file.filename().string() + " line " + line.substr(number, line.find(',', number) - number);
}

}  // namespace

std::string LastError(const std::vector<std::string>& lines) {
  std::string place, error;
  bool in_traceback = false;
  for (const std::string& line : lines) {
    if (line.starts_with("Traceback (most recent call last)")) {
      in_traceback = true;
      place.clear();
    } else if (in_traceback && line.starts_with(' ')) {
      if (std::string found = PlaceIn(line); !found.empty()) place = std::move(found);
    } else if (!line.empty()) {
      error = line + (in_traceback && !place.empty() ? " in " + place : "");
      in_traceback = false;
    }
  }
  return error;
}

BehaviourOutput::BehaviourOutput(ListSimulations list) : list_(std::move(list)) {
  reader_ = std::make_unique<OutputReader>(
      OutputReader::Callbacks{[this](pid_t pid, OutputReader::Stream stream,
                                     const std::string& line) { OnLine(pid, stream, line); },
                              [this](pid_t pid, const std::string& ending) { OnEnd(pid, ending); },
                              [this] { FlushAll(); }});
}

BehaviourOutput::~BehaviourOutput() = default;

void BehaviourOutput::Begin(const ChildProcess& program, const std::string& behaviour) {
  {
    const base::MutexLock lock(mutex_);
    programs_[program.pid()].behaviour = behaviour;
  }
  reader_->AddErrors(program);
}

void BehaviourOutput::BeginOutput(ChildProcess& program) { reader_->AddOutput(program); }

std::string BehaviourOutput::LastErrorOf(const ChildProcess& program) {
  base::MutexLock lock(mutex_);
  const pid_t pid = program.pid();
  ended_.wait_for(lock, std::chrono::seconds(1),
                  [&]() GSV_REQUIRES(mutex_) { return programs_[pid].has_ended; });
  return LastError(programs_[pid].errors);
}

void BehaviourOutput::ExpectEnds() {
  const base::MutexLock lock(mutex_);
  expects_ends_ = true;
}

void BehaviourOutput::OnLine(pid_t pid, OutputReader::Stream stream, const std::string& line) {
  const bool is_error = stream == OutputReader::Stream::kErrors;
  const base::MutexLock lock(mutex_);
  Program& program = programs_[pid];
  // Lines on stderr may be of a log with its own format, so they are not changed.
  std::fprintf(stderr, "%s%s%s%s\n", is_error ? "" : "[", is_error ? "" : program.behaviour.c_str(),
               is_error ? "" : "] ", line.c_str());
  if (is_error) {
    program.errors.push_back(line.substr(0, kMaxLineLength));
    if (program.errors.size() > kErrorLinesKept) program.errors.erase(program.errors.begin());
  }
  const auto now = std::chrono::steady_clock::now();
  if (now - program.second >= std::chrono::seconds(1)) {
    if (program.left_out > 0) {
      Emit(pid, program, simulation::kStderrEvent,
           std::to_string(program.left_out) + " lines are left out here: gsv keeps " +
               std::to_string(kMaxLinesPerSecond) + " lines per second");
    }
    program.second = now;
    program.lines = program.left_out = 0;
  }
  if (++program.lines > kMaxLinesPerSecond) {
    ++program.left_out;
    return;
  }
  Emit(pid, program, is_error ? simulation::kStderrEvent : simulation::kStdoutEvent,
       line.substr(0, kMaxLineLength));
}

void BehaviourOutput::OnEnd(pid_t pid, const std::string& ending) {
  const base::MutexLock lock(mutex_);
  Program& program = programs_[pid];
  program.has_ended = true;
  ended_.notify_all();
  if (expects_ends_) return;
  const std::string error = ending == "exit code 0" ? "" : LastError(program.errors);
  Emit(pid, program, simulation::kProgramEndedEvent,
       "behaviour " + program.behaviour + " ended with " + ending +
           (error.empty() ? "" : ": " + error));
}

void BehaviourOutput::Emit(pid_t pid, Program& program, std::string_view kind, std::string text) {
  program.waiting.push_back({kind, std::move(text)});
  if (program.waiting.size() > kMaxWaiting) {
    Flush(pid, program);
    if (program.waiting.size() > kMaxWaiting) program.waiting.erase(program.waiting.begin());
  }
}

void BehaviourOutput::Flush(pid_t pid, Program& program) {
  if (program.waiting.empty()) return;
  const std::string place = base::HostName() + ":" + std::to_string(pid);
  bool is_served = false;
  for (const auto& simulation : list_()) {
    std::vector<std::string> robots;
    for (const simulation::RobotStatus& robot : simulation->status().robots) {
      if (robot.behaviour_place == place) robots.push_back(robot.name);
    }
    if (robots.empty()) continue;
    is_served = true;
    const std::string& about = robots.size() == 1 ? robots.front() : program.behaviour;
    for (const Line& line : program.waiting) simulation->Emit(line.kind, about, line.text);
  }
  if (is_served) program.waiting.clear();
}

void BehaviourOutput::FlushAll() {
  const base::MutexLock lock(mutex_);
  for (auto& [pid, program] : programs_) Flush(pid, program);
}

}  // namespace gsv::app
