#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "gsv/formats/images/texture_reader.h"
#include "gsv/reality/maps/occupancy_map.h"

namespace gsv::reality {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxSide = 16'384;
constexpr double kMaxMapCells = 64e6;
constexpr std::uintmax_t kMaxYaml = 1u << 20, kMaxImage = 256u << 20;

base::Result<std::string> Contents(const fs::path& path, std::uintmax_t limit) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) {
    return base::Fail(base::ErrorCode::kNotFound, "no such file", path.string());
  }
  const auto size = fs::file_size(path, error);
  if (error || size > limit) {
    return base::Fail(base::ErrorCode::kBadModel,
                      fmt::format("the file has {} bytes; the limit is {} bytes", size, limit),
                      path.string());
  }
  std::ifstream file(path, std::ios::binary);
  return std::string((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
}

// Grey values from 0 (black) to 1 (white), rows from the top. A negative value means transparent.
struct Grey {
  int width = 0, height = 0;
  std::vector<float> values;
};

base::Status CheckSize(double width, double height, const fs::path& path) {
  if (width >= 1 && height >= 1 && width <= kMaxSide && height <= kMaxSide &&
      width * height <= kMaxMapCells) {
    return {};
  }
  return base::Fail(
      base::ErrorCode::kBadModel,
      fmt::format("the image has {} by {} pixels; each side must have 1 to {} pixels, "
                  "and the image at most {} million",
                  width, height, kMaxSide, kMaxMapCells / 1e6),
      path.string());
}

// Reads the formats P2 and P5 of Netpbm (https://netpbm.sourceforge.net/doc/pgm.html).
class PgmReader {
 public:
  PgmReader(const std::string& bytes, const fs::path& path) : bytes_(bytes), path_(path) {}

  base::Result<Grey> Read() {
    const bool is_binary = bytes_[1] == '5';
    at_ = 2;
    const auto width = Number(), height = Number(), white = Number();
    if (!width || !height || !white) return Fail("the PGM's header is cut off");
    if (auto ok = CheckSize(*width, *height, path_); !ok) return base::Fail(ok.error());
    if (!(*white >= 1 && *white <= 65535)) {
      return Fail(fmt::format("the PGM's largest value is {}; it must be 1 to 65535", *white));
    }
    Grey grey{*width, *height, {}};
    const auto count = static_cast<std::size_t>(*width) * static_cast<std::size_t>(*height);
    grey.values.reserve(count);
    ++at_;  // skips the one blank after the header
    for (std::size_t i = 0; i < count; ++i) {
      const auto value = is_binary ? Sample(*white > 255) : Number();
      if (!value) {
        return Fail(fmt::format("the PGM is cut off: it has {} of {} pixels", i, count));
      }
      grey.values.push_back(static_cast<float>(std::min(*value, *white)) /
                            static_cast<float>(*white));
    }
    return grey;
  }

 private:
  base::Failure<base::Error> Fail(std::string sentence) const {
    return base::Fail(base::ErrorCode::kBadModel, std::move(sentence), path_.string());
  }
  std::optional<int> Number() {
    while (at_ < bytes_.size()) {
      if (bytes_[at_] == '#') {
        while (at_ < bytes_.size() && bytes_[at_] != '\n') ++at_;
      } else if (bytes_[at_] >= '0' && bytes_[at_] <= '9') {
        break;
      } else {
        ++at_;
      }
    }
    int value = 0;
    const auto [rest, error] =
        std::from_chars(bytes_.data() + at_, bytes_.data() + bytes_.size(), value);
    if (error != std::errc()) return std::nullopt;
    at_ = static_cast<std::size_t>(rest - bytes_.data());
    return value;
  }
  std::optional<int> Sample(bool is_wide) {
    const auto byte = [&] { return static_cast<int>(static_cast<unsigned char>(bytes_[at_++])); };
    if (at_ + (is_wide ? 2 : 1) > bytes_.size()) return std::nullopt;
    const int first = byte();
    return is_wide ? first * 256 + byte() : first;
  }

  const std::string& bytes_;
  const fs::path path_;
  std::size_t at_ = 0;
};

base::Result<Grey> DecodeGrey(const std::string& bytes, const fs::path& path) {
  if (bytes.size() > 2 && bytes[0] == 'P' && (bytes[1] == '2' || bytes[1] == '5')) {
    return PgmReader(bytes, path).Read();
  }
  const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
  if (bytes.size() > 24 && bytes.compare(1, 3, "PNG") == 0) {
    const auto word = [&](int at) {
      return double(data[at]) * 16777216 + data[at + 1] * 65536 + data[at + 2] * 256 + data[at + 3];
    };
    if (auto ok = CheckSize(word(16), word(20), path); !ok) return base::Fail(ok.error());
  }
  formats::ReadLimits limits;
  limits.texture_side = kMaxSide;
  const auto image = formats::DecodeImage(data, bytes.size(), path.string(), limits);
  if (!image) return base::Fail(image.error());
  const model::Image& pixels = **image;
  if (auto ok = CheckSize(pixels.width, pixels.height, path); !ok) return base::Fail(ok.error());
  Grey grey{pixels.width, pixels.height, {}};
  const auto channels = static_cast<std::size_t>(pixels.channels);
  for (std::size_t i = 0; i + channels <= pixels.pixels.size(); i += channels) {
    const auto* p = &pixels.pixels[i];
    const bool is_clear = channels == 4 && p[3] < 255;
    grey.values.push_back(is_clear ? -1 : static_cast<float>(p[0] + p[1] + p[2]) / (3 * 255));
  }
  return grey;
}

struct MapSettings {
  std::string image, mode = "trinary";
  double resolution = 0, occupied = 0.65, free = 0.196;
  double origin[3] = {0, 0, 0};
  bool is_negated = false;
};

base::Result<MapSettings> ReadSettings(const fs::path& path) {
  const auto fail = [&](const std::string& sentence) {
    return base::Fail(base::ErrorCode::kBadModel, sentence, path.string());
  };
  const auto text = Contents(path, kMaxYaml);
  if (!text) return base::Fail(text.error());
  if (text->starts_with("P5") || text->starts_with("P2") || text->find("PNG") == 1) {
    return fail("this is the map's image; name its YAML file instead");
  }
  MapSettings settings;
  std::string key;  // the key that is being read
  try {
    const YAML::Node map = YAML::Load(*text);
    if (!map.IsMap() || !map["image"] || !map["resolution"]) {
      return fail("the file must be a mapping with at least image and resolution");
    }
    const auto number = [&](const char* name, double& value) {
      key = name;
      if (map[name]) value = map[name].as<double>();
    };
    key = "image";
    settings.image = map[key].as<std::string>();
    number("resolution", settings.resolution);
    key = "mode";
    if (map[key]) settings.mode = map[key].as<std::string>();
    number("occupied_thresh", settings.occupied);
    number("free_thresh", settings.free);
    key = "negate";
    if (map["negate"]) {
      const auto negate = map["negate"].as<std::string>();
      settings.is_negated = negate == "1" || negate == "true";
    }
    key = "origin";
    if (const YAML::Node origin = map["origin"]) {
      if (!origin.IsSequence() || origin.size() < 2 || origin.size() > 3) {
        return fail("origin must be [x, y, yaw]");
      }
      for (std::size_t i = 0; i < origin.size(); ++i) settings.origin[i] = origin[i].as<double>();
    }
  } catch (const YAML::BadConversion& exception) {
    return fail(
        fmt::format("line {}: {} must be a {}", exception.mark.line + 1, key,
                    key == "image" || key == "mode" || key == "negate" ? "text" : "number"));
  } catch (const YAML::Exception& exception) {
    return fail(
        fmt::format("line {}: it is not valid YAML: {}", exception.mark.line + 1, exception.msg));
  }
  if (!(settings.resolution >= 1e-3 && settings.resolution <= 100)) {
    return fail(fmt::format("resolution is {}; it must be 0.001 to 100 m", settings.resolution));
  }
  if (!(settings.free >= 0 && settings.free <= settings.occupied && settings.occupied <= 1)) {
    return fail(
        fmt::format("free_thresh is {} and occupied_thresh is {}; 0 <= free_thresh <= "
                    "occupied_thresh <= 1 is required",
                    settings.free, settings.occupied));
  }
  for (const double each : settings.origin) {
    if (!(std::abs(each) <= 1e6)) return fail("origin must be finite and within 1000 km");
  }
  if (settings.mode != "trinary" && settings.mode != "scale" && settings.mode != "raw") {
    return fail(fmt::format("mode is \"{}\"; it must be trinary, scale or raw", settings.mode));
  }
  return settings;
}

// Converts a pixel to a cell. In the mode raw, the value is the occupancy in percent, and values
// above 100 mean unknown.
Cell CellOf(const MapSettings& settings, float white) {
  if (white < 0) return Cell::kUnknown;
  double occupancy = settings.is_negated ? white : 1 - white;
  if (settings.mode == "raw") {
    if (white > 100.5 / 255) return Cell::kUnknown;
    occupancy = white * 2.55;
  }
  if (occupancy > settings.occupied) return Cell::kOccupied;
  return occupancy < settings.free ? Cell::kFree : Cell::kUnknown;
}

}  // namespace

