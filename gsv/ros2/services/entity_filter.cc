#include "gsv/ros2/services/entity_filter.h"

#include <regex.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <string>

#include "gsv/ros2/services/entity_bounds.h"

namespace gsv::ros2 {
namespace {

using messages::simulation_interfaces::Bounds;
using messages::simulation_interfaces::EntityCategory;
using messages::simulation_interfaces::EntityFilters;

constexpr std::size_t kMaxExpression = 256;

// A POSIX extended regular expression.
class Expression {
 public:
  static base::Result<std::unique_ptr<Expression>> Compile(const std::string& text) {
    const auto wrong = [&](const std::string& why) {
      return base::Fail(base::ErrorCode::kInvalidArgument,
                        "the filter '" + text.substr(0, kMaxExpression) + "' " + why);
    };
    if (text.size() > kMaxExpression) return wrong("is longer than 256 characters");
    if (text.find('\0') != std::string::npos) return wrong("holds a NUL");
    // Refuses two constructs: nested repetitions, for which regcomp() takes gigabytes, and back
    // references, for which regexec() takes years.
    if (text.find('{') != std::string::npos)
      return wrong("has a repetition {n}, which is not accepted");
    for (std::size_t i = 0; i + 1 < text.size(); ++i) {
      if (text[i] == '\\' && std::isdigit(static_cast<unsigned char>(text[i + 1])) != 0)
        return wrong("has a back reference, which is not accepted");
    }
    std::unique_ptr<Expression> expression(new Expression);
    const int code = regcomp(&expression->compiled_, text.c_str(), REG_EXTENDED | REG_NOSUB);
    if (code == 0) {
      expression->is_compiled_ = true;
      return expression;
    }
    char message[200];
    regerror(code, &expression->compiled_, message, sizeof message);
    return wrong(std::string("is not a regular expression: ") + message);
  }
  ~Expression() {
    if (is_compiled_) regfree(&compiled_);
  }
  Expression(const Expression&) = delete;
  Expression& operator=(const Expression&) = delete;

  bool Matches(const std::string& name) const {
    return regexec(&compiled_, name.c_str(), 0, nullptr, 0) == 0;
  }

 private:
  Expression() = default;

  regex_t compiled_{};
  bool is_compiled_ = false;
};

bool Overlap(const geometry::Bounds& a, const geometry::Bounds& b) {
  return a.min.x <= b.max.x && b.min.x <= a.max.x && a.min.y <= b.max.y && b.min.y <= a.max.y &&
         a.min.z <= b.max.z && b.min.z <= a.max.z;
}

double SquaredDistance(const geometry::Bounds& box, const messages::geometry_msgs::Vector3& p) {
  const auto outside = [](double value, double low, double high) {
    return std::max({low - value, value - high, 0.0});
  };
  const double x = outside(p.x, box.min.x, box.max.x), y = outside(p.y, box.min.y, box.max.y),
               z = outside(p.z, box.min.z, box.max.z);
  return x * x + y * y + z * z;
}

base::Status CheckBounds(const Bounds& bounds) {
  if (bounds.type == Bounds::kTypeEmpty) return {};
  if (bounds.type != Bounds::kTypeBox && bounds.type != Bounds::kTypeSphere) {
    return base::Fail(base::ErrorCode::kUnavailable,
                      "bounds of type " + std::to_string(bounds.type) +
                          " are not supported, only TYPE_BOX and TYPE_SPHERE");
  }
  if (bounds.points.size() == 2) return {};
  return base::Fail(base::ErrorCode::kInvalidArgument,
                    "bounds must have 2 points, found " + std::to_string(bounds.points.size()));
}

// A body without bounds passes every filter: it has an infinite plane, or no shapes.
bool Passes(const Bounds& bounds, const world::Snapshot& snapshot, int body) {
  if (bounds.type == Bounds::kTypeEmpty) return true;
  const auto own = BoundsOfBody(snapshot, body);
  if (!own) return true;
  const geometry::Bounds box =
      InWorld(*own, snapshot.state.bodies[static_cast<std::size_t>(body)].world_from_model);
  const auto &first = bounds.points[0], &second = bounds.points[1];
  if (bounds.type == Bounds::kTypeSphere) {
    return SquaredDistance(box, first) <= second.x * second.x;
  }
  return Overlap(
      box,
      {{std::min(first.x, second.x), std::min(first.y, second.y), std::min(first.z, second.z)},
       {std::max(first.x, second.x), std::max(first.y, second.y), std::max(first.z, second.z)}});
}

bool Passes(const std::vector<EntityCategory>& categories, const world::Body& body) {
  const std::uint8_t own = CategoryOf(body);
  return categories.empty() ||
         std::any_of(categories.begin(), categories.end(),
                     [&](const EntityCategory& each) { return each.category == own; });
}

}  // namespace

std::uint8_t CategoryOf(const world::Body& body) {
  if (body.is_avatar() || body.is_pedestrian()) return EntityCategory::kCategoryHuman;
  if (body.is_robot()) return EntityCategory::kCategoryRobot;
  if (body.is_static()) return EntityCategory::kCategoryStaticObject;
  return body.is_rigid() ? EntityCategory::kCategoryDynamicObject : EntityCategory::kCategoryObject;
}

base::Result<std::vector<int>> FilterEntities(const world::Snapshot& snapshot,
                                              const EntityFilters& filters) {
  if (!filters.tags.tags.empty()) {
    return base::Fail(base::ErrorCode::kUnavailable, "entities of gsv have no tags");
  }
  if (auto ok = CheckBounds(filters.bounds); !ok) return base::Fail(ok.error());
  std::unique_ptr<Expression> expression;
  if (!filters.filter.empty()) {
    auto compiled = Expression::Compile(filters.filter);
    if (!compiled) return base::Fail(compiled.error());
    expression = *std::move(compiled);
  }
  std::vector<int> passed;
  const std::vector<world::Body>& bodies = snapshot.layout->bodies;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const int index = static_cast<int>(i);
    if (expression != nullptr && !expression->Matches(bodies[i].name)) continue;
    if (Passes(filters.categories, bodies[i]) && Passes(filters.bounds, snapshot, index))
      passed.push_back(index);
  }
  return passed;
}

}  // namespace gsv::ros2
