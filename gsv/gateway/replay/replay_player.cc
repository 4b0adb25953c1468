#include "gsv/gateway/replay/replay_player.h"

#include <charconv>
#include <filesystem>
#include <utility>

#include "gsv/gateway/replay/replay_operations.h"

namespace gsv::gateway {
namespace {

using simulation::AgentPhase;

constexpr std::chrono::nanoseconds kRound{1'000'000'000 / 30};
constexpr std::int64_t kMaxPoses = 1000;  // maximum number of poses in one step
constexpr double kMinSpeed = 0.001, kMaxSpeed = 1000;

recording::StringMap Metadata(const recording::McapReader& reader, const std::string& name) {
  for (const recording::MetadataIndexRecord& index : reader.summary().metadata) {
    if (index.name != name) continue;
    if (auto record = reader.Read(index)) return std::move(record->values);
  }
  return {};
}

std::string NameOf(const recording::McapReader& reader, const std::string& path) {
  const recording::StringMap values = Metadata(reader, "gsv.simulation");
  const auto name = values.find("name");
  const bool is_usable = name != values.end() && !name->second.empty();
  return is_usable ? name->second : std::filesystem::path(path).stem().string();
}

AgentPhase ParseAgentPhase(const std::string& text) {
  for (const AgentPhase phase :
       {AgentPhase::kInitialised, AgentPhase::kRunning, AgentPhase::kWaiting, AgentPhase::kFinished,
        AgentPhase::kUnresponsive, AgentPhase::kDead}) {
    if (text == ToString(phase)) return phase;
  }
  return AgentPhase::kNone;
}

// Returns pose number `index` of a message; the identity if there are fewer.
geometry::Pose PoseAt(const messages::gsv_msgs::Poses& message, std::size_t index) {
  geometry::Pose pose;
  if (message.poses.size() / 7 <= index) return pose;
  const double* numbers = &message.poses[7 * index];
  pose.position = {numbers[0], numbers[1], numbers[2]};
  pose.orientation.x = numbers[3];
  pose.orientation.y = numbers[4];
  pose.orientation.z = numbers[5];
  pose.orientation.w = numbers[6];
  return pose;
}

}  // namespace

base::Result<std::unique_ptr<ReplayPlayer>> ReplayPlayer::Open(const std::string& path,
                                                               const ReplayOptions& options) {
  auto reader = recording::McapReader::Open(path);
  if (!reader) return base::Fail(reader.error());
  return Open(*std::move(reader), path, options);
}

base::Result<std::unique_ptr<ReplayPlayer>> ReplayPlayer::Open(
    std::unique_ptr<recording::McapReader> reader, const std::string& name,
    const ReplayOptions& options, ModelSource models) {
  if (reader->summary().message_count == 0) {
    return base::Fail(base::ErrorCode::kCorrupt, "cannot replay the recording: it has no messages",
                      name);
  }
  return std::unique_ptr<ReplayPlayer>(
      new ReplayPlayer(std::move(reader), name, options, std::move(models)));
}

ReplayPlayer::ReplayPlayer(std::unique_ptr<recording::McapReader> reader, const std::string& path,
                           const ReplayOptions& options, ModelSource models)
    : reader_(std::move(reader)),
      name_(NameOf(*reader_, path)),
      scene_(*reader_, std::move(models)),
      timeline_(*reader_, scene_),
      curves_(*reader_, scene_),
      problems_(reader_->summary().problems),
      clock_(reader_->summary().start, reader_->summary().end, options.speed, options.loop),
      stream_(
          *reader_, name_, [this] { Wake(); }, std::make_shared<ReplayOperations>(*this)) {
  problems_.insert(problems_.end(), scene_.problems().begin(), scene_.problems().end());
  ReadMetadata();
  // Reads the messages at the start now, because a request may ask for the robots before the replay
  // plays.
  stream_.JumpTo(clock_.position());
  thread_ = std::thread([this] { Run(); });
}

ReplayPlayer::~ReplayPlayer() { Stop(); }

void ReplayPlayer::ReadMetadata() {
  recording::StringMap values = Metadata(*reader_, "gsv.simulation");
  if (values["mode"] == ToString(simulation::Mode::kLockstep)) mode_ = simulation::Mode::kLockstep;
  const std::string& text = values["step_ns"];
  std::int64_t step = 0;
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), step);
  constexpr base::SimTime kMaxStep = std::chrono::seconds(10);
  const bool is_usable = parsed.ec == std::errc() && step > 0 && base::SimTime(step) <= kMaxStep;
  if (is_usable) step_ = base::SimTime(step);
}

template <typename Change>
auto ReplayPlayer::Command(Change change) {
  const base::MutexLock lock(mutex_);
  is_woken_ = true;
  changed_.notify_all();
  return change(clock_);
}

base::Status ReplayPlayer::Start() {
  return Command([](ReplayClock& clock) { return clock.Start(); });
}
base::Status ReplayPlayer::Pause() {
  return Command([](ReplayClock& clock) { return clock.Pause(); });
}
base::Status ReplayPlayer::Resume() {
  return Command([](ReplayClock& clock) { return clock.Resume(); });
}

