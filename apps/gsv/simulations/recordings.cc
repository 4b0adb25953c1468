#include "apps/gsv/simulations/recordings.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "gsv/base/host_name.h"
#include "gsv/base/log.h"
#include "gsv/base/spelling.h"
#include "gsv/formats/gltf/gltf_writer.h"
#include "gsv/recording/mcap/bag_folder.h"
#include "gsv/recording/simulation_recorder.h"
#include "gsv/recording/topics/topics.h"
#include "gsv/rendering/images/png.h"

namespace gsv::app {
namespace {

std::vector<std::string> ArgumentsOfThisProcess() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::vector<std::string> arguments;
  for (std::string argument; std::getline(file, argument, '\0');) {
    arguments.push_back(std::move(argument));
  }
  // A forked run has its arguments in a longer block of memory, which ends with empty arguments;
  // see running/run_server.cc.
  while (!arguments.empty() && arguments.back().empty()) arguments.pop_back();
  return arguments;
}

}  // namespace

std::vector<std::string> WithoutSecrets(std::vector<std::string> arguments) {
  const auto is_secret = [](const std::string& argument) {
    return argument == "--control-token" || argument == "--watch-token" || argument == "--token";
  };
  std::vector<std::string> rest;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    if (is_secret(arguments[i])) {
      ++i;  // skips the value of the option
    } else if (!is_secret(arguments[i].substr(0, arguments[i].find('=')))) {
      rest.push_back(std::move(arguments[i]));
    }
  }
  return rest;
}

namespace {

recording::RecorderOptions Options(const RecordingChoice& choice, bool is_of_command) {
  recording::RecorderOptions options;
  options.write_glb = &formats::WriteGlb;
  options.topics = choice.topics;
  options.poses_rate = choice.poses_rate;
  options.sensors = {choice.readings_rate, choice.images_rate, choice.beams_rate};
  options.scenario = choice.scenario;
  if (choice.png) options.write_png = &rendering::EncodePng;
  const std::vector<std::string> arguments = WithoutSecrets(ArgumentsOfThisProcess());
  std::error_code ignored;
  options.metadata = {{"gsv_version", GSV_VERSION},
                      {"command", fmt::format("{}", fmt::join(arguments, " "))},
                      {std::string(kFolderKey), std::filesystem::current_path(ignored).string()},
                      {"host", base::HostName()}};
  if (is_of_command) {
    options.metadata[std::string(kArgumentsKey)] =
        nlohmann::json(arguments).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  }
  return options;
}

constexpr double kMinRate = 0.001, kMaxRate = 10'000;

// Whether a recording to this path is a single file: the path ends in ".mcap", or is an existing
// file or device.
bool NamesAFile(const std::string& path) {
  std::error_code ignored;
  return path.ends_with(".mcap") ||
         (std::filesystem::exists(path, ignored) && !std::filesystem::is_directory(path, ignored));
}

}  // namespace

std::vector<std::string> ProblemsOf(const RecordingChoice& choice,
                                    const std::vector<std::string>& topics) {
  constexpr std::size_t kMaxTopics = 24;
  std::vector<std::string> sentences;
  for (const std::string& pattern : recording::UnmatchedPatterns(topics, choice.topics)) {
    // True for "/gsv", for example: there is no such topic, but there are topics below it.
    const bool is_folder = recording::UnmatchedPatterns(topics, {pattern + "/"}).empty();
    const std::size_t listed = std::min(topics.size(), kMaxTopics);
    std::string there = fmt::format("{}", fmt::join(topics.begin(), topics.begin() + listed, ", "));
    if (listed < topics.size()) there += fmt::format(" and {} more", topics.size() - listed);
    sentences.push_back(fmt::format(
        "--record-topics {}: {}", pattern,
        is_folder
            ? fmt::format("there is no topic of this name; use \"{}/\" for all topics below it",
                          pattern)
            : "there is no topic of this name or below it; topics are " + there +
                  base::DidYouMean(pattern, topics)));
  }
  return sentences;
}

