#include "gsv/recording/simulation_recorder.h"

#include <filesystem>
#include <map>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "gsv/messages/gsv_msgs.h"
#include "gsv/presentation/edit_message.h"
#include "gsv/recording/testing/recorder_fixture.h"

namespace gsv::recording {
namespace {

using simulation::Phase;

TEST_F(SimulationRecorderTest, EqualRunsHaveTheSameContentForFastAndSlowBehaviours) {
  const std::string first = Record(0.5).content_hash;
  EXPECT_EQ(first.size(), 16u);
  EXPECT_EQ(Record(0.5, 500us).content_hash, first);
  EXPECT_NE(Record(0.4).content_hash, first);
}

TEST_F(SimulationRecorderTest, DoesNotAffectTheSimulation) {
  Record(0.5);
  auto simulation = MakeSimulation(1s, Drives(0.5));
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  EXPECT_EQ(simulation->state_hash(), hash_);
}

TEST_F(SimulationRecorderTest, EachTopicKeepsItsRateInSimulatedTime) {
  std::map<std::string, std::uint64_t> counts;
  for (const auto& channel : Record(0.5).channels) counts[channel.topic] = channel.messages;
  // The expected numbers of messages in one second, including both ends, at 50, 20, 10 and 5 Hz.
  // The sensor "back" exists from the first step on.
  EXPECT_EQ(counts["/clock"], 51u);
  EXPECT_EQ(counts["/gsv/poses"], 51u);
  EXPECT_EQ(counts["/tf"], 51u);
  EXPECT_EQ(counts["/robot/front"], 21u);
  EXPECT_EQ(counts["/robot/back"], 20u);
  EXPECT_EQ(counts["/gsv/beams"], 11u);
  EXPECT_GE(counts["/gsv/status"], 6u);  // five in the second, and one at the end
  EXPECT_EQ(counts["/gsv/state_hash"], 2u);
  EXPECT_EQ(counts["/tf_static"], 2u);
  EXPECT_EQ(counts["/gsv/events"], 2u);  // the events "started" and "finished"
  EXPECT_EQ(counts["/rosout"], 2u);      // /rosout has the same events
  EXPECT_EQ(counts["/diagnostics"], 2u);
}

TEST_F(SimulationRecorderTest, RecordsContactsWithTheirClosingSpeed) {
  Record(4.0);
  const auto contacts = Read<messages::gsv_msgs::Contact>("/gsv/contacts");
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_EQ(contacts[0].first, "robot");
  EXPECT_EQ(contacts[0].second, "wall");
  EXPECT_NEAR(contacts[0].point.x, 2.9, 1e-3);
  EXPECT_NEAR(contacts[0].normal.x, 1, 1e-9);
  EXPECT_NEAR(contacts[0].closing_speed, 4, 1e-9);
}

TEST_F(SimulationRecorderTest, RecordsRadioMessages) {
  auto simulation = simulation::Make(simulation::Lockstep(200ms));
  const auto with_radio = [](std::string name, double x, std::string says) {
    auto robot = simulation::Robot(std::move(name), x, 0);
    auto model = std::make_shared<model::Model>(*robot.model);
    model->sensors[0] = {};
    model->sensors[0].name = model->sensors[0].type = "radio";
    model->sensors[0].parameters = {{"range", 2.5}};
    robot.model = std::move(model);
    robot.behaviour = std::make_shared<ThreadBehaviour>(
        [says](simulation::Agent& agent, simulation::ClockId clock) {
          ASSERT_TRUE(agent.OpenSensor("radio"));
          if (!SleepFor(agent, clock, 50ms) || says.empty()) return;
          EXPECT_TRUE(agent.Send("radio", "", says));
        });
    return robot;
  };
  for (auto& robot : {with_radio("a", 0, "hello"), with_radio("b", -2, ""), with_radio("c", -4, ""),
                      with_radio("d", 2, "")}) {
    ASSERT_TRUE(simulation->AddRobot(robot));
  }
  auto recorder = Start(simulation);
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  ASSERT_TRUE(recorder->Stop());
  const auto said = Read<messages::gsv_msgs::Transmission>("/gsv/radio");
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said[0].sender, "a");
  EXPECT_EQ(said[0].radio, "radio");
  EXPECT_EQ(said[0].receiver, "");
  EXPECT_EQ(std::string(said[0].content.begin(), said[0].content.end()), "hello");
  EXPECT_EQ(said[0].heard_by, (std::vector<std::string>{"b", "d"}));
  // The message was sent at 50 ms and received in the next step, at 60 ms.
  EXPECT_EQ(said[0].stamp.nanosec, 60'000'000u);
}

TEST_F(SimulationRecorderTest, MetadataContainTheSettingsAndTheResult) {
  auto info = Record(0.5);
  std::map<std::string, StringMap> metadata;
  for (const MetadataRecord& record : info.metadata) metadata[record.name] = record.values;
  EXPECT_EQ(metadata["gsv.simulation"]["seed"], "7");
  EXPECT_EQ(metadata["gsv.simulation"]["mode"], "lockstep");
  EXPECT_EQ(metadata["gsv.simulation"]["step_ns"], "10000000");
  EXPECT_EQ(metadata["gsv.result"]["phase"], "finished");
  EXPECT_EQ(metadata["gsv.result"]["step"], "100");
  EXPECT_EQ(metadata["gsv.result"]["state_hash"], hash_);
  EXPECT_EQ(metadata["gsv.result"]["dropped_snapshots"], "0");
}

TEST_F(SimulationRecorderTest, AddedRobotGetsANewScene) {
  auto simulation = MakeSimulation(1s, Drives(0.5));
  auto recorder = Start(simulation);
  ASSERT_TRUE(simulation->RunUntil(500ms));
  ASSERT_EQ(simulation->WaitForPhase({Phase::kPaused}, kTimeout), Phase::kPaused);
  ASSERT_TRUE(simulation->AddRobot(Robot("second", 2, nullptr)));
  ASSERT_TRUE(simulation->Resume());
  ASSERT_EQ(simulation->WaitForPhase({Phase::kFinished}, kTimeout), Phase::kFinished);
  ASSERT_TRUE(recorder->Stop());
  const auto poses = Read<messages::gsv_msgs::Poses>("/gsv/poses");
  EXPECT_EQ(poses.front().poses.size(), 7u);
  EXPECT_EQ(poses.back().poses.size(), 14u);
  const auto scenes = Attachments("scene.json");
  const nlohmann::json last = Scene(scenes.back());
  EXPECT_EQ(last["layout_version"], poses.back().layout_version);
  EXPECT_EQ(last["bodies"].size(), 3u);
  EXPECT_EQ(scenes.back().log_time, 510ms);  // the first step with the robot that was added
}

// `gsv replay --resimulate --commands` repeats the recorded commands. If a robot is removed and
// added again, the recorder must not record a command of the removed robot for the new one.
TEST_F(SimulationRecorderTest, RobotThatIsAddedAgainStartsWithoutACommand) {
  auto simulation = MakeSimulation(1s, Drives(0.5));
  auto recorder = Start(simulation);
  ASSERT_TRUE(simulation->RunUntil(500ms));
  ASSERT_EQ(simulation->WaitForPhase({Phase::kPaused}, kTimeout), Phase::kPaused);
  ASSERT_TRUE(simulation->RemoveRobot("robot"));
  ASSERT_TRUE(simulation->AddRobot(Robot("robot", 2, nullptr)));
  ASSERT_TRUE(simulation->Resume());
  ASSERT_EQ(simulation->WaitForPhase({Phase::kFinished}, kTimeout), Phase::kFinished);
  ASSERT_TRUE(recorder->Stop());
  const auto commands = Read<messages::gsv_msgs::Command>("/gsv/commands");
  EXPECT_EQ(commands.size(), 10u);  // one command every 50 ms, until the robot was removed
  for (const auto& command : commands) EXPECT_EQ(command.linear_m_s, 0.5);
}

TEST_F(SimulationRecorderTest, RecordsEditsFromBeforeItsStart) {
  const auto make = [] { return MakeSimulation(100ms, Drives(0.5)); };
  auto simulation = make();
  simulation::ObjectSpecification object;
  object.name = "second";
  object.copy_of = "wall";
  object.world_from_object = geometry::PlanarPose(-3, 0, 0, 0);
  ASSERT_TRUE(simulation->AddObject(object));
  auto recorder = Start(simulation);
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  ASSERT_TRUE(recorder->Stop());
  const auto edits = Read<messages::gsv_msgs::Edit>("/gsv/edits");
  // The scenario already includes the added robot, so only the other edit is recorded.
  ASSERT_EQ(edits.size(), 1u);
  const auto edit = presentation::EditFrom(edits[0]);
  ASSERT_TRUE(edit);
  EXPECT_EQ(edit->time, base::SimTime(0));
  simulation::ObjectSpecification repeated;
  repeated.name = edit->body;
  repeated.copy_of = edit->copy_of;
  repeated.world_from_object = edit->world_from_body;
  repeated.on_ground = edit->on_ground;
  auto again = make();
  ASSERT_TRUE(again->AddObject(repeated));
  ASSERT_EQ(RunToEnd(*again), Phase::kFinished);
  EXPECT_EQ(again->state_hash(), simulation->state_hash());
  auto unedited = make();
  ASSERT_EQ(RunToEnd(*unedited), Phase::kFinished);
  EXPECT_NE(unedited->state_hash(), simulation->state_hash());
}

TEST_F(SimulationRecorderTest, FullDiskEndsOnlyTheRecording) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full";
  auto simulation = MakeSimulation(1s, Drives(0.5));
  auto recorder = SimulationRecorder::Start(simulation, "/dev/full", NamingOptions());
  ASSERT_TRUE(recorder) << recorder.error().Sentence();
  EXPECT_EQ(RunToEnd(*simulation), Phase::kFinished);
  EXPECT_EQ(simulation->status().step, 100);
  const base::Status stopped = (*recorder)->Stop();
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().code, base::ErrorCode::kUnavailable);
  EXPECT_NE(stopped.error().Sentence().find("No space left on device"), std::string::npos)
      << stopped.error().Sentence();
  EXPECT_FALSE((*recorder)->is_recording());
}

