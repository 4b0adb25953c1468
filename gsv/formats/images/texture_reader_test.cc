#include "gsv/formats/images/texture_reader.h"

#include <cstdint>

#include <gmock/gmock.h>

#include "gsv/base/test_folder.h"

namespace gsv::formats {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// Returns an uncompressed true-colour TGA file, rows from the top, blue first.
std::string Tga(int width, int height, const std::string& pixels, int bits) {
  std::string tga(18, '\0');
  tga[2] = 2;
  tga[12] = static_cast<char>(width & 255), tga[13] = static_cast<char>(width >> 8);
  tga[14] = static_cast<char>(height & 255), tga[15] = static_cast<char>(height >> 8);
  tga[16] = static_cast<char>(bits);
  tga[17] = 0x20;
  return tga + pixels;
}

TEST(TextureReader, ReadsPixelsFromTheTopAndKeepsTheFile) {
  const base::testing::TestFolder folder;
  const auto path = folder.Write("a.tga", Tga(2, 1, "\x03\x02\x01\x06\x05\x04", 24));
  TextureReader reader{ReadLimits{}};
  const auto image = reader.Read(path);
  ASSERT_TRUE(image.has_value()) << image.error().Sentence();
  EXPECT_EQ((*image)->width, 2);
  EXPECT_EQ((*image)->channels, 3);
  EXPECT_THAT((*image)->pixels, ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_EQ(reader.Read(path).value(), *image);
}

// PNG allows an empty IDAT chunk, for which stb copies zero bytes to a null pointer (stb_copy.h).
TEST(TextureReader, ReadsAPngWithAnEmptyChunk) {
  const auto chunk = [](const std::string& type, const std::string& data) {
    return std::string(3, '\0') + static_cast<char>(data.size()) + type + data + "sum?";
  };
  const std::string header("\0\0\0\2\0\0\0\1\x8\2\0\0\0", 13);
  // A zlib stream with one stored block. The block contains a row: the byte 0 (no filter), and the
  // six bytes of two pixels.
  const std::string stored("\x78\1\1\7\0\xf8\xff\0\1\2\3\4\5\6", 14);
  const base::testing::TestFolder folder;
  const auto path =
      folder.Write("a.png", "\x89PNG\r\n\x1a\n" + chunk("IHDR", header) + chunk("IDAT", "") +
                                chunk("IDAT", stored) + chunk("IEND", ""));
  const auto image = TextureReader(ReadLimits{}).Read(path);
  ASSERT_TRUE(image.has_value()) << image.error().Sentence();
  EXPECT_THAT((*image)->pixels, ElementsAre(1, 2, 3, 4, 5, 6));
}

TEST(TextureReader, DropsAnOpaqueAlphaChannel) {
  const base::testing::TestFolder folder;
  const std::string opaque = "\x03\x02\x01\xff", half = "\x03\x02\x01\x80";
  TextureReader reader{ReadLimits{}};
  EXPECT_EQ((*reader.Read(folder.Write("o.tga", Tga(1, 1, opaque, 32))))->channels, 3);
  EXPECT_EQ((*reader.Read(folder.Write("h.tga", Tga(1, 1, half, 32))))->channels, 4);
}

TEST(TextureReader, RefusesImagesThatAreTooLargeOrDeclareAWrongSize) {
  const base::testing::TestFolder folder;
  TextureReader reader{ReadLimits{}};
  const auto large = reader.Read(folder.Write("large.tga", Tga(30000, 30000, "", 24)));
  ASSERT_FALSE(large.has_value());
  EXPECT_THAT(large.error().Sentence(), HasSubstr("declares 30000 x 30000"));
  EXPECT_THAT(large.error().Sentence(), HasSubstr("large.tga"));

  const std::string png_that_ends_early =
      std::string("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\x10\0\0\0\x10\0\x08\x02\0\0\0", 29) +
      "\1\2\3\4";
  EXPECT_FALSE(reader.Read(folder.Write("short.png", png_that_ends_early)).has_value());
  EXPECT_FALSE(reader.Read(folder.Write("text.png", "not a picture")).has_value());
  EXPECT_FALSE(reader.Read(folder.Write("empty.png", "")).has_value());
  EXPECT_FALSE(reader.Read(folder.path() / "absent.png").has_value());

  EXPECT_FALSE(reader.Read(folder.Write("cut.jpg", "\xff\xd8\xff\xe0")).has_value());

  ReadLimits small;
  small.texture_bytes = 10;
  EXPECT_FALSE(TextureReader(small).Read(folder.Write("b.tga", Tga(1, 1, "abc", 24))).has_value());
}

TEST(TextureReader, CombinesRoughnessAndMetalness) {
  const auto grey = [](std::uint8_t value) {
    return std::make_shared<const model::Image>(model::Image{1, 1, 3, {value, value, value}, ""});
  };
  TextureReader reader{ReadLimits{}};
  EXPECT_EQ(reader.Combine(nullptr, nullptr), nullptr);
  EXPECT_THAT(reader.Combine(grey(10), grey(20))->pixels, ElementsAre(255, 10, 20));
  EXPECT_THAT(reader.Combine(nullptr, grey(20))->pixels, ElementsAre(255, 255, 20));
}

}  // namespace
}  // namespace gsv::formats
