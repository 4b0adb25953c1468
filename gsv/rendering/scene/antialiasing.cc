#include "gsv/rendering/scene/antialiasing.h"

#include <immintrin.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <memory>

namespace gsv::rendering {
namespace {

// A grid of surface numbers, one per pixel. The grid is read along rows or along columns. So one
// search function finds the edges between rows and the edges between columns.
struct Surfaces {
  const std::uint8_t* numbers;
  int length, lines;  // number of pixels of a line, and number of lines
  int At(int line, int i) const { return numbers[static_cast<std::size_t>(line) * length + i]; }
};

// The direction in which the edge between `line` and `line` + 1 continues at its end. `last` is the
// last pixel beside the edge. At the pixel `next`, both lines show the same surface. +1 means that
// the edge continues on the side of `line`, -1 on the side of `line` + 1. 0 means that the edge
// ends, forks or has a corner.
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
  Smoother(int width, int height, const std::uint8_t* rgba)
      : rgba_(rgba),
        along_rows_(new std::uint8_t[static_cast<std::size_t>(width) * height]),
        along_columns_(new std::uint8_t[static_cast<std::size_t>(width) * height]) {
    image_.width = width, image_.height = height, image_.channels = 3;
    const std::size_t pixels = static_cast<std::size_t>(width) * height;
    image_.pixels.resize(pixels * 3);
    Split(rgba, pixels);
    Transpose(width, height);
  }

  model::Image Smooth() {
    const int width = image_.width, height = image_.height;
    FindEdges({along_rows_.get(), width, height}, width, 1);
    FindEdges({along_columns_.get(), height, width}, 1, width);
    return std::move(image_);
  }

 private:
  // Splits pixels into colours and surface numbers.
  void Split(const std::uint8_t* rgba, std::size_t pixels) {
    std::size_t p = 0;
    if (__builtin_cpu_supports("ssse3")) p = SplitBySixteen(rgba, pixels);
    for (; p < pixels; ++p) {
      std::copy(rgba + 4 * p, rgba + 4 * p + 3, &image_.pixels[3 * p]);
      along_rows_[p] = rgba[4 * p + 3];
    }
  }

  // Splits groups of sixteen pixels and returns the number of these pixels.
  __attribute__((target("ssse3"))) std::size_t SplitBySixteen(const std::uint8_t* rgba,
                                                              std::size_t pixels) {
    // The colours of four pixels are in the lowest twelve bytes, followed by the surface numbers.
    const __m128i order = _mm_setr_epi8(0, 1, 2, 4, 5, 6, 8, 9, 10, 12, 13, 14, 3, 7, 11, 15);
    std::size_t p = 0;
    for (; p + 16 <= pixels; p += 16) {
      const auto four = [&](std::size_t i) __attribute__((target("ssse3"))) {
        const auto* from = reinterpret_cast<const __m128i*>(rgba + 4 * (p + i));
        return _mm_shuffle_epi8(_mm_loadu_si128(from), order);
      };
      const __m128i a = four(0), b = four(4), c = four(8), d = four(12);
      auto* colours = reinterpret_cast<__m128i*>(&image_.pixels[3 * p]);
      const __m128i low = _mm_set_epi32(0, -1, -1, -1);
      _mm_storeu_si128(colours, _mm_or_si128(_mm_and_si128(a, low), _mm_slli_si128(b, 12)));
      _mm_storeu_si128(colours + 1, _mm_or_si128(_mm_srli_si128(_mm_and_si128(b, low), 4),
                                                 _mm_slli_si128(c, 8)));
      _mm_storeu_si128(colours + 2, _mm_or_si128(_mm_srli_si128(_mm_and_si128(c, low), 8),
                                                 _mm_slli_si128(d, 4)));
      const __m128i ab = _mm_unpackhi_epi32(a, b), cd = _mm_unpackhi_epi32(c, d);
      _mm_storeu_si128(reinterpret_cast<__m128i*>(&along_rows_[p]), _mm_unpackhi_epi64(ab, cd));
    }
    return p;
  }

  // Transposes the numbers in blocks of 16 by 16 pixels.
  void Transpose(int width, int height) {
    constexpr int kBlock = 16;
    for (int y = 0; y < height; y += kBlock) {
      for (int x = 0; x < width; x += kBlock) {
        const std::uint8_t* from = &along_rows_[static_cast<std::size_t>(y) * width + x];
        std::uint8_t* to = &along_columns_[static_cast<std::size_t>(x) * height + y];
        if (x + kBlock <= width && y + kBlock <= height) {
          TransposeBlock(from, width, to, height);
          continue;
        }
        for (int i = 0; i < std::min(kBlock, width - x); ++i) {
          for (int k = 0; k < std::min(kBlock, height - y); ++k) {
            to[static_cast<std::size_t>(i) * height + k] =
                from[static_cast<std::size_t>(k) * width + i];
          }
        }
      }
    }
  }