base::Status SetRate(const std::string& text, RecordingChoice& choice) {
  const std::pair<std::string_view, double*> kinds[]{{"poses", &choice.poses_rate},
                                                     {"readings", &choice.readings_rate},
                                                     {"pictures", &choice.images_rate},
                                                     {"beams", &choice.beams_rate}};
  const std::size_t equals = std::min(text.find('='), text.size());
  const std::string_view name = std::string_view(text).substr(0, equals);
  const std::string_view number = std::string_view(text).substr(std::min(equals + 1, text.size()));
  const auto* kind = std::find_if(std::begin(kinds), std::end(kinds),
                                  [&](const auto& each) { return each.first == name; });
  double rate = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), rate);
  const bool is_number = error == std::errc() && end == number.data() + number.size();
  if (kind == std::end(kinds) || !is_number || !(rate >= kMinRate && rate <= kMaxRate)) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "expected poses=HZ, readings=HZ, pictures=HZ or beams=HZ, with 0.001 to "
                      "10000 Hz of simulated time",
                      "--record-rate " + text);
  }
  *kind->second = rate;
  return {};
}

base::Result<std::filesystem::path> RecordingsFolder(const std::filesystem::path& folder) {
  std::error_code error;
  const std::filesystem::path whole =
      std::filesystem::canonical(folder.empty() ? "." : folder, error);
  if (!error && std::filesystem::is_directory(whole, error)) return whole;
  return base::Fail(base::ErrorCode::kInvalidArgument,
                    "the folder for recordings does not exist; create it, or choose another",
                    folder.string());
}

Recordings::Recordings(std::filesystem::path folder) : folder_(std::move(folder)) {}
Recordings::~Recordings() = default;

base::Status Recordings::FinishEndedRecording(
    const std::shared_ptr<simulation::Simulation>& simulation) {
  const std::string& name = simulation->specification().name;
  base::MutexLock lock(mutex_);
  const auto found = recordings_.find(name);
  if (found == recordings_.end()) return {};
  // A recording is over if its simulation was destroyed or reset, or if the disk failed.
  if (found->second.simulation.lock() == simulation && found->second.recorder->is_recording()) {
    return base::Fail(
        base::ErrorCode::kInvalidArgument,
        "it is already being recorded to " + found->second.path + "; stop this recording first",
        name);
  }
  auto node = recordings_.extract(found);
  SetLast(name, node.mapped());
  lock.unlock();
  if (const auto ok = Finish(node.mapped()); !ok) spdlog::error("{}", ok.error().Sentence());
  CountEnded(node.mapped());
  return {};
}

void Recordings::SetSimulationOfCommand(const std::shared_ptr<simulation::Simulation>& simulation) {
  const base::MutexLock lock(mutex_);
  of_command_ = simulation;
}

void Recordings::SetRos2(const std::shared_ptr<simulation::Simulation>& simulation,
                         const scenario::Ros2Settings& settings) {
  const base::MutexLock lock(mutex_);
  published_ = simulation;
  ros2_ = settings;
}

base::Status Recordings::Start(std::shared_ptr<simulation::Simulation> simulation,
                               const std::string& path, const RecordingChoice& choice) {
  const base::MutexLock starting(starting_);
  if (auto ok = FinishEndedRecording(simulation); !ok) return ok;
  std::string bag;
  if (!NamesAFile(path)) {
    auto file = recording::MakeBagFolder(path);
    if (!file) return base::Fail(file.error());
    bag = *std::move(file);
  }
  base::MutexLock lock(mutex_);
  const bool is_of_command = of_command_.lock() == simulation;
  const auto ros2 = published_.lock() == simulation ? std::optional(ros2_) : std::nullopt;
  lock.unlock();
  recording::RecorderOptions options = Options(choice, is_of_command);
  if (ros2 && !options.scenario) {
    options.scenario = recording::ScenarioOf(*simulation);
    options.scenario->ros2 = ros2;
  }
  auto recorder = recording::SimulationRecorder::Start(simulation, bag.empty() ? path : bag,
                                                       std::move(options));
  if (!recorder) return base::Fail(recorder.error());
  lock.lock();
  recordings_.emplace(simulation->specification().name,
                      Recording{simulation, path, std::move(bag), *std::move(recorder)});
  return {};
}

