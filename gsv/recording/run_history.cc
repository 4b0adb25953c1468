#include "gsv/recording/run_history.h"

#include <algorithm>
#include <thread>
#include <utility>

#include "gsv/presentation/state_messages.h"
#include "gsv/recording/attachments/scene_attachments.h"
#include "gsv/recording/topics/health_topic.h"
#include "gsv/recording/topics/sensor_recorder.h"
#include "gsv/recording/topics/state_topics.h"

namespace gsv::recording {
namespace {

using simulation::Simulation;
namespace topics = presentation::topics;

constexpr std::size_t kMaxCollisions = 500;
constexpr std::size_t kMaxWaitingEvents = 10'000;
constexpr std::size_t kMaxWaitingContacts = 256;
constexpr std::size_t kQueueSize = std::size_t{16} << 20;  // bytes
constexpr std::chrono::milliseconds kChunkAge{500};        // wall-clock time
constexpr std::chrono::milliseconds kWatchedPeriod{50}, kUnwatchedPeriod{250};
constexpr std::chrono::milliseconds kWatchedStatusPeriod{200}, kUnwatchedStatusPeriod{1000};
constexpr std::chrono::milliseconds kReadingsPeriod{200}, kSensorListPeriod{1000};
// The time from the start of one sampling to the start of the next is at least this multiple of the
// time that the first one took.
constexpr int kWatchedRest = 20, kUnwatchedRest = 50;
// A rate above all sampling rates, so that every sample is recorded.
constexpr double kHistoryPosesRate = 1000;
constexpr std::chrono::milliseconds kOpenTimeout{500}, kOpenPoll{5};

// Limits the share of the thread's time that an activity takes: runs it periodically, and less
// often if it takes long.
class Share {
 public:
  bool IsDue(RunHistory::WallTime now) const { return now >= next_; }
  template <typename Activity>
  void Run(RunHistory::WallTime now, std::chrono::nanoseconds period, int rest, Activity activity) {
    const auto begin = std::chrono::steady_clock::now();
    activity();
    const auto took = std::chrono::steady_clock::now() - begin;
    next_ = now + std::max<std::chrono::nanoseconds>(period, rest * took);
  }

 private:
  RunHistory::WallTime next_{};
};

std::vector<std::string> NamesOf(std::initializer_list<const char*> names) {
  return {names.begin(), names.end()};
}

// The topics of the state. Contacts are missing, because they are written for each step separately.
// /tf is missing, because it repeats the poses.
Selection StateSelection() {
  return {.topics = NamesOf({topics::kClock.name, topics::kPoses.name, topics::kStatus.name,
                             topics::kEvents.name, topics::kLog.name, topics::kOutput.name,
                             topics::kNotes.name, topics::kExpectations.name,
                             topics::kCommands.name, topics::kActuators.name})};
}

WriterOptions RingWriting() {
  WriterOptions options;
  options.when_full = WhenFull::kDrop;
  options.queue_size = kQueueSize;
  return options;
}

}  // namespace

// Collects the events and collisions between two calls of SampleIfDue().
class RunHistory::Inbox final : public simulation::Observer {
 public:
  struct Content {
    std::vector<simulation::Event> events;
    std::vector<std::pair<base::SimTime, messages::gsv_msgs::Contact>> contacts;
    std::vector<Collision> collisions;
    bool was_reset = false;
  };

  void OnSnapshot(const std::shared_ptr<const world::Snapshot>& snapshot) override {
    for (const world::Contact& contact : snapshot->contacts) {
      if (!contact.began || contact.supports) continue;
      const base::MutexLock lock(mutex_);
      if (content_.contacts.size() >= kMaxWaitingContacts) return;
      const messages::gsv_msgs::Contact message = presentation::ContactMessage(*snapshot, contact);
      AddCollision(*snapshot, contact, message);
      content_.contacts.emplace_back(snapshot->state.time, message);
    }
  }
  void OnEvent(const simulation::Event& event) override {
    const base::MutexLock lock(mutex_);
    if (event.kind == "reset") content_ = {{}, {}, {}, true};
    if (content_.events.size() < kMaxWaitingEvents) content_.events.push_back(event);
  }

