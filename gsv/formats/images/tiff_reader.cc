#include "gsv/formats/images/tiff_reader.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <mutex>
#include <numbers>

#include <tiffio.h>

namespace gsv::formats {
namespace {

using base::ErrorCode;

// Tags and values of GeoTIFF 1.1 (OGC 19-008r4), and GDAL's tag for unknown heights.
constexpr ttag_t kPixelScaleTag = 33550, kTiePointTag = 33922, kGeoKeysTag = 34735;
constexpr ttag_t kNoDataTag = 42113;
constexpr std::uint16_t kModelTypeKey = 1024, kGeographic = 2;
constexpr double kMetresPerDegree = 111'320;  // along a meridian

constexpr TIFFFieldInfo kGeoFields[] = {
    {kPixelScaleTag, -1, -1, TIFF_DOUBLE, FIELD_CUSTOM, 1, 1, const_cast<char*>("PixelScale")},
    {kTiePointTag, -1, -1, TIFF_DOUBLE, FIELD_CUSTOM, 1, 1, const_cast<char*>("TiePoints")},
    {kGeoKeysTag, -1, -1, TIFF_SHORT, FIELD_CUSTOM, 1, 1, const_cast<char*>("GeoKeys")},
    {kNoDataTag, -1, -1, TIFF_ASCII, FIELD_CUSTOM, 1, 0, const_cast<char*>("NoData")},
};

void AddGeoFields(TIFF* tiff) {
  TIFFMergeFieldInfo(tiff, kGeoFields, sizeof kGeoFields / sizeof kGeoFields[0]);
}

void PrepareLibrary() {
  static std::once_flag once;
  std::call_once(once, [] {
    TIFFSetErrorHandler(nullptr);
    TIFFSetWarningHandler(nullptr);
    TIFFSetTagExtender(AddGeoFields);
  });
}

using Tiff = std::unique_ptr<TIFF, void (*)(TIFF*)>;

// An open file in memory, for libtiff's callbacks.
struct BytesInMemory {
  const unsigned char* data;
  toff_t size;
  toff_t at = 0;
};

tmsize_t ReadFromMemory(thandle_t handle, void* to, tmsize_t count) {
  auto& bytes = *static_cast<BytesInMemory*>(handle);
  const toff_t left = bytes.at < bytes.size ? bytes.size - bytes.at : 0;
  const toff_t taken = std::min<toff_t>(left, static_cast<toff_t>(std::max<tmsize_t>(count, 0)));
  if (taken > 0) std::memcpy(to, bytes.data + bytes.at, taken);
  bytes.at += taken;
  return static_cast<tmsize_t>(taken);
}

toff_t SeekInMemory(thandle_t handle, toff_t offset, int whence) {
  auto& bytes = *static_cast<BytesInMemory*>(handle);
  bytes.at = whence == SEEK_SET   ? offset
             : whence == SEEK_CUR ? bytes.at + offset
                                  : bytes.size + offset;
  return bytes.at;
}

Tiff OpenInMemory(BytesInMemory& bytes) {
  PrepareLibrary();
  return {TIFFClientOpen(
              "memory", "rm", &bytes, ReadFromMemory,
              [](thandle_t, void*, tmsize_t) -> tmsize_t { return 0; }, SeekInMemory,
              [](thandle_t) { return 0; },
              [](thandle_t handle) { return static_cast<BytesInMemory*>(handle)->size; }, nullptr,
              nullptr),
          TIFFClose};
}

struct Size {
  std::uint32_t width = 0, height = 0;
};

base::Result<Size> SizeOf(TIFF* tiff, const std::string& source, const ReadLimits& limits) {
  Size size;
  if (tiff == nullptr || TIFFGetField(tiff, TIFFTAG_IMAGEWIDTH, &size.width) != 1 ||
      TIFFGetField(tiff, TIFFTAG_IMAGELENGTH, &size.height) != 1 || size.width == 0 ||
      size.height == 0) {
    return Fail(ErrorCode::kBadModel, "the TIFF file is damaged", source);
  }
  const auto limit = static_cast<std::uint32_t>(limits.texture_side);
  if (size.width > limit || size.height > limit) {
    return Fail(ErrorCode::kBadModel,
                "the image declares " + std::to_string(size.width) + " x " +
                    std::to_string(size.height) + " pixels; the limit is " + std::to_string(limit),
                source);
  }
  return size;
}

// How a TIFF file encodes the height of a sample.
struct Sample {
  std::uint16_t bits = 1, format = SAMPLEFORMAT_UINT, per_pixel = 1, layout = PLANARCONFIG_CONTIG;

  bool IsKnown() const {
    const bool is_float = format == SAMPLEFORMAT_IEEEFP && (bits == 32 || bits == 64);
    const bool is_whole = (format == SAMPLEFORMAT_UINT || format == SAMPLEFORMAT_INT) &&
                          (bits == 8 || bits == 16 || bits == 32);
    return per_pixel > 0 && (is_float || is_whole);
  }

