// Tests images and films of recordings, made by `gsv snapshot` and `gsv film`.
#include <filesystem>
#include <fstream>
#include <iterator>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/programs.h"

namespace gsv::testing {
namespace {

using ::testing::HasSubstr;
using Strings = std::vector<std::string>;

// Uses a recording of half a second of the playground with one robot.
class RecordedImages : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<base::testing::TestFolder>();
    const Outcome run =
        RunProgram("gsv", {"run", "playground", "--headless", "--lockstep", "--robot", "pebble@0,0",
                           "--duration", "0.5", "--record", Path("run.mcap")});
    ASSERT_EQ(run.ending, "exit code 0") << run.err;
  }
  static void TearDownTestSuite() { folder_.reset(); }

  static std::string Path(const std::string& name) { return folder_->path() / name; }

  static Outcome Gsv(const std::string& command, Strings more,
                     const std::string& file = Path("run.mcap")) {
    more.insert(more.begin(), {command, file});
    return RunProgram("gsv", more);
  }

  static std::string Text(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  // Returns the size in a PNG file: big-endian, after the signature and the header of the first
  // chunk.
  static std::pair<int, int> SizeOf(const std::string& png) {
    const auto number = [&](std::size_t at) {
      int value = 0;
      for (std::size_t i = at; i < at + 4; ++i) {
        value = value << 8 | static_cast<unsigned char>(png.at(i));
      }
      return value;
    };
    return {number(16), number(20)};
  }

  static inline std::unique_ptr<base::testing::TestFolder> folder_;
};

TEST_F(RecordedImages, ASnapshotIsAnImageOfTheInstant) {
  const Outcome whole = Gsv("snapshot", {"--at", "0.25", "--size", "160x120", "-o", Path("a.png")});
  ASSERT_EQ(whole.ending, "exit code 0") << whole.err;
  EXPECT_THAT(whole.out, HasSubstr("160 x 120 pixels, at 0.250 s"));
  EXPECT_EQ(SizeOf(Text(Path("a.png"))), std::pair(160, 120));
  // The same instant gives the same bytes, and another camera gives other bytes.
  ASSERT_EQ(Gsv("snapshot", {"--at", "0.25", "--size", "160x120", "-o", Path("b.png")}).ending,
            "exit code 0");
  EXPECT_EQ(Text(Path("a.png")), Text(Path("b.png")));
  for (const Strings& camera :
       {Strings{"--follow", "pebble"}, Strings{"--eye", "-3,-3,4", "--target", "0,0,-0.5"}}) {
    Strings more{"--at", "0.25", "--size", "160x120", "-o", Path("c.png")};
    more.insert(more.end(), camera.begin(), camera.end());
    const Outcome outcome = Gsv("snapshot", more);
    ASSERT_EQ(outcome.ending, "exit code 0") << outcome.err;
    EXPECT_NE(Text(Path("c.png")), Text(Path("a.png")));
  }
}

TEST_F(RecordedImages, AFilmHasAFrameForEachInstant) {
  const Strings size{"--size", "64x48", "--fps", "20"};
  Strings folder{"-o", Path("frames")}, animation{"-o", Path("run.apng")};
  for (Strings* each : {&folder, &animation}) each->insert(each->end(), size.begin(), size.end());
  const Outcome frames = Gsv("film", folder);
  ASSERT_EQ(frames.ending, "exit code 0") << frames.err;
  EXPECT_THAT(frames.out, HasSubstr("11 frames, 0.550 s"));  // frames at 0, 0.05, … 0.5 s
  EXPECT_TRUE(std::filesystem::exists(Path("frames/000011.png")));
  EXPECT_FALSE(std::filesystem::exists(Path("frames/000012.png")));
  ASSERT_EQ(Gsv("film", animation).ending, "exit code 0");
  EXPECT_THAT(Text(Path("run.apng")), HasSubstr("acTL"));
  EXPECT_EQ(SizeOf(Text(Path("run.apng"))), std::pair(64, 48));
  // A frame equals the snapshot of its instant.
  ASSERT_EQ(Gsv("snapshot", {"--at", "0.3", "--size", "64x48", "-o", Path("at.png")}).ending,
            "exit code 0");
  EXPECT_EQ(Text(Path("frames/000007.png")), Text(Path("at.png")));
}

TEST_F(RecordedImages, BadInputHasASentenceAndAnExitCode) {
  const auto check = [](const Outcome& outcome, const std::string& ending,
                        const std::string& sentence) {
    EXPECT_EQ(outcome.ending, ending);
    EXPECT_THAT(outcome.err, HasSubstr(sentence));
  };
  const Strings png{"-o", Path("bad.png")};
  const auto with = [&](const Strings& more) {
    Strings all = png;
    all.insert(all.end(), more.begin(), more.end());
    return Gsv("snapshot", all);
  };
  check(Gsv("snapshot", png, Path("none.mcap")), "exit code 5", "none.mcap");
  check(Gsv("snapshot", {"-o", Path("bad.png"), "--at", "1"}, "office"), "exit code 2",
        "a running simulation is drawn as it is now");
  check(with({"--at", "12.5"}), "exit code 2",
        "the time 12.5 s is outside of the recording, which is from 0 s to 0.5 s");
  check(with({"--at", "-1"}), "exit code 2", "outside of the recording");
  check(with({"--size", "0x0"}), "exit code 2", "each side must have 16 to 4096 pixels");
  check(with({"--size", "100000x100000"}), "exit code 2", "each side must have 16 to 4096 pixels");
  check(with({"--follow", "nobody"}), "exit code 5", "there is no robot 'nobody'");
  check(with({"--camera", "pebble/nothing"}), "exit code 5", "no camera 'pebble/nothing'");
  check(with({"--eye", "1,2,3"}), "exit code 2", "needs both eye and target");
  check(Gsv("film", {"-o", Path("film.gif")}), "exit code 2", ".webm, .mp4 or .apng");
  check(Gsv("film", {"-o", Path("film.apng"), "--from", "0.4", "--to", "0.2"}), "exit code 2",
        "--to must not be before --from");
  check(Gsv("film", {"-o", Path("run.mcap")}), "exit code 2", "run.mcap");
  std::filesystem::create_symlink("/dev/full", Path("full.png"));
  check(Gsv("snapshot", {"-o", Path("full.png")}), "exit code 5", "No space left on device");
  EXPECT_FALSE(std::filesystem::exists(Path("bad.png")));
  EXPECT_FALSE(std::filesystem::exists(Path("film.apng")));
}

}  // namespace
}  // namespace gsv::testing
