#include "gsv/rendering/scene/antialiasing.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace gsv::rendering {
namespace {

// A grid of surface numbers, one per pixel, read along rows or along columns. So one search finds
// the edges between rows and those between columns.
struct Surfaces {
  const std::uint8_t* numbers;
  int length, lines;  // `length` pixels along a line; `lines` lines side by side
  int At(int line, int i) const { return numbers[static_cast<std::size_t>(line) * length + i]; }
};

// The direction in which the edge between `line` and `line` + 1 continues at its end. Pixel `last`
// is the last one beside the edge, and both lines show the same surface at `next`. +1 is a step
// towards `line` and -1 one towards `line` + 1. 0 means that the edge ends, forks or turns a
// corner.
int StepAt(const Surfaces& s, int line, int last, int next) {
  if (next < 0 || next >= s.length) return 0;
  const int beyond = s.At(line, next);
  const bool before = s.At(line, last) != beyond, after = s.At(line + 1, last) != beyond;
  if (before == after) return 0;
  const int towards = before ? line - 1 : line + 2;
  if (towards < 0 || towards >= s.lines) return 0;
  const bool goes_on = s.At(towards, next) != beyond;
  const bool is_one_step = s.At(towards, last) == s.At(towards, next);
  return goes_on && is_one_step ? (before ? 1 : -1) : 0;
}

class Smoother {
 public:
  Smoother(int width, int height, const std::uint8_t* rgba) : rgba_(rgba) {
    image_.width = width, image_.height = height, image_.channels = 3;
    const std::size_t pixels = static_cast<std::size_t>(width) * height;
    image_.pixels.resize(pixels * 3);
    along_rows_.resize(pixels);
    Split(rgba, pixels);
    along_columns_.resize(pixels);
    Transpose(width, height);
  }

  model::Image Smooth() {
    const int width = image_.width, height = image_.height;
    FindEdges({along_rows_.data(), width, height}, width, 1);
    FindEdges({along_columns_.data(), height, width}, 1, width);
    return std::move(image_);
  }

 private:
  // Splits pixels into colours and surface numbers.
  void Split(const std::uint8_t* rgba, std::size_t pixels) {
    static_assert(std::endian::native == std::endian::little);
    std::size_t p = 0;
    for (; p + 4 <= pixels; p += 4) {
      std::uint32_t in[4], out[3];
      std::memcpy(in, rgba + 4 * p, sizeof in);
      out[0] = (in[0] & 0xffffff) | in[1] << 24;
      out[1] = (in[1] >> 8 & 0xffff) | in[2] << 16;
      out[2] = (in[2] >> 16 & 0xff) | in[3] << 8;
      std::memcpy(&image_.pixels[3 * p], out, sizeof out);
      const std::uint32_t numbers =
          in[0] >> 24 | (in[1] >> 24) << 8 | (in[2] >> 24) << 16 | (in[3] & 0xff000000);
      std::memcpy(&along_rows_[p], &numbers, sizeof numbers);
    }
    for (; p < pixels; ++p) {
      std::copy(rgba + 4 * p, rgba + 4 * p + 3, &image_.pixels[3 * p]);
      along_rows_[p] = rgba[4 * p + 3];
    }
  }

  // Transposes the numbers in blocks that fit into the cache.
  void Transpose(int width, int height) {
    constexpr int kBlock = 32;
    for (int y0 = 0; y0 < height; y0 += kBlock) {
      for (int x0 = 0; x0 < width; x0 += kBlock) {
        const int y1 = std::min(y0 + kBlock, height), x1 = std::min(x0 + kBlock, width);
        for (int x = x0; x < x1; ++x) {
          std::uint8_t* column = &along_columns_[static_cast<std::size_t>(x) * height];
          const std::uint8_t* from = &along_rows_[static_cast<std::size_t>(x)];
          for (int y = y0; y < y1; ++y) column[y] = from[static_cast<std::size_t>(y) * width];
        }
      }
    }
  }

  // `line_stride` and `stride` are the distances, in pixels of the image, between lines and between
  // the pixels of a line.
  void FindEdges(const Surfaces& s, int line_stride, int stride) {
    line_stride_ = line_stride, stride_ = stride;
    for (int line = 0; line + 1 < s.lines; ++line) {
      const std::uint8_t* a = s.numbers + static_cast<std::size_t>(line) * s.length;
      const std::uint8_t* b = a + s.length;
      for (int i = 0; i < s.length;) {
        if (a[i] == b[i]) {
          i = SkipEqual(a, b, i, s.length);
          continue;
        }
        const int first = i;
        while (i < s.length && a[i] != b[i]) ++i;
        Blend(line, first, i, StepAt(s, line, first, first - 1), StepAt(s, line, i - 1, i));
      }
    }
  }

  static int SkipEqual(const std::uint8_t* a, const std::uint8_t* b, int i, int end) {
    for (; i + 8 <= end && std::memcmp(a + i, b + i, 8) == 0; i += 8) {
    }
    while (i < end && a[i] == b[i]) ++i;
    return i;
  }

  // Blends along an edge. The line begins half a pixel beside the edge at each end that has a step,
  // and meets the edge in the middle.
  void Blend(int line, int first, int end, int step_first, int step_end) {
    if (step_first == 0 && step_end == 0) return;
    const float middle = 0.5f * static_cast<float>(end - first);
    // The area between the line and the edge, up to `t` from an end with a step.
    const auto area = [&](float t) {
      t = std::min(t, middle);
      return 0.5f * t * (1 - t / (2 * middle));
    };
    for (int i = first; i < end; ++i) {
      const float from_first = static_cast<float>(i - first);
      const float from_end = static_cast<float>(end - i - 1);
      if (step_first != 0) Mix(line, i, step_first, area(from_first + 1) - area(from_first));
      if (step_end != 0) Mix(line, i, step_end, area(from_end + 1) - area(from_end));
    }
  }

  // Mixes the fraction `share` of the colour on the other side of the edge into the pixel beside
  // the edge.
  void Mix(int line, int i, int step, float share) {
    if (share <= 0) return;
    const std::size_t before =
        static_cast<std::size_t>(line) * line_stride_ + static_cast<std::size_t>(i) * stride_;
    const std::size_t after = before + line_stride_;
    const std::size_t target = step > 0 ? before : after, source = step > 0 ? after : before;
    std::uint8_t* to = &image_.pixels[3 * target];
    for (int c = 0; c < 3; ++c) {
      const float old = to[c];
      to[c] = static_cast<std::uint8_t>(old + share * (rgba_[4 * source + c] - old) + 0.5f);
    }
  }

  const std::uint8_t* rgba_;
  model::Image image_;
  std::vector<std::uint8_t> along_rows_, along_columns_;
  int line_stride_ = 0, stride_ = 0;
};

}  // namespace

model::Image SmoothAliasedEdges(int width, int height, const std::uint8_t* rgba) {
  return Smoother(width, height, rgba).Smooth();
}

}  // namespace gsv::rendering