  template <typename T>
  static double Get(const unsigned char* from) {
    T value;
    std::memcpy(&value, from, sizeof value);
    return static_cast<double>(value);
  }

  double At(const unsigned char* from) const {
    if (format == SAMPLEFORMAT_IEEEFP) return bits == 32 ? Get<float>(from) : Get<double>(from);
    const bool has_sign = format == SAMPLEFORMAT_INT;
    if (bits == 8) return has_sign ? Get<std::int8_t>(from) : Get<std::uint8_t>(from);
    if (bits == 16) return has_sign ? Get<std::int16_t>(from) : Get<std::uint16_t>(from);
    return has_sign ? Get<std::int32_t>(from) : Get<std::uint32_t>(from);
  }

  std::size_t Stride() const {
    return bits / 8u * (layout == PLANARCONFIG_CONTIG ? per_pixel : 1u);
  }
};

Sample SampleOf(TIFF* tiff) {
  Sample sample;
  TIFFGetFieldDefaulted(tiff, TIFFTAG_BITSPERSAMPLE, &sample.bits);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLEFORMAT, &sample.format);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_SAMPLESPERPIXEL, &sample.per_pixel);
  TIFFGetFieldDefaulted(tiff, TIFFTAG_PLANARCONFIG, &sample.layout);
  return sample;
}

// Reads the first band. Returns false if a part of the band cannot be read.
bool ReadRows(TIFF* tiff, const Sample& sample, HeightGrid& grid) {
  std::vector<unsigned char> row(static_cast<std::size_t>(TIFFScanlineSize(tiff)));
  if (row.size() < static_cast<std::size_t>(grid.width) * sample.Stride()) return false;
  for (int y = 0; y < grid.height; ++y) {
    if (TIFFReadScanline(tiff, row.data(), static_cast<std::uint32_t>(y), 0) != 1) return false;
    for (int x = 0; x < grid.width; ++x) {
      grid.heights.push_back(sample.At(row.data() + static_cast<std::size_t>(x) * sample.Stride()));
    }
  }
  return true;
}

bool ReadTiles(TIFF* tiff, const Sample& sample, HeightGrid& grid) {
  std::uint32_t wide = 0, high = 0;
  TIFFGetField(tiff, TIFFTAG_TILEWIDTH, &wide);
  TIFFGetField(tiff, TIFFTAG_TILELENGTH, &high);
  const auto bytes = static_cast<std::size_t>(TIFFTileSize(tiff));
  constexpr std::uint32_t kMaxTileSide = 1u << 14;
  if (wide == 0 || high == 0 || wide > kMaxTileSide || high > kMaxTileSide ||
      bytes < static_cast<std::size_t>(wide) * high * sample.Stride()) {
    return false;
  }
  std::vector<unsigned char> tile(bytes);
  grid.heights.resize(static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height));
  for (int top = 0; top < grid.height; top += static_cast<int>(high)) {
    for (int left = 0; left < grid.width; left += static_cast<int>(wide)) {
      if (TIFFReadTile(tiff, tile.data(), static_cast<std::uint32_t>(left),
                       static_cast<std::uint32_t>(top), 0, 0) < 0) {
        return false;
      }
      for (int y = top; y < std::min(grid.height, top + static_cast<int>(high)); ++y) {
        for (int x = left; x < std::min(grid.width, left + static_cast<int>(wide)); ++x) {
          const auto pixel =
              static_cast<std::size_t>(y - top) * wide + static_cast<std::size_t>(x - left);
          grid.heights[static_cast<std::size_t>(y) * static_cast<std::size_t>(grid.width) +
                       static_cast<std::size_t>(x)] =
              sample.At(tile.data() + pixel * sample.Stride());
        }
      }
    }
  }
  return true;
}

// Returns the distance between samples in metres. Degrees are converted on a sphere, at the file's
// upper edge.
std::optional<geometry::Vector2> SpacingOf(TIFF* tiff) {
  std::uint32_t count = 0;
  double* scale = nullptr;
  if (TIFFGetField(tiff, kPixelScaleTag, &count, &scale) != 1 || count < 2) return std::nullopt;
  geometry::Vector2 spacing{scale[0], scale[1]};
  std::uint16_t* keys = nullptr;
  bool is_in_degrees = false;
  if (TIFFGetField(tiff, kGeoKeysTag, &count, &keys) == 1) {
    for (std::uint32_t i = 4; i + 3 < count; i += 4) {
      is_in_degrees = is_in_degrees || (keys[i] == kModelTypeKey && keys[i + 3] == kGeographic);
    }
  }
  if (is_in_degrees) {
    double* tie = nullptr;
    const bool has_tie = TIFFGetField(tiff, kTiePointTag, &count, &tie) == 1 && count >= 6;
    const double latitude = (has_tie ? tie[4] : 0.0) * std::numbers::pi / 180;
    spacing = {spacing.x * kMetresPerDegree * std::cos(latitude), spacing.y * kMetresPerDegree};
  }
  const bool is_sound =
      spacing.x > 0 && spacing.y > 0 && std::isfinite(spacing.x) && std::isfinite(spacing.y);
  return is_sound ? std::optional(spacing) : std::nullopt;
}

