// Splits the files according to the specification, and decodes the frames with libpng.
#include "gsv/rendering/images/apng.h"

#include <cstring>
#include <string>

#include <gtest/gtest.h>
#include <png.h>

namespace gsv::rendering {
namespace {

using AnimationBytes = std::vector<std::uint8_t>;

model::Image Filled(std::uint8_t red, int width = 5) {
  model::Image image;
  image.width = width, image.height = 3;
  for (int i = 0; i < width * 3; ++i) {
    image.pixels.insert(image.pixels.end(), {red, static_cast<std::uint8_t>(i), 7});
  }
  return image;
}

struct Part {
  std::string type;
  AnimationBytes data, whole;
};

std::uint32_t BigEndian(const AnimationBytes& bytes, std::size_t at, int size = 4) {
  std::uint32_t value = 0;
  for (int i = 0; i < size; ++i) value = value << 8 | bytes.at(at + static_cast<std::size_t>(i));
  return value;
}

std::vector<Part> PartsOf(const AnimationBytes& file) {
  std::vector<Part> parts;
  for (std::size_t at = 8; at < file.size();) {
    const std::size_t size = BigEndian(file, at);
    const auto begin = file.begin() + static_cast<std::ptrdiff_t>(at);
    const auto data = begin + 8;
    parts.push_back({std::string(begin + 4, data),
                     {data, data + static_cast<std::ptrdiff_t>(size)},
                     {begin, data + static_cast<std::ptrdiff_t>(size) + 4}});
    at += size + 12;
  }
  return parts;
}

AnimationBytes Animation(const std::vector<model::Image>& images, double rate) {
  ApngEncoder encoder(static_cast<std::uint32_t>(images.size()), rate);
  AnimationBytes file;
  for (const model::Image& image : images) {
    const auto bytes = encoder.Add(image);
    EXPECT_TRUE(bytes);
    if (bytes) file.insert(file.end(), bytes->begin(), bytes->end());
  }
  const auto end = ApngEncoder::End();
  file.insert(file.end(), end.begin(), end.end());
  return file;
}

AnimationBytes Pixels(const AnimationBytes& png) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  EXPECT_TRUE(png_image_begin_read_from_memory(&image, png.data(), png.size())) << image.message;
  image.format = PNG_FORMAT_RGB;
  AnimationBytes pixels(PNG_IMAGE_SIZE(image));
  EXPECT_TRUE(png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr)) << image.message;
  return pixels;
}

// Returns the frame of an fdAT chunk as a complete file; libpng computes the checksum of its IDAT.
AnimationBytes FrameOf(const Part& header, const Part& fdat) {
  AnimationBytes png{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  png.insert(png.end(), header.whole.begin(), header.whole.end());
  const auto put = [&](const std::string& type, const AnimationBytes& data) {
    for (int shift = 24; shift >= 0; shift -= 8) {
      png.push_back(static_cast<std::uint8_t>(data.size() >> shift));
    }
    png.insert(png.end(), type.begin(), type.end());
    png.insert(png.end(), data.begin(), data.end());
    std::uint32_t sum = 0xffffffff;  // computes the checksum of the specification, annex D, bit by
                                     // bit
    for (std::size_t i = png.size() - data.size() - 4; i < png.size(); ++i) {
      sum ^= png[i];
      for (int bit = 0; bit < 8; ++bit) sum = sum & 1 ? 0xedb88320 ^ sum >> 1 : sum >> 1;
    }
    sum = ~sum;
    for (int shift = 24; shift >= 0; shift -= 8) {
      png.push_back(static_cast<std::uint8_t>(sum >> shift));
    }
  };
  put("IDAT", {fdat.data.begin() + 4, fdat.data.end()});
  put("IEND", {});
  return png;
}

TEST(ApngEncoder, WritesEveryFrameInOrder) {
  const AnimationBytes file = Animation({Filled(10), Filled(20), Filled(30)}, 25);
  const std::vector<Part> parts = PartsOf(file);
  std::vector<std::string> types;
  for (const Part& part : parts) types.push_back(part.type);
  EXPECT_EQ(types, (std::vector<std::string>{"IHDR", "acTL", "fcTL", "IDAT", "fcTL", "fdAT", "fcTL",
                                             "fdAT", "IEND"}));
  EXPECT_EQ(BigEndian(parts[1].data, 0), 3u);  // frames
  for (std::uint32_t i = 0; i < 5; ++i) {      // sequence numbers
    const Part& part = parts[std::size_t{2} + i + (i > 0 ? 1 : 0)];
    EXPECT_EQ(BigEndian(part.data, 0), i) << part.type;
  }
  EXPECT_EQ(Pixels(file), Filled(10).pixels);
  EXPECT_EQ(Pixels(FrameOf(parts[0], parts[5])), Filled(20).pixels);
  EXPECT_EQ(Pixels(FrameOf(parts[0], parts[7])), Filled(30).pixels);
}

TEST(ApngEncoder, GivesEachFrameItsExactDuration) {
  const Part control = PartsOf(Animation({Filled(1)}, 29.97)).at(2);
  EXPECT_EQ(BigEndian(control.data, 4), 5u);  // width
  EXPECT_EQ(BigEndian(control.data, 8), 3u);  // height
  EXPECT_EQ(BigEndian(control.data, 20, 2), 100u);
  EXPECT_EQ(BigEndian(control.data, 22, 2), 2997u);
}

TEST(ApngEncoder, RefusesAFrameOfAnotherSize) {
  ApngEncoder encoder(2, 25);
  ASSERT_TRUE(encoder.Add(Filled(1)));
  EXPECT_FALSE(encoder.Add(Filled(1, 6)));
}

}  // namespace
}  // namespace gsv::rendering
