#include "gsv/gateway/recordings/note_file.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "gsv/base/temporary_folder.h"

namespace gsv::gateway::recordings {
namespace {

class NoteFileTest : public ::testing::Test {
 protected:
  void WriteText(const std::string& text) const { std::ofstream(path_ + ".notes.json") << text; }

  base::TemporaryFolder folder_ = base::TemporaryFolder::Make("gsv-notes-").value();
  const std::string path_ = (folder_.path() / "run.mcap").string();
  const NoteFile file_{path_};
};

TEST_F(NoteFileTest, WithoutAFileThereAreNoNotes) { EXPECT_TRUE(file_.Read().value().empty()); }

TEST_F(NoteFileTest, SortsNotesByTime) {
  EXPECT_EQ(file_.Add(2.5, "later\n\"quoted\"", "2026-01-31T12:00:00Z").value(), 1);
  EXPECT_EQ(file_.Add(1, "earlier", "2026-01-31T12:00:01Z").value(), 2);
  const auto notes = NoteFile(path_).Read().value();
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_EQ(notes[0].text, "earlier");
  EXPECT_EQ(notes[1].text, "later\n\"quoted\"");
  EXPECT_EQ(notes[1].time_s, 2.5);
  EXPECT_EQ(notes[1].created, "2026-01-31T12:00:00Z");
  EXPECT_FALSE(std::filesystem::exists(path_ + ".notes.json.new"));
}

TEST_F(NoteFileTest, RemovesANoteOnce) {
  ASSERT_TRUE(file_.Add(1, "a", ""));
  ASSERT_TRUE(file_.Add(2, "b", ""));
  EXPECT_TRUE(file_.Remove(1));
  EXPECT_EQ(file_.Remove(1).error().code, base::ErrorCode::kNotFound);
  ASSERT_EQ(file_.Read().value().size(), 1u);
  EXPECT_EQ(file_.Read().value()[0].text, "b");
}

TEST_F(NoteFileTest, InvalidFilesAreReportedAndKept) {
  for (const char* text :
       {"", "[]", "{\"version\": 1}", "{\"version\": 2, \"notes\": []}",
        "{\"version\": 1, \"notes\": [{\"id\": 0, \"time_s\": 1}]}",
        "{\"version\": 1, \"notes\": [{\"id\": 1}]}", "{\"version\": 1, \"notes\": [3]}"}) {
    WriteText(text);
    const auto notes = file_.Read();
    ASSERT_FALSE(notes) << text;
    EXPECT_EQ(notes.error().code, base::ErrorCode::kCorrupt);
    EXPECT_FALSE(file_.Add(1, "x", ""));
    std::ifstream kept(path_ + ".notes.json");
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(kept), {}), text);
  }
}

TEST_F(NoteFileTest, HoldsAtMostAThousandNotes) {
  std::string text = "{\"version\": 1, \"notes\": [{\"id\": 1, \"time_s\": 1}";
  for (int i = 2; i <= 1000; ++i) text += ",{\"id\": " + std::to_string(i) + ", \"time_s\": 1}";
  WriteText(text + "]}");
  EXPECT_EQ(file_.Read().value().size(), 1000u);
  EXPECT_EQ(file_.Add(1, "one more", "").error().code, base::ErrorCode::kInvalidArgument);
}

TEST_F(NoteFileTest, RefusesANoteThatMakesTheFileTooLongToRead) {
  // JSON writes each of these characters as 6 bytes. So 170 texts take 4,177,920 bytes, and 171 texts
  // take 4,202,496 bytes, which is more than 4 MiB (4,194,304 bytes).
  const std::string text(4096, '\x01');
  nlohmann::json notes = nlohmann::json::array();
  for (int i = 1; i <= 170; ++i) notes.push_back({{"id", i}, {"time_s", 1}, {"text", text}});
  WriteText(nlohmann::json{{"version", 1}, {"notes", notes}}.dump());
  EXPECT_EQ(file_.Add(1, text, "").error().code, base::ErrorCode::kInvalidArgument);
  EXPECT_EQ(file_.Read().value().size(), 170u);
  EXPECT_TRUE(file_.Remove(1));
  EXPECT_TRUE(file_.Add(1, "short", ""));
  EXPECT_EQ(file_.Read().value().size(), 170u);
}

TEST_F(NoteFileTest, RefusesASymbolicLink) {
  std::filesystem::create_symlink("/etc/hostname", path_ + ".notes.json");
  EXPECT_EQ(file_.Read().error().code, base::ErrorCode::kCorrupt);
}

}  // namespace
}  // namespace gsv::gateway::recordings