void FillUnknown(TIFF* tiff, HeightGrid& grid) {
  char* text = nullptr;
  const bool has_mark = TIFFGetField(tiff, kNoDataTag, &text) == 1 && text != nullptr;
  const double mark = has_mark ? std::strtod(text, nullptr) : 0;
  constexpr double kMaxHeight = 1e5;  // m; larger magnitudes mark unknown heights
  const auto is_known = [&](double height) {
    return std::isfinite(height) && std::abs(height) < kMaxHeight && !(has_mark && height == mark);
  };
  double lowest = INFINITY;
  for (const double height : grid.heights) {
    if (is_known(height)) lowest = std::min(lowest, height);
  }
  if (!std::isfinite(lowest)) lowest = 0;
  for (double& height : grid.heights) {
    if (!is_known(height)) height = lowest;
  }
}

}  // namespace

bool IsTiff(const unsigned char* bytes, std::size_t size) {
  return size > 8 && (std::memcmp(bytes, "II*\0", 4) == 0 || std::memcmp(bytes, "MM\0*", 4) == 0);
}

base::Result<std::shared_ptr<model::Image>> DecodeTiff(const unsigned char* data, std::size_t size,
                                                       const std::string& source,
                                                       const ReadLimits& limits) {
  BytesInMemory bytes{data, size};
  const Tiff tiff = OpenInMemory(bytes);
  const auto pixels = SizeOf(tiff.get(), source, limits);
  if (!pixels) return Fail(pixels.error());
  const std::size_t count = static_cast<std::size_t>(pixels->width) * pixels->height;
  std::vector<std::uint32_t> raster(count);
  if (TIFFReadRGBAImageOriented(tiff.get(), pixels->width, pixels->height, raster.data(),
                                ORIENTATION_TOPLEFT, 0) != 1) {
    return Fail(ErrorCode::kBadModel, "the TIFF image cannot be decoded; convert it to PNG",
                source);
  }
  const bool is_opaque = std::all_of(raster.begin(), raster.end(),
                                     [](std::uint32_t pixel) { return TIFFGetA(pixel) == 255; });
  auto image = std::make_shared<model::Image>(model::Image{static_cast<int>(pixels->width),
                                                           static_cast<int>(pixels->height),
                                                           is_opaque ? 3 : 4,
                                                           {},
                                                           source});
  image->pixels.reserve(count * static_cast<std::size_t>(image->channels));
  for (const std::uint32_t pixel : raster) {
    image->pixels.push_back(static_cast<std::uint8_t>(TIFFGetR(pixel)));
    image->pixels.push_back(static_cast<std::uint8_t>(TIFFGetG(pixel)));
    image->pixels.push_back(static_cast<std::uint8_t>(TIFFGetB(pixel)));
    if (!is_opaque) image->pixels.push_back(static_cast<std::uint8_t>(TIFFGetA(pixel)));
  }
  return image;
}

base::Result<HeightGrid> ReadTiffHeights(const std::filesystem::path& path,
                                         const ReadLimits& limits) {
  PrepareLibrary();
  std::error_code error;
  const auto bytes = std::filesystem::file_size(path, error);
  if (error || bytes > limits.texture_bytes) {
    return Fail(error ? ErrorCode::kNotFound : ErrorCode::kBadModel,
                error ? std::string("the heightmap cannot be read")
                      : "the heightmap is larger than the limit of " +
                            std::to_string(limits.texture_bytes) + " bytes",
                path.string());
  }
  const Tiff tiff{TIFFOpen(path.c_str(), "rm"), TIFFClose};
  const auto size = SizeOf(tiff.get(), path.string(), limits);
  if (!size) return Fail(size.error());
  const Sample sample = SampleOf(tiff.get());
  if (!sample.IsKnown()) {
    return Fail(
        ErrorCode::kBadModel,
        "the format of the heights is not supported; use whole numbers of 8, 16 or 32 bits, "
        "or floating-point numbers",
        path.string());
  }
  HeightGrid grid{static_cast<int>(size->width), static_cast<int>(size->height), {}, {}};
  const bool is_read = TIFFIsTiled(tiff.get()) != 0 ? ReadTiles(tiff.get(), sample, grid)
                                                    : ReadRows(tiff.get(), sample, grid);
  if (!is_read) return Fail(ErrorCode::kBadModel, "the TIFF file is damaged", path.string());
  FillUnknown(tiff.get(), grid);
  grid.spacing = SpacingOf(tiff.get());
  return grid;
}

}  // namespace gsv::formats