TEST_F(SimulationRecorderTest, ExistingFileIsReplacedOnlyIfRequested) {
  Record(0.5);
  RecorderOptions options = NamingOptions();
  options.replace = false;
  const auto recorder = SimulationRecorder::Start(MakeSimulation(1s, nullptr), path_, options);
  ASSERT_FALSE(recorder);
  EXPECT_EQ(recorder.error().code, base::ErrorCode::kInvalidArgument);
}

TEST_F(SimulationRecorderTest, AResetEndsTheRecording) {
  auto simulation = MakeSimulation(200ms, Drives(0.5));
  auto recorder = Start(simulation);
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  ASSERT_TRUE(simulation->Reset());
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  ASSERT_TRUE(recorder->Stop());
  const auto poses = Read<messages::gsv_msgs::Poses>("/gsv/poses");
  ASSERT_GE(poses.size(), 10u);
  for (std::size_t i = 1; i < poses.size(); ++i) EXPECT_GT(poses[i].step, poses[i - 1].step);
  EXPECT_EQ(Read<messages::gsv_msgs::LifecycleEvent>("/gsv/events").back().event, "finished");
}

TEST_F(SimulationRecorderTest, DestroyedSimulationLeavesACompleteFile) {
  auto simulation = MakeSimulation(200ms, Drives(0.5));
  auto recorder = Start(simulation);
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  simulation.reset();
  ASSERT_TRUE(recorder->Stop());
  const RecordingInfo info = Info();
  EXPECT_TRUE(info.indexed);
  EXPECT_EQ(info.end, 200ms);
}

