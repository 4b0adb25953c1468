#include "gsv/formats/files/read_limits.h"

#include <charconv>
#include <limits>
#include <variant>

namespace gsv::formats {
namespace {

struct Named {
  const char* name;
  std::variant<std::size_t ReadLimits::*, int ReadLimits::*> member;
};

constexpr Named kNamed[] = {
    {"xml_bytes", &ReadLimits::xml_bytes},
    {"xml_depth", &ReadLimits::xml_depth},
    {"include_depth", &ReadLimits::include_depth},
    {"models_in_world", &ReadLimits::models_in_world},
    {"mesh_bytes", &ReadLimits::mesh_bytes},
    {"mesh_triangles", &ReadLimits::mesh_triangles},
    {"mesh_vertices", &ReadLimits::mesh_vertices},
    {"texture_bytes", &ReadLimits::texture_bytes},
    {"texture_side", &ReadLimits::texture_side},
    {"heightmap_side", &ReadLimits::heightmap_side},
};

std::string Names() {
  std::string names;
  for (const Named& named : kNamed) names += (names.empty() ? "" : ", ") + std::string(named.name);
  return names;
}

}  // namespace

base::Status SetLimit(const std::string& text, ReadLimits& limits) {
  const std::size_t equals = text.find('=');
  const std::string name = text.substr(0, equals);
  for (const Named& named : kNamed) {
    if (name != named.name || equals == std::string::npos) continue;
    const char* const first = text.data() + equals + 1;
    const char* const last = text.data() + text.size();
    const bool is_int = std::holds_alternative<int ReadLimits::*>(named.member);
    const std::size_t most =
        is_int ? std::numeric_limits<int>::max() / 2 : std::numeric_limits<std::size_t>::max() / 2;
    std::size_t value = 0;
    const auto [end, error] = std::from_chars(first, last, value);
    if (error != std::errc() || end != last || value == 0 || value > most) {
      return base::Fail(base::ErrorCode::kInvalidArgument,
                        name + " must be a whole number above zero, at most " +
                            std::to_string(most) + ", not \"" + std::string(first, last) + "\"");
    }
    if (is_int) {
      limits.*std::get<int ReadLimits::*>(named.member) = static_cast<int>(value);
    } else {
      limits.*std::get<std::size_t ReadLimits::*>(named.member) = value;
    }
    return {};
  }
  return base::Fail(base::ErrorCode::kInvalidArgument,
                    "expected NAME=NUMBER with one of " + Names() + ", not \"" + text + "\"");
}

}  // namespace gsv::formats
