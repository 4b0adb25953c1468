#include "gsv/recording/mcap/compression.h"

#include <zlib.h>
#include <zstd.h>

#include "gsv/base/check.h"

namespace gsv::recording {

std::uint32_t Crc32(std::span<const std::byte> bytes, std::uint32_t before) {
  if (bytes.empty()) return before;  // for a null pointer, zlib would start a new checksum
  return static_cast<std::uint32_t>(
      crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

void ZstdCompressor::Free::operator()(ZSTD_CCtx_s* context) const { ZSTD_freeCCtx(context); }

ZstdCompressor::ZstdCompressor(int level) : context_(ZSTD_createCCtx()) {
  GSV_CHECK(context_ != nullptr);
  GSV_CHECK(!ZSTD_isError(ZSTD_CCtx_setParameter(context_.get(), ZSTD_c_compressionLevel, level)));
}

std::span<const std::byte> ZstdCompressor::Compress(std::span<const std::byte> bytes) {
  const std::size_t bound = ZSTD_compressBound(bytes.size());
  if (out_.size() < bound) out_.resize(bound);
  const std::size_t size =
      ZSTD_compress2(context_.get(), out_.data(), out_.size(), bytes.data(), bytes.size());
  GSV_CHECK(!ZSTD_isError(size));
  return std::span(out_).first(size);
}

base::Result<Bytes> ZstdDecompress(std::span<const std::byte> bytes, std::size_t size) {
  // The size in the zstd frame is checked first, because this detects most damage before memory is
  // allocated.
  const unsigned long long claimed = ZSTD_getFrameContentSize(bytes.data(), bytes.size());
  if (claimed != size && claimed != ZSTD_CONTENTSIZE_UNKNOWN) {
    return base::Fail(base::ErrorCode::kCorrupt, "its zstd frame and its size disagree");
  }
  Bytes out(size);
  const std::size_t actual = ZSTD_decompress(out.data(), out.size(), bytes.data(), bytes.size());
  if (ZSTD_isError(actual) != 0 || actual != size) {
    return base::Fail(base::ErrorCode::kCorrupt, "its zstd data is damaged");
  }
  return out;
}

}  // namespace gsv::recording