  static void TransposeBlock(const std::uint8_t* from, int from_stride, std::uint8_t* to,
                             int to_stride) {
    // Each pass interleaves row i with row i + 8, so that after four passes byte k of row i is byte
    // i of row k.
    __m128i rows[16], next[16];
    for (int i = 0; i < 16; ++i) {
      rows[i] = _mm_loadu_si128(
          reinterpret_cast<const __m128i*>(from + static_cast<std::size_t>(i) * from_stride));
    }
    for (int pass = 0; pass < 4; ++pass) {
      for (int i = 0; i < 8; ++i) {
        next[2 * i] = _mm_unpacklo_epi8(rows[i], rows[i + 8]);
        next[2 * i + 1] = _mm_unpackhi_epi8(rows[i], rows[i + 8]);
      }
      std::copy(next, next + 16, rows);
    }
    for (int i = 0; i < 16; ++i) {
      _mm_storeu_si128(reinterpret_cast<__m128i*>(to + static_cast<std::size_t>(i) * to_stride),
                       rows[i]);
    }
  }

  // `line_stride` is the distance between lines, and `stride` is the distance between the pixels of
  // a line. Both are in pixels of the image.
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

  // Returns the first pixel from `i` on whose numbers in the lines `a` and `b` differ. Returns
  // `end` if there is none.
  static int SkipEqual(const std::uint8_t* a, const std::uint8_t* b, int i, int end) {
    const auto sixteen = [](const std::uint8_t* from) {
      return _mm_loadu_si128(reinterpret_cast<const __m128i*>(from));
    };
    for (; i + 16 <= end; i += 16) {
      const int equal = _mm_movemask_epi8(_mm_cmpeq_epi8(sixteen(a + i), sixteen(b + i)));
      if (equal != 0xffff) return i + std::countr_one(static_cast<unsigned>(equal));
    }
    while (i < end && a[i] == b[i]) ++i;
    return i;
  }

  // Blends along an edge. At each end that has a step, the line begins half a pixel beside the
  // edge. In the middle, the line reaches the edge.
  void Blend(int line, int first, int end, int step_first, int step_end) {
    const float middle = 0.5f * static_cast<float>(end - first);
    // Calls mix(k, share) for each pixel k, counted from an end with a step. `share` is the area
    // between the line and the edge in this pixel.
    const auto from_end = [&](auto&& mix) {
      float before = 0;
      for (int k = 0; static_cast<float>(k) < middle; ++k) {
        const float t = std::min(static_cast<float>(k + 1), middle);
        const float area = 0.5f * t * (1 - t / (2 * middle));
        mix(k, area - before);
        before = area;
      }
    };
    if (step_first != 0) {
      from_end([&](int k, float share) { Mix(line, first + k, step_first, share); });
    }
    if (step_end != 0) {
      from_end([&](int k, float share) { Mix(line, end - 1 - k, step_end, share); });
    }
  }

  // Mixes the fraction `share` of the colour on the other side of the edge into the pixel beside
  // the edge.
  void Mix(int line, int i, int step, float share) {
    const std::size_t before =
        static_cast<std::size_t>(line) * line_stride_ + static_cast<std::size_t>(i) * stride_;
    const std::size_t after = before + line_stride_;
    const std::size_t target = step > 0 ? before : after, source = step > 0 ? after : before;
    const auto colour = [](unsigned bytes) {
      const __m128i zero = _mm_setzero_si128();
      const __m128i words = _mm_unpacklo_epi8(_mm_cvtsi32_si128(static_cast<int>(bytes)), zero);
      return _mm_cvtepi32_ps(_mm_unpacklo_epi16(words, zero));
    };
    std::uint8_t* to = &image_.pixels[3 * target];
    const __m128 old =
        colour(to[0] | static_cast<unsigned>(to[1]) << 8 | static_cast<unsigned>(to[2]) << 16);
    unsigned other;
    std::memcpy(&other, rgba_ + 4 * source, sizeof other);
    const __m128 change = _mm_mul_ps(_mm_set1_ps(share), _mm_sub_ps(colour(other), old));
    const __m128i mixed = _mm_cvttps_epi32(_mm_add_ps(_mm_add_ps(old, change), _mm_set1_ps(0.5f)));
    const __m128i words = _mm_packs_epi32(mixed, mixed);
    const auto bytes = static_cast<unsigned>(_mm_cvtsi128_si32(_mm_packus_epi16(words, words)));
    to[0] = static_cast<std::uint8_t>(bytes);
    to[1] = static_cast<std::uint8_t>(bytes >> 8);
    to[2] = static_cast<std::uint8_t>(bytes >> 16);
  }

  const std::uint8_t* rgba_;
  model::Image image_;
  // not initialised, because Split() and Transpose() write all of them
  const std::unique_ptr<std::uint8_t[]> along_rows_, along_columns_;
  int line_stride_ = 0, stride_ = 0;
};

}  // namespace

model::Image SmoothAliasedEdges(int width, int height, const std::uint8_t* rgba) {
  return Smoother(width, height, rgba).Smooth();
}

}  // namespace gsv::rendering
