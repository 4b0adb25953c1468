// Tests crash reports: the next server reports the simulations of a killed server. Uses the real
// program.
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <optional>
#include <thread>

#include <gtest/gtest.h>

#include "gsv/base/text_file.h"
#include "gsv/gateway/testing/web_client.h"
#include "tests/support/programs.h"

namespace gsv::testing {
namespace {

using gateway::testing::HttpReply;
using nlohmann::json;
namespace fs = std::filesystem;

class CrashReports : public ::testing::Test {
 public:
  CrashReports() {
    setenv("XDG_STATE_HOME", (folder_.path() / "state").c_str(), 1);
    setenv("XDG_RUNTIME_DIR", folder_.path().c_str(), 1);
    for (const char* name : {"recordings", "elsewhere"})
      fs::create_directory(folder_.path() / name);
  }
  ~CrashReports() override { server_.reset(); }

 protected:
  // Starts a server with the recordings in that folder.
  void Serve(const std::string& folder = "recordings") {
    server_.emplace(
        "gsv", std::vector<std::string>{"serve", "--port", "0", "--name", "lab", "--recordings",
                                        (folder_.path() / folder).string()});
    const std::string line = server_->AwaitLine("viewer: ");
    port_ = static_cast<std::uint16_t>(std::stoi(line.substr(line.rfind(':') + 1)));
    (void)server_->AwaitLine("broker: ");
  }
  std::string Kill() {
    server_->process().Signal(SIGKILL);
    return server_->AwaitEnd().err;
  }
  // Ends the server and returns its log.
  std::string End() {
    server_->process().Signal(SIGTERM);
    return server_->AwaitEnd().err;
  }

  HttpReply Ask(const std::string& method, const std::string& path,
                const std::string& body = "") const {
    return gateway::testing::Fetch(port_, method, path, "", body);
  }
  json Get(const std::string& path) const { return json::parse(Ask("GET", path).body); }
  json LostReports() const { return Get("/api/lost")["lost"]; }
  void Create(const std::string& name) const {
    const json scenario = {{"name", name},
                           {"world", "playground"},
                           {"robots", {{{"model", "pebble"}, {"x", 0}, {"y", -1.5}}}}};
    ASSERT_EQ(Ask("POST", "/api/simulations", scenario.dump()).status, 201);
  }
  fs::path notes() const { return folder_.path() / "state/gsv/servers"; }
  // A server describes its simulations in a file, its note. Waits until a note fulfils the
  // condition.
  template <typename Condition>
  void AwaitNoted(Condition holds) const {
    const auto give_up = std::chrono::steady_clock::now() + kProgramTimeout;
    while (std::chrono::steady_clock::now() < give_up) {
      std::error_code error;
      for (const auto& entry : fs::directory_iterator(notes(), error)) {
        const json note = json::parse(base::ReadTextFile(entry.path()), nullptr, false);
        if (entry.path().extension() == ".json" && note.is_object() && holds(note)) return;
      }
      std::this_thread::yield();
    }
    FAIL() << "that was never noted";
  }
  // Waits until some messages are on disk. A recording that has just begun may have none.
  static void AwaitMessagesIn(const std::string& recording) {
    const auto give_up = std::chrono::steady_clock::now() + kProgramTimeout;
    while (std::chrono::steady_clock::now() < give_up) {
      const Outcome info = RunProgram("gsv", {"rec", "info", "--json", recording});
      const json told = json::parse(info.out, nullptr, false);
      if (told.is_object() && told["messages"] > 0) return;
    }
    FAIL() << "nothing was recorded";
  }
  static const json* Find(const json& note, const std::string& name) {
    for (const json& each : note["simulations"]) {
      if (each["name"] == name) return &each;
    }
    return nullptr;
  }