base::Result<OccupancyMap> ReadMap(const fs::path& yaml, base::Problems& problems) {
  const auto settings = ReadSettings(yaml);
  if (!settings) return base::Fail(settings.error());
  fs::path path = settings->image;
  if (path.is_relative()) path = yaml.parent_path() / path;
  const auto bytes = Contents(path, kMaxImage);
  if (!bytes) return base::Fail(bytes.error());
  const auto grey = DecodeGrey(*bytes, path);
  if (!grey) return base::Fail(grey.error());
  OccupancyMap map;
  map.width = grey->width, map.height = grey->height;
  map.resolution = settings->resolution;
  map.origin_x = settings->origin[0], map.origin_y = settings->origin[1];
  map.origin_yaw = settings->origin[2];
  map.cells.reserve(grey->values.size());
  const auto width = static_cast<std::size_t>(map.width);
  for (int y = map.height - 1; y >= 0; --y) {
    for (std::size_t x = 0; x < width; ++x) {
      map.cells.push_back(CellOf(*settings, grey->values[static_cast<std::size_t>(y) * width + x]));
    }
  }
  const auto occupied = std::count(map.cells.begin(), map.cells.end(), Cell::kOccupied);
  if (occupied == 0 || 2 * static_cast<std::size_t>(occupied) > map.cells.size()) {
    problems.push_back({base::Problem::Severity::kWarning,
                        fmt::format("{} of {} cells are occupied; check negate and the thresholds",
                                    occupied, map.cells.size()),
                        yaml.string()});
  }
  return map;
}

