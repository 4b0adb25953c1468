#include "apps/gsv/lost/server_note.h"

#include <unistd.h>

#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "gsv/base/test_folder.h"
#include "gsv/base/text_file.h"

namespace gsv::app {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

LostSimulation Arena() {
  LostSimulation lost{"arena", "maze.sdf", "running", 12.34, 1'700'000'000, "/r/x.mcap"};
  lost.server = "gsv (process 123)";
  return lost;
}

class ServerNoteTest : public ::testing::Test {
 protected:
  // Returns the note in the folder after `change` has changed its JSON.
  NotesFound Changed(const std::function<void(nlohmann::json&)>& change) const {
    ServerNote note;
    note.simulations = {Arena()};
    const auto file = folder_.path() / "1-1.json";
    EXPECT_TRUE(WriteNote(file, note));
    auto json = nlohmann::json::parse(base::ReadTextFile(file));
    change(json);
    folder_.Write("1-1.json", json.dump());
    return ReadNotes(folder_.path());
  }

  const base::testing::TestFolder folder_{};
};

TEST_F(ServerNoteTest, ReadsBackWhatWasWritten) {
  ServerNote note = NewNote();
  note.server = "caf\xe9";  // invalid UTF-8
  note.broker = "IOR:01";
  note.recordings = "/r";
  note.simulations = {Arena()};
  note.lost = {Arena()};
  note.lost[0].whole_until_s = 11.9;
  const auto file = NoteFile(folder_.path(), note);
  EXPECT_EQ(file.filename(),
            std::to_string(getpid()) + "-" + std::to_string(note.started) + ".json");
  ASSERT_TRUE(WriteNote(file, note));
  const NotesFound found = ReadNotes(folder_.path());
  EXPECT_THAT(found.problems, IsEmpty());
  ASSERT_THAT(found.notes, SizeIs(1));
  const ServerNote& read = found.notes[0].note;
  EXPECT_EQ(read.pid, getpid());
  EXPECT_EQ(read.started, note.started);
  EXPECT_EQ(read.boot, note.boot);
  EXPECT_EQ(read.server, "caf\ufffd");
  EXPECT_EQ(read.broker, "IOR:01");
  ASSERT_THAT(read.simulations, SizeIs(1));
  EXPECT_EQ(Describe(read.simulations[0]), Describe(Arena()));
  ASSERT_THAT(read.lost, SizeIs(1));
  EXPECT_EQ(read.lost[0].whole_until_s, 11.9);
}

TEST_F(ServerNoteTest, ProcessRunsUnlessPidOrBootWasReused) {
  ServerNote note = NewNote();
  EXPECT_TRUE(IsProcessRunning(note));
  ++note.started;  // as if another process with this pid had written the note
  EXPECT_FALSE(IsProcessRunning(note));
  note = NewNote();
  note.boot = "before";
  EXPECT_FALSE(IsProcessRunning(note));
  note.host = "elsewhere";
  EXPECT_TRUE(IsProcessRunning(note)) << "nobody here can tell";
}

TEST_F(ServerNoteTest, InvalidFileIsReportedAndRenamedAsBroken) {
  for (const char* text : {"", "{", "[]", "{\"pid\": 1}", "null"}) {
    const auto file = folder_.Write("7-7.json", text);
    const NotesFound found = ReadNotes(folder_.path());
    EXPECT_THAT(found.notes, IsEmpty()) << text;
    EXPECT_THAT(found.problems, SizeIs(1)) << text;
    EXPECT_THAT(found.broken, ElementsAre(file)) << text;
  }
}

TEST_F(ServerNoteTest, EveryFieldMustHaveItsType) {
  EXPECT_THAT(Changed([](auto&) {}).notes, SizeIs(1));
  for (const char* key : {"pid", "started", "boot", "host", "server", "broker", "recordings",
                          "simulations", "lost"}) {
    EXPECT_THAT(Changed([&](auto& json) { json.erase(key); }).notes, IsEmpty()) << key;
    EXPECT_THAT(Changed([&](auto& json) { json[key] = -1; }).notes, IsEmpty()) << key;
  }
  for (const char* key : {"name", "world", "phase", "time_s", "noted", "recording", "server"}) {
    EXPECT_THAT(Changed([&](auto& json) { json["simulations"][0][key] = {}; }).notes, IsEmpty())
        << key;
  }
  EXPECT_THAT(Changed([](auto& json) { json["simulations"][0]["time_s"] = 1e300; }).notes,
              IsEmpty());
}

TEST_F(ServerNoteTest, LeavesOtherFilesAndFoldersUnchanged) {
  folder_.Write("1-1.json.draft", "{");
  folder_.Write("README", "x");
  const NotesFound found = ReadNotes(folder_.path());
  EXPECT_THAT(found.notes, IsEmpty());
  EXPECT_THAT(found.problems, IsEmpty());
  EXPECT_THAT(ReadNotes(folder_.path() / "none").problems, IsEmpty());
}

TEST(CrashReportSentence, NamesTheRecordingAndItsEndTime) {
  LostSimulation lost = Arena();
  const std::string begin =
      "arena on gsv (process 123) was lost at about 12.3 s (running), when its server was killed; ";
  EXPECT_EQ(Sentence(lost), begin + "recording /r/x.mcap");
  lost.whole_until_s = 11.94;
  EXPECT_EQ(Sentence(lost), begin + "recording /r/x.mcap, complete until 11.9 s");
  EXPECT_EQ(Describe(lost)["whole_until_s"], 11.94);
  lost.recording.clear();
  EXPECT_EQ(Sentence(lost), begin + "it was not recorded");
}

}  // namespace
}  // namespace gsv::app