  const base::testing::TestFolder folder_{};
  std::optional<Running> server_;
  std::uint16_t port_ = 0;
};

TEST_F(CrashReports, NextServerReportsTheRunsOfAKilledOneUntilDismissed) {
  Serve();
  const std::string pid = std::to_string(server_->process().pid());
  EXPECT_TRUE(LostReports().empty());
  Create("arena");
  Create("maze");
  ASSERT_EQ(Ask("POST", "/api/simulations/arena/start", "{}").status, 200);
  const HttpReply recording =
      Ask("POST", "/api/simulations/arena/recording", R"({"record": true})");
  const std::string file = json::parse(recording.body)["path"];
  AwaitNoted([&](const json& note) {
    const json* arena = Find(note, "arena");
    return arena != nullptr && Find(note, "maze") != nullptr && (*arena)["time_s"] > 2 &&
           (*arena)["recording"] == fs::absolute(file).string();
  });
  AwaitMessagesIn(file);
  Kill();
  // Imitates a server that was killed while it wrote its note.
  ASSERT_EQ(std::distance(fs::directory_iterator(notes()), {}), 1);
  const fs::path note = fs::directory_iterator(notes())->path();
  std::ofstream(note.string() + "." + pid + ".draft") << "{";

  // `gsv ps` runs before the next server starts.
  const Outcome ps = RunProgram("gsv", {"ps"});
  EXPECT_NE(ps.out.find("arena on lab (process " + pid + ") was lost at about"), std::string::npos)
      << ps.out;

  Serve();
  EXPECT_TRUE(Get("/api/simulations").empty());
  json lost = LostReports();
  ASSERT_EQ(lost.size(), 2u);
  EXPECT_EQ(lost[0]["name"], "arena");
  EXPECT_EQ(lost[0]["phase"], "lost");
  EXPECT_EQ(lost[0]["last_phase"], "running");
  EXPECT_GT(lost[0]["time_s"], 2);
  EXPECT_EQ(lost[0]["replay"], fs::path(file).filename().string());
  EXPECT_EQ(lost[1]["name"], "maze");
  EXPECT_EQ(lost[1]["recording"], "");
  while (!lost[0].contains("whole_until_s")) lost = LostReports();  // waits for the server
  const std::string mended = folder_.path() / "mended.mcap";
  ASSERT_EQ(RunProgram("gsv", {"rec", "recover", file, "-o", mended}).ending, "exit code 0");
  const json info = json::parse(RunProgram("gsv", {"rec", "info", "--json", mended}).out);
  EXPECT_NEAR(lost[0]["whole_until_s"].get<double>(), info["end_s"].get<double>(), 1e-9);

  EXPECT_EQ(Ask("DELETE", "/api/lost/" + lost[0]["number"].dump()).status, 200);
  EXPECT_EQ(Ask("DELETE", "/api/lost/" + lost[0]["number"].dump()).status, 404);
  ASSERT_EQ(LostReports().size(), 1u);
  // A report that nobody has dismissed must survive the next crash as well.
  AwaitNoted([&](const json& noted) { return noted["lost"].size() == 1; });
  Kill();
  Serve();
  ASSERT_EQ(LostReports().size(), 1u);
  EXPECT_EQ(LostReports()[0]["name"], "maze");
  // The log of the server contains the report. The regular end of the server removes the report.
  EXPECT_NE(End().find("maze on lab (process " + pid + ") was lost at about"), std::string::npos);
  EXPECT_TRUE(fs::is_empty(notes()));
  Serve();
  EXPECT_TRUE(LostReports().empty());
}

TEST_F(CrashReports, ServerReportsOnlyRunsOfItsOwnFolder) {
  Serve("elsewhere");
  Create("arena");
  AwaitNoted([&](const json& note) { return Find(note, "arena") != nullptr; });
  Kill();
  Serve("recordings");
  EXPECT_TRUE(LostReports().empty());
  End();
  Serve("elsewhere");
  EXPECT_EQ(LostReports().size(), 1u);
}

TEST_F(CrashReports, CleanShutdownLeavesNoReport) {
  Serve();
  Create("arena");
  AwaitNoted([&](const json& note) { return Find(note, "arena") != nullptr; });
  End();
  EXPECT_TRUE(fs::is_empty(notes()));
  EXPECT_EQ(RunProgram("gsv", {"ps"}).out, "");
}

// A note may be damaged by a power failure or a malicious user.
TEST_F(CrashReports, InvalidNotesAreReportedAndTheServerStarts) {
  Serve();
  Create("arena");
  AwaitNoted([&](const json& note) { return Find(note, "arena") != nullptr; });
  Kill();
  std::string note;
  for (const auto& entry : fs::directory_iterator(notes())) {
    if (entry.path().extension() == ".json") std::getline(std::ifstream(entry.path()), note);
  }
  const json whole = json::parse(note);
  std::vector<json> wrong(4, whole);
  wrong[0]["simulations"][0]["time_s"] = 1e300;
  wrong[1]["simulations"] = std::vector<int>(20'000, 1);
  wrong[2]["lost"] = "none";
  wrong[3].erase("recordings");
  std::vector<std::string> texts{"", "[]", note.substr(0, note.size() / 2),
                                 std::string(9 << 20, '[')};
  for (const json& each : wrong) texts.push_back(each.dump());
  for (std::size_t i = 0; i < texts.size(); ++i) {
    std::ofstream(notes() / ("bad" + std::to_string(i) + ".json")) << texts[i];
  }
  fs::create_symlink("/dev/zero", notes() / "endless.json");
  Serve();
  EXPECT_EQ(LostReports().size(), 1u);
  const std::string log = End();
  for (const char* name :
       {"bad0", "bad1", "bad2", "bad3", "bad4", "bad5", "bad6", "bad7", "endless"}) {
    EXPECT_NE(log.find(std::string(name) + ".json: the file is not a note of a server"),
              std::string::npos)
        << name << log;
  }
  EXPECT_TRUE(fs::is_empty(notes()));
}

TEST_F(CrashReports, MissingFolderForNotesIsReportedAndTheServerStarts) {
  setenv("XDG_STATE_HOME", "/dev/null", 1);
  Serve();
  Create("arena");
  EXPECT_TRUE(LostReports().empty());
  EXPECT_NE(End().find("cannot write crash reports for this server"), std::string::npos);
}

}  // namespace
}  // namespace gsv::testing