base::Status Recordings::Record(const std::shared_ptr<simulation::Simulation>& simulation) {
  std::string name = simulation->specification().name;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0 && c != '_'; },
      '-');
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  return Start(simulation, folder_ / fmt::format("{}-{:04}{:02}{:02}-{:02}{:02}{:02}.mcap", name,
                                                 utc.tm_year + 1900, utc.tm_mon + 1, utc.tm_mday,
                                                 utc.tm_hour, utc.tm_min, utc.tm_sec));
}

Recordings::State Recordings::RecordingOf(const std::string& simulation) {
  const base::MutexLock lock(mutex_);
  const auto found = recordings_.find(simulation);
  if (found != recordings_.end()) return StateOf(found->second);
  const auto last = last_.find(simulation);
  return last == last_.end() ? State() : last->second;
}

void Recordings::Add(const State& state, Totals& totals) {
  if (state.is_recording) ++totals.under_way;
  totals.messages += state.messages;
  totals.dropped += state.dropped;
  totals.bytes += state.bytes;
}

void Recordings::CountEnded(const Recording& recording) {
  const base::MutexLock lock(mutex_);
  Add(StateOf(recording), ended_);
  ended_.under_way = 0;
}

Recordings::Totals Recordings::totals() {
  const base::MutexLock lock(mutex_);
  Totals totals = ended_;
  for (const auto& [name, recording] : recordings_) Add(StateOf(recording), totals);
  // While Finish() runs, a recording is neither in recordings_ nor counted in ended_. The maximum
  // with the totals of the previous call ensures that the returned totals never decrease.
  reported_ = {totals.under_way, std::max(totals.messages, reported_.messages),
               std::max(totals.dropped, reported_.dropped),
               std::max(totals.bytes, reported_.bytes)};
  return reported_;
}

Recordings::State Recordings::StateOf(const Recording& recording) {
  const recording::McapWriter::Progress progress = recording.recorder->progress();
  return {recording.recorder->is_recording(), recording.path, progress.messages, progress.dropped,
          progress.bytes};
}

base::Status Recordings::Finish(Recording& recording) {
  if (auto stopped = recording.recorder->Stop(); !stopped) return stopped;
  return recording.bag.empty() ? base::Status() : recording::WriteBagMetadata(recording.bag);
}

void Recordings::SetLast(const std::string& simulation, const Recording& recording) {
  State state = StateOf(recording);
  state.is_recording = false;
  last_[simulation] = std::move(state);
}

base::Status Recordings::Stop(const std::string& simulation) {
  base::MutexLock lock(mutex_);
  auto node = recordings_.extract(simulation);
  if (node.empty()) {
    return base::Fail(base::ErrorCode::kNotFound, "it is not being recorded", simulation);
  }
  SetLast(simulation, node.mapped());
  lock.unlock();
  const base::Status finished = Finish(node.mapped());
  CountEnded(node.mapped());
  lock.lock();
  SetLast(simulation, node.mapped());
  return finished;
}

base::Status Recordings::StopAll() {
  base::MutexLock lock(mutex_);
  auto recordings = std::exchange(recordings_, {});
  for (const auto& [name, recording] : recordings) SetLast(name, recording);
  lock.unlock();
  base::Status first;
  for (auto& [name, recording] : recordings) {
    const base::Status stopped = Finish(recording);
    CountEnded(recording);
    if (stopped) continue;
    if (first) {
      first = stopped;
    } else {
      spdlog::error("{}: {}", name, stopped.error().Sentence());
    }
  }
  return first;
}

}  // namespace gsv::app