base::Result<OccupancyMap> ReadBeesoftMap(const fs::path& path) {
  const auto text = Contents(path, kMaxImage);
  if (!text) return base::Fail(text.error());
  std::istringstream in(*text);
  const MapSettings thresholds;  // map_server's
  OccupancyMap map;
  std::string word;
  double resolution = 10;
  while (in >> word && word != "global_map[0]:") {
    if (word == "robot_specifications->resolution") in >> resolution;
  }
  map.resolution = resolution * 1e-2;
  if (!(in >> map.width >> map.height)) {
    return base::Fail(base::ErrorCode::kBadModel, "there is no line global_map[0]: WIDTH HEIGHT",
                      path.string());
  }
  if (auto ok = CheckSize(map.width, map.height, path); !ok) return base::Fail(ok.error());
  const auto width = static_cast<std::size_t>(map.width);
  const auto height = static_cast<std::size_t>(map.height);
  map.cells.resize(width * height, Cell::kUnknown);
  // A row of the file contains all cells with one x.
  for (std::size_t x = 0; x < width; ++x) {
    for (std::size_t y = 0; y < height; ++y) {
      double free = 0;
      if (!(in >> free)) {
        return base::Fail(base::ErrorCode::kBadModel,
                          fmt::format("the map is cut off: it has {} of {} cells", x * height + y,
                                      width * height),
                          path.string());
      }
      map.cells[y * width + x] =
          free < 0 ? Cell::kUnknown : CellOf(thresholds, static_cast<float>(free));
    }
  }
  return map;
}

}  // namespace gsv::reality
