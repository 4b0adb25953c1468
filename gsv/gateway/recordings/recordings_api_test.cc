#include "gsv/gateway/recordings/recordings_api.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "gsv/gateway/gateway.h"
#include "gsv/gateway/testing/replay_fixture.h"

namespace gsv::gateway::recordings {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HttpReply;
using testing::Viewer;

// A server without a simulation, for a folder with one recording of two seconds.
class RecordingsApiTest : public ::testing::Test {
 protected:
  class NoSimulations final : public SimulationDirectory {
   public:
    std::vector<std::shared_ptr<simulation::Simulation>> List() override { return {}; }
    std::shared_ptr<simulation::Simulation> Find(const std::string&) override { return nullptr; }
  };

  void SetUp() override {
    fs::create_directory(folder_);
    testing::RecordRun(folder_ / "run.mcap");
    GatewayOptions options;
    options.recordings_folder = folder_;
    auto started = Gateway::Start(options, std::make_shared<NoSimulations>());
    ASSERT_TRUE(started) << started.error().Sentence();
    gateway_ = *std::move(started);
  }
  void TearDown() override {
    gateway_.reset();
    fs::remove_all(folder_);
  }

  HttpReply Get(const std::string& target) const {
    return testing::Fetch(gateway_->port(), "GET", target);
  }
  HttpReply Post(const std::string& target, const std::string& body = "{}") const {
    return testing::Fetch(gateway_->port(), "POST", target, "", body);
  }
  // Opens a replay. Returns the path below which the session is served: "/replays/1/".
  std::string OpenReplay() const {
    return "/" +
           json::parse(Post("/api/recordings/run.mcap/replay").body)["base"].get<std::string>();
  }
  static double TimeOf(const HttpReply& reply) { return json::parse(reply.body)["time_s"]; }

