#include "apps/gsv/running/film.h"

#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "gsv/base/temporary_folder.h"

namespace gsv::app {
namespace {

// Replaces ffmpeg by a program that stores its input and its arguments.
class FilmTest : public testing::Test {
 protected:
  FilmTest() {
    const std::filesystem::path path = folder_->path() / "ffmpeg";
    std::ofstream(path) << "#!/bin/sh\nfor last; do :; done\necho \"$@\" > \"$last.arguments\"\n"
                           "exec cat > \"$last\"\n";
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
    options_.ffmpeg = path;
    options_.width = 2;
    options_.height = 1;
    options_.frames = 2;
    options_.frames_a_second = 30;
  }

  void Name(const std::string& name) { options_.output = folder_->path() / name; }

  static model::Image Frame(char letter) {
    model::Image image;
    image.width = 2, image.height = 1;
    image.pixels.assign(6, static_cast<std::uint8_t>(letter));
    return image;
  }

  void Make() {
    const auto film = Film::Start(options_);
    ASSERT_TRUE(film) << film.error().Sentence();
    ASSERT_TRUE((*film)->Add(Frame('a')));
    ASSERT_TRUE((*film)->Add(Frame('b')));
    ASSERT_TRUE((*film)->Finish());
  }

  std::string ErrorSentence() const {
    const auto film = Film::Start(options_);
    return film ? "" : film.error().Sentence();
  }

  static std::string Text(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  const base::Result<base::TemporaryFolder> folder_ = base::TemporaryFolder::Make("gsv-film");
  FilmOptions options_;
};

TEST_F(FilmTest, PassesRawFramesToFfmpeg) {
  for (const char* name : {"out.webm", "out.mp4"}) {
    Name(name);
    Make();
    EXPECT_EQ(Text(options_.output), "aaaaaabbbbbb");
    const std::string arguments = Text(options_.output + ".arguments");
    EXPECT_NE(arguments.find("-f rawvideo -pix_fmt rgb24 -s 2x1 -framerate 30 -i -"),
              std::string::npos)
        << arguments;
  }
}

TEST_F(FilmTest, NamesTheOtherFormatsIfFfmpegIsMissing) {
  options_.ffmpeg = folder_->path() / "missing";
  Name("out.webm");
  EXPECT_NE(ErrorSentence().find("Install it (apt-get install ffmpeg), or write to NAME.apng"),
            std::string::npos)
      << ErrorSentence();
  Name("out.apng");
  Make();
}

TEST_F(FilmTest, WritesOneFilePerFrameToAFolder) {
  Name("frames");
  Make();
  EXPECT_EQ(Text(options_.output + "/000001.png").substr(1, 3), "PNG");
  EXPECT_EQ(Text(options_.output + "/000002.png").substr(1, 3), "PNG");
  EXPECT_FALSE(std::filesystem::exists(options_.output + "/000003.png"));
}

TEST_F(FilmTest, RemovesAnUnfinishedFilm) {
  for (const char* name : {"out.webm", "out.apng", "frames"}) {
    Name(name);
    {
      const auto film = Film::Start(options_);
      ASSERT_TRUE(film) << film.error().Sentence();
      ASSERT_TRUE((*film)->Add(Frame('a')));
    }
    EXPECT_FALSE(std::filesystem::exists(options_.output)) << name;
  }
}

TEST_F(FilmTest, NeverOverwrites) {
  Name("out.apng");
  std::ofstream(options_.output) << "mine";
  EXPECT_NE(ErrorSentence().find("exists already"), std::string::npos);
  EXPECT_EQ(Text(options_.output), "mine");
}

TEST_F(FilmTest, RejectsUnknownExtensionsAndMissingFolders) {
  Name("out.avi");
  EXPECT_NE(ErrorSentence().find("must end with .webm, .mp4 or .apng"), std::string::npos);
  Name("missing/frames");
  EXPECT_NE(ErrorSentence().find("cannot make the folder"), std::string::npos);
  Name("missing/out.apng");
  const auto film = Film::Start(options_);
  ASSERT_TRUE(film);
  const auto added = (*film)->Add(Frame('a'));
  ASSERT_FALSE(added);
  EXPECT_NE(added.error().message.find("No such file or directory"), std::string::npos)
      << added.error().message;
}

}  // namespace
}  // namespace gsv::app
