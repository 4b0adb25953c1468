#include "gsv/recording/simulation_recorder.h"

#include <utility>

#include <fmt/format.h>

#include "gsv/base/check.h"
#include "gsv/base/log.h"
#include "gsv/scenario/scenario_file.h"

namespace gsv::recording {
namespace {

// Wall-clock times: the period of checks for a destroyed simulation or a failed disk, and the age
// at which messages are written. A crash may lose one second of messages at most. The sum of these
// times is well below one second, so that this also holds on a busy machine.
constexpr std::chrono::milliseconds kPollPeriod{100};
constexpr std::chrono::milliseconds kFlushAge{500};

using simulation::Simulation;

MetadataRecord Describe(const Simulation& simulation, const StringMap& further) {
  const simulation::Specification& specification = simulation.specification();
  const model::WorldDescription& world = *specification.world;
  const base::SimTime step =
      specification.step.count() > 0 ? specification.step : world.max_step_size;
  MetadataRecord record{"gsv.simulation",
                        {{"name", specification.name},
                         {"world", world.name},
                         {"world_source", world.source},
                         {"mode", ToString(specification.mode)},
                         {"seed", std::to_string(specification.seed)},
                         {"step_ns", std::to_string(step.count())},
                         {"factor", std::to_string(specification.factor)}}};
  record.values["robots"] = std::to_string(simulation.status().CountRobots());
  if (simulation.was_edited()) record.values["edited"] = "true";
  record.values.insert(further.begin(), further.end());
  return record;
}

// Adds to `result` whether the run has passed or failed. If expectations were violated, also adds
// name, detail and time of the first violation.
void AddVerdict(const std::vector<simulation::ExpectationState>& states, StringMap& result) {
  using Verdict = simulation::ExpectationState::Verdict;
  if (states.empty()) return;
  const simulation::ExpectationState* first = nullptr;
  for (const simulation::ExpectationState& state : states) {
    if (state.verdict != Verdict::kViolated) continue;
    if (first == nullptr || state.step < first->step) first = &state;
  }
  result["verdict"] = first == nullptr ? "passed" : "failed";
  if (first == nullptr) return;
  result["sentence"] = first->name + ": " + first->detail;
  result["violation_s"] = fmt::format("{:g}", base::ToSeconds(first->time));
}

// Returns the result of the run for the metadata at the end of its recording.
StringMap ResultOf(const Simulation& simulation) {
  const simulation::SimulationStatus status = simulation.status();
  StringMap result{{"phase", ToString(status.phase)},
                   {"step", std::to_string(status.step)},
                   {"state_hash", simulation.state_hash()}};
  AddVerdict(simulation.expectations(), result);
  return result;
}

WhenFull WhenFullFor(simulation::Mode mode) {
  return mode == simulation::Mode::kLockstep ? WhenFull::kWait : WhenFull::kDrop;
}

}  // namespace

base::Result<std::unique_ptr<SimulationRecorder>> SimulationRecorder::Start(
    const std::shared_ptr<Simulation>& simulation, const std::string& path,
    RecorderOptions options) {
  GSV_CHECK(options.write_glb != nullptr);
  WriterOptions writing;
  writing.replace = options.replace;
  writing.when_full = WhenFullFor(simulation->specification().mode);
  auto writer = McapWriter::Create(path, writing);
  if (!writer) return base::Fail(writer.error());
  std::unique_ptr<SimulationRecorder> recorder(
      new SimulationRecorder(simulation, *std::move(writer), std::move(options)));
  recorder->RecordFirst(*simulation);
  simulation->AddObserver(recorder->feed_);
  recorder->thread_ = std::thread([self = recorder.get()] { self->Run(); });
  return recorder;
}

SimulationRecorder::SimulationRecorder(const std::shared_ptr<Simulation>& simulation,
                                       std::unique_ptr<McapWriter> writer, RecorderOptions options)
    : simulation_(simulation),
      writer_(std::move(writer)),
      types_(std::make_shared<sensing::SensorRegistry>(simulation->sensor_types())),
      states_(*writer_, options.poses_rate, {.topics = options.topics}),
      sensors_(*writer_, types_, simulation->specification().seed,
               {options.sensors, {.topics = options.topics}, std::move(options.write_png)}),
      health_(*writer_, {.topics = options.topics}, types_, simulation->specification().seed,
              simulation->specification().stuck_after),
      scene_(*writer_, types_, std::move(options.write_glb)),
      sources_(*writer_),
      feed_(std::make_shared<SimulationFeed>(
          *simulation, FeedOptions{.when_full = WhenFullFor(simulation->specification().mode)})) {
  writer_->AddMetadata(Describe(*simulation, options.metadata));
  const std::string scenario =
      scenario::ToYaml(options.scenario ? *options.scenario : ScenarioOf(*simulation));
  writer_->Attach({simulation->snapshot()->state.time,
                   {},
                   std::string(kScenarioAttachment),
                   std::string(kScenarioMediaType),
                   std::as_bytes(std::span(scenario))});
  sources_.AttachWorld(*simulation->specification().world);
}

SimulationRecorder::~SimulationRecorder() {
  if (is_stopped_) return;
  if (const base::Status stopped = Stop(); !stopped) {
    spdlog::error("the recording ended early: {}", stopped.error().Sentence());
  }
}

void SimulationRecorder::RecordFirst(const Simulation& simulation) {
  const std::shared_ptr<const world::Snapshot> snapshot = simulation.snapshot();
  Record(Observation{snapshot,
                     std::make_shared<SensorLists>(SensorsOf(simulation, *snapshot->layout)),
                     simulation.status(), simulation.expectations()});
  for (const simulation::Edit& edit : EditsBeforeStart(simulation)) states_.RecordEdit(edit);
}

base::Status SimulationRecorder::Stop() {
  const base::MutexLock lock(stopping_);
  if (!std::exchange(is_stopped_, true)) {
    const std::shared_ptr<Simulation> simulation = simulation_.lock();
    if (simulation) {
      if (!feed_->was_reset()) result_ = ResultOf(*simulation);
      // The run has ended, but its last snapshot may not be delivered yet. So the feed is closed
      // with the current state appended.
      feed_->CloseAtLatest();
      simulation->RemoveObserver(feed_);
    }
    feed_->Close();
    thread_.join();
  }
  return writer_->Close();
}

bool SimulationRecorder::is_recording() const { return !has_ended_; }

void SimulationRecorder::Run() {
  while (!writer_->failed()) {
    if (const std::optional<Occurrence> occurrence = feed_->Next(kPollPeriod)) {
      Record(*occurrence);
    } else if (feed_->is_over() || simulation_.expired()) {
      break;
    }
    writer_->FlushIfOlderThan(kFlushAge);
  }
  feed_->Close();
  if (feed_->was_reset()) spdlog::warn("a recording ended: its simulation was reset");
  WriteEnd();
  has_ended_ = true;
}

void SimulationRecorder::Record(const Occurrence& occurrence) {
  if (const auto* observation = std::get_if<Observation>(&occurrence)) return Record(*observation);
  states_.RecordEvent(std::get<simulation::Event>(occurrence));
}

void SimulationRecorder::Record(const Observation& observation) {
  const world::Snapshot& snapshot = *observation.snapshot;
  // The first and the last snapshot are read from the simulation itself, so the feed may deliver
  // them a second time. Then only the status is recorded.
  if (latest_ && snapshot.state.step <= latest_->state.step) {
    RecordStatusOf(observation);
    return;
  }
  // The last snapshot may contain a robot that was added after the last step. This robot is not
  // part of the recording.
  if (latest_ && snapshot.layout != latest_->layout && !observation.sensors) return;
  if (observation.sensors) {
    scene_.Attach(snapshot, *observation.sensors);
    sources_.AttachRobots(snapshot);
    sensors_.SetSensors(*observation.sensors, snapshot);
    health_.SetSensors(observation.sensors);
  }
  states_.Record(observation.snapshot);
  RecordStatusOf(observation);
  sensors_.Record(observation.snapshot);
  latest_ = observation.snapshot;
}

void SimulationRecorder::RecordStatusOf(const Observation& observation) {
  if (!observation.status) return;
  states_.RecordStatus(*observation.status);
  states_.RecordExpectations(observation.status->time, observation.expectations);
  health_.Record(observation.snapshot, *observation.status);
}

// Writes the last observed state at the end, because a replay ends with it.
void SimulationRecorder::WriteEnd() {
  if (writer_->failed()) return;
  states_.RecordNow(*latest_);
  StringMap result = result_;
  result["dropped_snapshots"] = std::to_string(feed_->dropped());
  writer_->AddMetadata({"gsv.result", std::move(result)});
  (void)writer_->Close();  // Stop() returns the error
}

}  // namespace gsv::recording