  const fs::path folder_ =
      fs::path(::testing::TempDir()) / ("gsv_recordings_api_" + std::to_string(getpid()));
  std::unique_ptr<Gateway> gateway_;
};

TEST_F(RecordingsApiTest, ListsTheRecordingsOfTheFolder) {
  std::ofstream(folder_ / "junk.mcap") << "not a recording, but longer than eight bytes";
  std::ofstream(folder_ / "notes.txt") << "no recording by its name";
  std::ofstream(folder_ / ".hidden.mcap") << "hidden";
  fs::create_symlink("/etc/hostname", folder_ / "elsewhere.mcap");
  fs::create_directory(folder_ / "folder");
  const json answer = json::parse(Get("/api/recordings").body);
  EXPECT_EQ(answer["folder"], folder_.string());
  ASSERT_EQ(answer["recordings"].size(), 2u) << answer;
  std::map<std::string, json> lines;
  for (const json& line : answer["recordings"]) lines[line["name"]] = line;
  EXPECT_EQ(lines["junk.mcap"]["state"], "unfinished");
  const json& run = lines["run.mcap"];
  EXPECT_EQ(run["state"], "complete");
  EXPECT_EQ(run["duration_s"], 2.0);
  EXPECT_EQ(run["size_bytes"], fs::file_size(folder_ / "run.mcap"));
  EXPECT_EQ(run["modified"].get<std::string>().size(), std::string("2026-01-31T23:59:59Z").size());
  EXPECT_EQ(json::parse(Get("/api/server").body)["recordings"], true);
}

TEST_F(RecordingsApiTest, ADamagedFileIsReported) {
  // The file ends with the magic bytes of a recording, but is not a recording.
  std::ofstream(folder_ / "bad.mcap") << "XXXXXXXXXXXXXXXXXXXXXXXXXXXXXXXXXXXXXXXX\x89MCAP0\r\n";
  const json listed = json::parse(Get("/api/recordings").body)["recordings"];
  const auto bad = std::find_if(listed.begin(), listed.end(),
                                [](const json& line) { return line["name"] == "bad.mcap"; });
  ASSERT_NE(bad, listed.end());
  EXPECT_EQ((*bad)["state"], "unreadable");
  EXPECT_NE((*bad)["problem"], "");
  EXPECT_EQ(Post("/api/recordings/bad.mcap/replay").status, 400);
}

TEST_F(RecordingsApiTest, NothingOutsideOfTheFolderIsOpened) {
  for (const char* name : {"gone.mcap", "..", ".", "%2e%2e%2frun.mcap", "..%2frun.mcap",
                           "%2fetc%2fhostname", "run.mcap%00", "%2frun.mcap", ""}) {
    const HttpReply reply = Post("/api/recordings/" + std::string(name) + "/replay");
    EXPECT_EQ(reply.status, 404) << name;
  }
  fs::create_symlink("/etc/hostname", folder_ / "link.mcap");
  EXPECT_EQ(Post("/api/recordings/link.mcap/replay").status, 404);
  EXPECT_NE(Post("/api/recordings/gone.mcap/replay").body.find("open the list"), std::string::npos);
}

TEST_F(RecordingsApiTest, FailuresOfTestsAreListedWithWorldAndRobots) {
  fs::create_directories(folder_ / "gsv-failures" / "turns");
  fs::copy_file(folder_ / "run.mcap", folder_ / "gsv-failures" / "turns" / "run.mcap");
  fs::create_directory_symlink("turns", folder_ / "gsv-failures" / "elsewhere");
  std::map<std::string, json> lines;
  const json answer = json::parse(Get("/api/recordings").body);
  for (const json& line : answer["recordings"]) lines[line["name"]] = line;
  ASSERT_EQ(lines.size(), 2u);
  const json& failure = lines["gsv-failures/turns"];
  EXPECT_EQ(failure["state"], "complete");
  EXPECT_EQ(failure["world"], lines["run.mcap"]["world"]);
  EXPECT_GE(failure["robots"], 1) << failure;
  EXPECT_EQ(Post("/api/recordings/gsv-failures%2Fturns/replay").status,
            Post("/api/recordings/run.mcap/replay").status);
  for (const char* name : {"gsv-failures%2Felsewhere", "gsv-failures%2F..", "gsv-failures%2F",
                           "gsv-failures%2Fturns%2Frun.mcap", "turns%2Frun.mcap"}) {
    EXPECT_EQ(Post("/api/recordings/" + std::string(name) + "/replay").status, 404) << name;
  }
}

TEST_F(RecordingsApiTest, TwoViewersReplayOneRecordingIndependently) {
  const std::string a = OpenReplay();
  const std::string b = OpenReplay();
  ASSERT_NE(a, b);
  EXPECT_EQ(TimeOf(Post(a + "api/simulations/simulation/seek", R"({"time_s": 1.5})")), 1.5);
  EXPECT_EQ(TimeOf(Get(b + "api/simulations/simulation")), 0);
  Viewer viewer(gateway_->port(), a + "ws");
  viewer.Subscribe(1, "/gsv/poses");
  EXPECT_EQ(testing::Decoded<messages::gsv_msgs::Poses>(viewer.ReceiveData(1)).step, 150u);
  EXPECT_EQ(json::parse(Get(a + "api/server").body)["recording"], "run.mcap");
  EXPECT_EQ(Get(a + "index.html").status, 404);
  EXPECT_EQ(Get("/replays/99/api/simulations").status, 404);
  EXPECT_THROW(Viewer(gateway_->port(), "/replays/99/ws"), std::runtime_error);
}

TEST_F(RecordingsApiTest, ARelayForwardsRecordings) {
  auto relay = Gateway::StartRelay({}, {gateway_->url()});
  ASSERT_TRUE(relay) << relay.error().Sentence();
  const std::uint16_t port = (*relay)->port();
  const HttpReply opened =
      testing::Fetch(port, "POST", "/api/recordings/run.mcap/replay", "", "{}");
  ASSERT_EQ(opened.status, 201) << opened.body;
  const std::string base = "/" + json::parse(opened.body)["base"].get<std::string>();
  Viewer viewer(port, base + "ws");
  viewer.Subscribe(1, "/gsv/poses");
  EXPECT_EQ(testing::Decoded<messages::gsv_msgs::Poses>(viewer.ReceiveData(1)).step, 0u);
  const HttpReply moved = testing::Fetch(port, "POST", base + "api/simulations/simulation/seek", "",
                                         R"({"time_s": 1})");
  EXPECT_EQ(TimeOf(moved), 1);
  EXPECT_EQ(testing::Decoded<messages::gsv_msgs::Poses>(viewer.ReceiveData(1)).step, 100u);
}

TEST_F(RecordingsApiTest, AReplayWithoutViewersEnds) {
  ReplaySessions sessions({.sessions = 2, .unwatched = std::chrono::milliseconds(0)});
  const std::string file = folder_ / "run.mcap";
  const std::string watched = sessions.Open(file, "run.mcap").value();
  auto hub = sessions.FindHub(watched).value();
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(sessions.Open(file, "run.mcap")) << i;
  EXPECT_TRUE(sessions.FindHub(watched));
  sessions.Stop();
  EXPECT_FALSE(sessions.Open(file, "run.mcap"));
  // A viewer may disconnect after Stop(). The hub keeps the replay alive until then.
  hub->Remove(nullptr);
}

TEST_F(RecordingsApiTest, ReplaySessionsAreLimited) {
  ReplaySessions sessions({.sessions = 2, .unwatched = std::chrono::hours(1)});
  const std::string file = folder_ / "run.mcap";
  EXPECT_TRUE(sessions.Open(file, "run.mcap"));
  EXPECT_TRUE(sessions.Open(file, "run.mcap"));
  const auto refused = sessions.Open(file, "run.mcap");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, base::ErrorCode::kUnavailable);
}

