#include "gsv/recording/mcap/compression.h"

#include <immintrin.h>
#include <zlib.h>
#include <zstd.h>

#include "gsv/base/check.h"

namespace gsv::recording {

namespace {

#define GSV_CARRY_LESS __attribute__((target("pclmul,sse4.1")))

// Multiplies polynomials over GF(2), as needed for a CRC. Returns the sum of three terms: the low
// half of x times the low half of `by`, the high half of x times the high half of `by`, and `next`.
GSV_CARRY_LESS inline __m128i Folded(__m128i x, __m128i by, __m128i next) {
  return _mm_xor_si128(
      _mm_xor_si128(_mm_clmulepi64_si128(x, by, 0x00), _mm_clmulepi64_si128(x, by, 0x11)), next);
}

// Returns the remainder of `bytes`. `size` must be a multiple of 16, and at least 64. The argument
// `remainder` is the remainder of the data before `bytes`. A checksum is an inverted remainder.
// Source  V. Gopal et al., "Fast CRC computation for generic polynomials using PCLMULQDQ
//         instruction", Intel, 2009. The constants are for the reflected polynomial of CRC-32.
GSV_CARRY_LESS std::uint32_t Remainder(const std::byte* bytes, std::size_t size,
                                       std::uint32_t remainder) {
  const auto* at = reinterpret_cast<const __m128i*>(bytes);
  const __m128i by_64_bytes = _mm_set_epi64x(0x01c6e41596, 0x0154442bd4);
  const __m128i by_16_bytes = _mm_set_epi64x(0x00ccaa009e, 0x01751997d0);
  __m128i a = _mm_loadu_si128(at), b = _mm_loadu_si128(at + 1);
  __m128i c = _mm_loadu_si128(at + 2), d = _mm_loadu_si128(at + 3);
  a = _mm_xor_si128(a, _mm_cvtsi32_si128(static_cast<int>(remainder)));
  for (at += 4, size -= 64; size >= 64; at += 4, size -= 64) {
    a = Folded(a, by_64_bytes, _mm_loadu_si128(at));
    b = Folded(b, by_64_bytes, _mm_loadu_si128(at + 1));
    c = Folded(c, by_64_bytes, _mm_loadu_si128(at + 2));
    d = Folded(d, by_64_bytes, _mm_loadu_si128(at + 3));
  }
  for (const __m128i& next : {b, c, d}) a = Folded(a, by_16_bytes, next);
  for (; size >= 16; ++at, size -= 16) a = Folded(a, by_16_bytes, _mm_loadu_si128(at));

  // Reduces the 16 bytes to 8 bytes, and then to 4 bytes by Barrett reduction.
  const __m128i low = _mm_setr_epi32(~0, 0, ~0, 0);
  a = _mm_xor_si128(_mm_srli_si128(a, 8), _mm_clmulepi64_si128(a, by_16_bytes, 0x10));
  a = _mm_xor_si128(
      _mm_srli_si128(a, 4),
      _mm_clmulepi64_si128(_mm_and_si128(a, low), _mm_set_epi64x(0, 0x0163cd6124), 0x00));
  const __m128i polynomial = _mm_set_epi64x(0x01f7011641, 0x01db710641);
  __m128i quotient = _mm_clmulepi64_si128(_mm_and_si128(a, low), polynomial, 0x10);
  quotient = _mm_clmulepi64_si128(_mm_and_si128(quotient, low), polynomial, 0x00);
  return static_cast<std::uint32_t>(_mm_extract_epi32(_mm_xor_si128(a, quotient), 1));
}

bool HasCarryLessProducts() {
  static const bool has = __builtin_cpu_supports("pclmul") && __builtin_cpu_supports("sse4.1");
  return has;
}

}  // namespace

std::uint32_t Crc32(std::span<const std::byte> bytes, std::uint32_t before) {
  constexpr std::size_t kStep = 16, kMin = 64;
  if (bytes.size() >= kMin && HasCarryLessProducts()) {
    const std::size_t size = bytes.size() / kStep * kStep;
    before = ~Remainder(bytes.data(), size, ~before);
    bytes = bytes.subspan(size);
  }
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
    return base::Fail(base::ErrorCode::kCorrupt,
                      "its zstd frame declares another size than its header");
  }
  Bytes out(size);
  const std::size_t actual = ZSTD_decompress(out.data(), out.size(), bytes.data(), bytes.size());
  if (ZSTD_isError(actual) != 0 || actual != size) {
    return base::Fail(base::ErrorCode::kCorrupt, "its zstd data is damaged");
  }
  return out;
}

}  // namespace gsv::recording