base::Status ReplayPlayer::Step(std::int64_t count) {
  if (count < 1 || count > base::SimTime::max() / step_) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "the number of steps must be from 1 to " +
                          std::to_string(base::SimTime::max() / step_) + ", not " +
                          std::to_string(count));
  }
  return Command([&](ReplayClock& clock)
                     GSV_REQUIRES(mutex_) { return clock.Step(count * step_); });
}

void ReplayPlayer::Rewind() {
  Command([this](ReplayClock& clock) GSV_REQUIRES(mutex_) {
    clock.Rewind();
    has_jumped_ = true;
  });
}

void ReplayPlayer::Seek(base::SimTime time) {
  Command([&](ReplayClock& clock) GSV_REQUIRES(mutex_) {
    clock.Seek(time);
    has_jumped_ = true;
  });
}

base::Status ReplayPlayer::StepPoses(std::int64_t count) {
  if (count == 0 || count < -kMaxPoses || count > kMaxPoses) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "the number of poses to step must be 1 to 1000 or -1 to -1000");
  }
  const base::SimTime time = timeline_.TimeOfPoseFrom(clock().position(), count);
  Command([&](ReplayClock& clock) GSV_REQUIRES(mutex_) {
    clock.SeekAndPause(time);
    has_jumped_ = true;
  });
  return {};
}

base::Status ReplayPlayer::SetSpeed(double speed) {
  if (!(speed >= kMinSpeed && speed <= kMaxSpeed)) {
    return base::Fail(base::ErrorCode::kInvalidArgument, "'speed' must be from 0.001 to 1000");
  }
  Command([&](ReplayClock& clock) GSV_REQUIRES(mutex_) { clock.SetSpeed(speed); });
  return {};
}

void ReplayPlayer::SetLoop(bool loop) {
  Command([&](ReplayClock& clock) GSV_REQUIRES(mutex_) { clock.SetLoop(loop); });
}

std::vector<std::string> ReplayPlayer::ListTopicsOf(const std::string& robot) {
  std::vector<std::string> topics;
  for (const auto& [id, channel] : reader_->summary().channels) {
    if (channel.topic.starts_with("/" + robot + "/")) topics.push_back(channel.topic);
  }
  if (!topics.empty()) stream_.Want(robot);
  Wake();
  return topics;
}

void ReplayPlayer::Wake() {
  const base::MutexLock lock(mutex_);
  is_woken_ = true;
  changed_.notify_all();
}

void ReplayPlayer::Stop() {
  {
    const base::MutexLock lock(mutex_);
    is_stopping_ = true;
    changed_.notify_all();
  }
  if (thread_.joinable()) thread_.join();
  curves_.Stop();
  hub()->Close(CloseCode::kGoingAway, "the server is shutting down");
}

void ReplayPlayer::Run() {
  auto next_round = std::chrono::steady_clock::now();
  base::MutexLock lock(mutex_);
  while (!is_stopping_) {
    is_woken_ = false;
    const WallTime now = std::chrono::steady_clock::now();
    if (clock_.Advance(now)) has_jumped_ = true;
    const base::SimTime position = clock_.position();
    const simulation::Phase phase = clock_.phase();
    const bool has_jumped = std::exchange(has_jumped_, false);
    lock.unlock();
    if (has_jumped) {
      stream_.JumpTo(position);
    } else {
      stream_.PlayTo(position);
    }
    stream_.Publish(position, phase, now, [this] { return status(); });
    lock.lock();
    const auto is_called = [this]() GSV_REQUIRES(mutex_) {
      return is_stopping_ || is_woken_ || has_jumped_;
    };
    if (clock_.is_playing()) {
      next_round = std::max(next_round + kRound, now);
      changed_.wait_until(lock, next_round, is_called);
    } else {
      changed_.wait(lock, is_called);
    }
  }
}

ReplayClock ReplayPlayer::clock() const {
  const base::MutexLock lock(mutex_);
  return clock_;
}

simulation::SimulationStatus ReplayPlayer::status() const {
  const messages::gsv_msgs::SimulationStatus recorded = stream_.recorded_status();
  const messages::gsv_msgs::Poses poses = stream_.recorded_poses();
  const auto& places = scene_.BodyPoses(poses.layout_version);
  const ReplayClock clock = this->clock();
  simulation::SimulationStatus status;
  status.name = name_;
  status.phase = clock.phase();
  status.mode = mode_;
  status.step = static_cast<std::int64_t>(poses.step);
  status.time = clock.position();
  status.step_size = step_;
  status.target_factor = clock.speed();
  status.real_time_factor = clock.is_playing() ? clock.speed() : 0;
  for (const messages::gsv_msgs::RobotStatus& robot : recorded.robots) {
    simulation::RobotStatus shown;
    shown.name = robot.name;
    shown.model = robot.model;
    shown.behaviour = robot.behaviour;
    shown.is_avatar = scene_.IsAvatar(robot.name);
    shown.is_station = scene_.IsStation(robot.name);
    shown.phase = ParseAgentPhase(robot.agent_state);
    shown.detail = robot.detail;
    shown.distance = robot.distance_m;
    shown.collisions = robot.collisions;
    const auto place = places.find(robot.name);
    if (place != places.end()) shown.world_from_robot = PoseAt(poses, place->second);
    status.robots.push_back(std::move(shown));
  }
  return status;
}

base::Result<SharedBytes> ReplayPlayer::SceneNow() const {
  return scene_.Scene(stream_.recorded_poses().layout_version);
}

}  // namespace gsv::gateway