  Content Take() {
    const base::MutexLock lock(mutex_);
    return std::exchange(content_, {});
  }

 private:
  void AddCollision(const world::Snapshot& snapshot, const world::Contact& contact,
                    const messages::gsv_msgs::Contact& names) GSV_REQUIRES(mutex_) {
    const auto is_robot = [&](int body) {
      return snapshot.layout->bodies[static_cast<std::size_t>(body)].is_robot();
    };
    const base::SimTime time = snapshot.state.time;
    if (is_robot(contact.first)) {
      content_.collisions.push_back({time, names.first, names.second});
    } else if (is_robot(contact.second)) {
      content_.collisions.push_back({time, names.second, names.first});
    }
  }

  base::Mutex mutex_;
  Content content_ GSV_GUARDED_BY(mutex_);
};

// The history of one run.
class RunHistory::Run {
 public:
  Run(const Simulation& simulation, std::size_t capacity)
      : ring_(std::make_shared<ChunkRing>(capacity)),
        writer_(ring_->MakeSink(), RingWriting()),
        types_(std::make_shared<sensing::SensorRegistry>(simulation.sensor_types())),
        states_(writer_, kHistoryPosesRate, StateSelection()),
        contacts_(writer_, {}, topics::kContacts),
        sensors_(writer_, types_, simulation.specification().seed,
                 {.rates = {}, .selection = {}, .write_png = {}, .slow_sensors = false}),
        health_(writer_, {}, types_, simulation.specification().seed,
                simulation.specification().stuck_after),
        scene_(writer_, types_, nullptr) {
    const simulation::SimulationStatus status = simulation.status();
    writer_.AddMetadata({"gsv.simulation",
                         {{"name", status.name},
                          {"mode", ToString(status.mode)},
                          {"step_ns", std::to_string(status.step_size.count())}}});
  }

  void Write(const Inbox::Content& content) {
    for (const simulation::Event& event : content.events) states_.RecordEvent(event);
    for (const auto& [time, contact] : content.contacts) contacts_.Write(time, contact);
  }

  void Sample(const Simulation& simulation, WallTime now, bool is_watched) {
    const auto snapshot = simulation.snapshot();
    const int rest = is_watched ? kWatchedRest : kUnwatchedRest;
    if (snapshot->layout != layout_ || (is_watched && list_share_.IsDue(now))) {
      list_share_.Run(now, kSensorListPeriod, rest, [&] { SetSensors(simulation, *snapshot); });
    }
    if (snapshot != latest_ && pose_share_.IsDue(now)) {
      pose_share_.Run(now, is_watched ? kWatchedPeriod : kUnwatchedPeriod, rest, [&] {
        states_.Record(snapshot);
        latest_ = snapshot;
      });
    }
    if (status_share_.IsDue(now)) {
      const auto period = is_watched ? kWatchedStatusPeriod : kUnwatchedStatusPeriod;
      status_share_.Run(now, period, rest, [&] { WriteStatus(simulation, snapshot, is_watched); });
    }
    if (is_watched && snapshot != sensed_ && sensor_share_.IsDue(now)) {
      sensor_share_.Run(now, kReadingsPeriod, rest, [&] { sensors_.Record(snapshot); });
      sensed_ = snapshot;
    }
    writer_.FlushIfOlderThan(kChunkAge);
  }

  base::SimTime latest() const { return latest_ ? latest_->state.time : base::SimTime(0); }
  const ChunkRing& ring() const { return *ring_; }