// Reports one expectation of a scenario. Its verdict becomes "violated" at 0.33 s.
class ViolatedOnce final : public simulation::ExpectationSource {
 public:
  explicit ViolatedOnce(std::weak_ptr<simulation::Simulation> simulation)
      : simulation_(std::move(simulation)) {}
  std::vector<simulation::ExpectationState> states() const override {
    using Verdict = simulation::ExpectationState::Verdict;
    simulation::ExpectationState state;
    state.name = "stays";
    const auto simulation = simulation_.lock();
    if (simulation && simulation->snapshot()->state.time >= 330ms) {
      state.verdict = Verdict::kViolated;
      state.time = 330ms;
    }
    return {state};
  }

 private:
  const std::weak_ptr<simulation::Simulation> simulation_;
};

TEST_F(SimulationRecorderTest, AVerdictIsRecordedAtItsInstant) {
  auto simulation = MakeSimulation(1s, Drives(0.5));
  const auto expectations = std::make_shared<ViolatedOnce>(simulation);
  simulation->SetExpectations(expectations);
  auto recorder = Start(simulation);
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  ASSERT_TRUE(recorder->Stop());
  const auto messages = Read<messages::gsv_msgs::Expectations>("/gsv/expectations");
  ASSERT_GE(messages.size(), 2u);
  EXPECT_EQ(messages[0].expectations[0].state, "pending");
  EXPECT_EQ(messages[1].expectations[0].state, "violated");
  EXPECT_EQ(messages[1].stamp.sec, 0);
  EXPECT_EQ(messages[1].stamp.nanosec, 330'000'000u);
}

}  // namespace
}  // namespace gsv::recording
