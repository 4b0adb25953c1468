#include "gsv/rendering/images/apng.h"

#include <cmath>
#include <span>
#include <string_view>

#include <zlib.h>

#include "gsv/rendering/images/png.h"

namespace gsv::rendering {
namespace {

using ApngBytes = std::vector<std::uint8_t>;
// Sizes in bytes: the signature of a file, and the length, type and checksum of a chunk.
constexpr std::size_t kPngSignature = 8, kPngChunkEnds = 12;

void PutNumber(std::uint32_t value, int bytes, ApngBytes& out) {
  for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8) {
    out.push_back(static_cast<std::uint8_t>(value >> shift));
  }
}

void PutChunk(std::string_view type, std::span<const std::uint8_t> data, ApngBytes& out) {
  PutNumber(static_cast<std::uint32_t>(data.size()), 4, out);
  const std::size_t begin = out.size();
  out.insert(out.end(), type.begin(), type.end());
  out.insert(out.end(), data.begin(), data.end());
  const uLong sum = crc32(0, out.data() + begin, static_cast<uInt>(out.size() - begin));
  PutNumber(static_cast<std::uint32_t>(sum), 4, out);
}

// A chunk of a PNG file that our encoder has written.
struct PngChunk {
  std::string_view type;
  std::span<const std::uint8_t> data, whole;
};
PngChunk TakeChunk(std::span<const std::uint8_t>& rest) {
  std::size_t size = 0;
  for (int i = 0; i < 4; ++i) size = size << 8 | rest[static_cast<std::size_t>(i)];
  const PngChunk chunk{{reinterpret_cast<const char*>(rest.data()) + 4, 4},
                       rest.subspan(8, size),
                       rest.first(size + kPngChunkEnds)};
  rest = rest.subspan(size + kPngChunkEnds);
  return chunk;
}

}  // namespace

ApngEncoder::ApngEncoder(std::uint32_t frames, double frames_a_second)
    : frames_(frames),
      delay_denominator_(static_cast<std::uint16_t>(std::lround(100 * frames_a_second))) {}

base::Result<ApngBytes> ApngEncoder::Add(const model::Image& image) {
  const bool is_first = next_ == 0;
  if (!is_first && (image.width != width_ || image.height != height_)) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "an image of " + std::to_string(image.width) + " by " +
                          std::to_string(image.height) + " pixels in an animation of " +
                          std::to_string(width_) + " by " + std::to_string(height_) +
                          "; all images must have the same size");
  }
  const auto png = EncodePng(image);
  if (!png) return base::Fail(png.error());
  width_ = image.width;
  height_ = image.height;
  ApngBytes out;
  std::span<const std::uint8_t> rest(*png);
  if (is_first) out.insert(out.end(), rest.begin(), rest.begin() + kPngSignature);
  rest = rest.subspan(kPngSignature);
  while (!rest.empty()) {
    const PngChunk chunk = TakeChunk(rest);
    if (chunk.type == "IHDR") {
      if (is_first) {
        out.insert(out.end(), chunk.whole.begin(), chunk.whole.end());
        ApngBytes control;
        PutNumber(frames_, 4, control);
        PutNumber(1, 4, control);  // number of times that the animation is played
        PutChunk("acTL", control, out);
      }
      ApngBytes control;
      for (const std::uint32_t value : {next_++, static_cast<std::uint32_t>(width_),
                                        static_cast<std::uint32_t>(height_), 0u, 0u}) {
        PutNumber(value, 4, control);
      }
      PutNumber(100, 2, control);
      PutNumber(delay_denominator_, 2, control);
      PutNumber(0, 2, control);  // the next frame replaces this one without clearing it
      PutChunk("fcTL", control, out);
    } else if (chunk.type == "IDAT" && is_first) {
      out.insert(out.end(), chunk.whole.begin(), chunk.whole.end());
    } else if (chunk.type == "IDAT") {
      ApngBytes data;
      PutNumber(next_++, 4, data);
      data.insert(data.end(), chunk.data.begin(), chunk.data.end());
      PutChunk("fdAT", data, out);
    }
  }
  return out;
}

ApngBytes ApngEncoder::End() {
  ApngBytes out;
  PutChunk("IEND", {}, out);
  return out;
}

}  // namespace gsv::rendering