  base::Result<std::unique_ptr<McapReader>> Open() {
    writer_.FlushIfOlderThan(std::chrono::milliseconds(0));
    const std::uint64_t written = writer_.progress().messages;
    const auto end = std::chrono::steady_clock::now() + kOpenTimeout;
    while (ring_->extent().messages < written && std::chrono::steady_clock::now() < end) {
      std::this_thread::sleep_for(kOpenPoll);
    }
    return ring_->Open();
  }

 private:
  void SetSensors(const Simulation& simulation, const world::Snapshot& snapshot) {
    const auto lists = std::make_shared<SensorLists>(SensorsOf(simulation, *snapshot.layout));
    scene_.Attach(snapshot, *lists);
    sensors_.SetSensors(*lists, snapshot);
    health_.SetSensors(lists);
    layout_ = snapshot.layout;
  }

  void WriteStatus(const Simulation& simulation,
                   const std::shared_ptr<const world::Snapshot>& snapshot, bool is_watched) {
    const simulation::SimulationStatus status = simulation.status();
    if (status.time == status_time_ && status.phase == phase_) return;
    status_time_ = status.time;
    phase_ = status.phase;
    states_.RecordStatus(status);
    states_.RecordExpectations(status.time, simulation.expectations());
    if (is_watched) health_.Record(snapshot, status);
  }

  const std::shared_ptr<ChunkRing> ring_;
  McapWriter writer_;
  const std::shared_ptr<const sensing::SensorRegistry> types_;
  StateTopics states_;
  TopicWriter<messages::gsv_msgs::Contact> contacts_;
  SensorRecorder sensors_;
  HealthTopic health_;
  SceneAttachments scene_;
  std::shared_ptr<const world::Layout> layout_;
  std::shared_ptr<const world::Snapshot> latest_, sensed_;
  std::optional<simulation::Phase> phase_;
  base::SimTime status_time_{-1};
  Share list_share_, pose_share_, status_share_, sensor_share_;
};

RunHistory::RunHistory(const std::shared_ptr<Simulation>& simulation, std::size_t capacity)
    : simulation_(simulation), capacity_(capacity), inbox_(std::make_shared<Inbox>()) {
  simulation->AddObserver(inbox_);
}

RunHistory::~RunHistory() {
  if (const auto simulation = simulation_.lock()) simulation->RemoveObserver(inbox_);
}

void RunHistory::SampleIfDue(WallTime now, bool is_watched) {
  const std::shared_ptr<Simulation> simulation = simulation_.lock();
  if (!simulation) return;
  const Inbox::Content content = inbox_->Take();
  std::shared_ptr<Run> run = this->run();
  const bool is_new_run =
      run == nullptr || content.was_reset || simulation->snapshot()->state.time < run->latest();
  KeepCollisions(content.collisions, is_new_run);
  if (is_new_run) {
    run = std::make_shared<Run>(*simulation, capacity_);
    const base::MutexLock lock(mutex_);
    run_ = run;
  }
  run->Write(content);
  run->Sample(*simulation, now, is_watched);
}

void RunHistory::KeepCollisions(const std::vector<Collision>& collisions, bool is_new_run) {
  const base::MutexLock lock(mutex_);
  if (is_new_run) collisions_.clear();
  collisions_.insert(collisions_.end(), collisions.begin(), collisions.end());
  while (collisions_.size() > kMaxCollisions) collisions_.pop_front();
}

std::shared_ptr<RunHistory::Run> RunHistory::run() const {
  const base::MutexLock lock(mutex_);
  return run_;
}

ChunkRing::Extent RunHistory::extent() const {
  const std::shared_ptr<Run> run = this->run();
  return run ? run->ring().extent() : ChunkRing::Extent();
}

std::vector<Collision> RunHistory::collisions() const {
  const base::MutexLock lock(mutex_);
  return {collisions_.begin(), collisions_.end()};
}

base::Result<std::unique_ptr<McapReader>> RunHistory::Open() const {
  if (const std::shared_ptr<Run> run = this->run()) return run->Open();
  return ChunkRing(0).Open();
}

}  // namespace gsv::recording
