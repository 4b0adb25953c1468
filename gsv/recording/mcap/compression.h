// Compression (zstd) and checksums (CRC-32 as in zip and PNG) of chunks.
#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "gsv/base/error.h"
#include "gsv/recording/mcap/byte_order.h"

struct ZSTD_CCtx_s;

namespace gsv::recording {

// Returns the checksum of `bytes`. `before` is the checksum of the bytes before
// them.
std::uint32_t Crc32(std::span<const std::byte> bytes, std::uint32_t before = 0);

class ZstdCompressor {
 public:
  // `level` is zstd's compression level, 1 to 19.
  explicit ZstdCompressor(int level);

  // Returns the compressed bytes. They stay valid until the next call.
  std::span<const std::byte> Compress(std::span<const std::byte> bytes);

 private:
  struct Free {
    void operator()(ZSTD_CCtx_s* context) const;
  };
  std::unique_ptr<ZSTD_CCtx_s, Free> context_;
  Bytes out_;  // the result of Compress(); its memory is reused
};

// Decompresses to `size` bytes. Returns kCorrupt if the result has another size. Allocates at most
// `size` bytes, which the caller must limit.
[[nodiscard]] base::Result<Bytes> ZstdDecompress(std::span<const std::byte> bytes,
                                                 std::size_t size);

}  // namespace gsv::recording