TEST_F(RecordingsApiTest, StoresNotesBesideTheRecording) {
  const std::string notes = "/api/recordings/run.mcap/notes";
  EXPECT_EQ(Get(notes).body, "[]");
  EXPECT_EQ(Post(notes, R"({"text": "no instant"})").status, 400);
  const HttpReply added = Post(notes, R"({"text": "turns here", "time_s": 1.5, "author": "Ada"})");
  ASSERT_EQ(added.status, 201) << added.body;
  const std::string id = std::to_string(json::parse(added.body)["id"].get<int>());
  EXPECT_TRUE(fs::exists(folder_ / "run.mcap.notes.json"));
  const json listed = json::parse(Get(notes).body);
  ASSERT_EQ(listed.size(), 1u);
  EXPECT_EQ(listed[0]["text"], "Ada: turns here");
  EXPECT_EQ(listed[0]["time_s"], 1.5);
  EXPECT_EQ(testing::Fetch(gateway_->port(), "DELETE", notes + "/" + id).status, 200);
  EXPECT_EQ(testing::Fetch(gateway_->port(), "DELETE", notes + "/" + id).status, 404);
  EXPECT_EQ(testing::Fetch(gateway_->port(), "DELETE", notes + "/x").status, 404);
  EXPECT_EQ(Get("/api/recordings/gone.mcap/notes").status, 404);
  // The file with the notes is not listed as a recording.
  EXPECT_EQ(json::parse(Get("/api/recordings").body)["recordings"].size(), 1u);
}

TEST_F(RecordingsApiTest, ComparesTwoRecordings) {
  fs::copy_file(folder_ / "run.mcap", folder_ / "same.mcap");
  testing::RecordRun(folder_ / "slow.mcap", 0.25);
  const std::string difference = "/api/recordings/run.mcap/difference";
  EXPECT_EQ(json::parse(Get(difference + "?with=same.mcap").body)["equal"], true);
  const json found = json::parse(Get(difference + "?with=slow.mcap").body);
  EXPECT_EQ(found["equal"], false);
  EXPECT_EQ(found["robot"], "robot");
  // In both recordings, the robot is at rest at 0 s; the first commands differ in the first steps.
  EXPECT_LT(found["time_s"], 0.1);
  EXPECT_NE(found["text"], "");
  EXPECT_EQ(Get(difference).status, 400);
  EXPECT_EQ(Get(difference + "?with=gone.mcap").status, 404);
}

}  // namespace
}  // namespace gsv::gateway::recordings
