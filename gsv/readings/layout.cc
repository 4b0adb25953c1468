#include "gsv/readings/layout.h"

#include "gsv/base/counted.h"

#include <algorithm>

namespace gsv::readings {
namespace {

using Columns = std::vector<Layout::Column>;

std::string Joined(const std::string& outer, const std::string& inner) {
  return outer.empty() || inner.empty() ? outer + inner : outer + "." + inner;
}

std::size_t CountOf(const Columns& columns, Multiplicity occurs) {
  return static_cast<std::size_t>(
      std::count_if(columns.begin(), columns.end(),
                    [&](const Layout::Column& column) { return column.occurs == occurs; }));
}

// Returns a text such as "3 values and 1 label"; empty if both are 0.
std::string Counted(std::size_t values, std::size_t labels) {
  const std::string names = labels > 0 ? base::Counted(labels, "label") : "";
  if (values == 0) return names;
  return base::Counted(values, "value") + (names.empty() ? "" : " and " + names);
}

// Shortens a name: "point.x" after "point.y" becomes ".x".
std::string Shortened(const std::string& name, const std::string& before) {
  const std::size_t dot = name.rfind('.');
  const bool is_beside = dot != std::string::npos && before.size() > dot &&
                         before.compare(0, dot + 1, name, 0, dot + 1) == 0;
  return is_beside ? name.substr(dot) : name;
}

// Returns the names. If adjacent columns have the same unit, the unit appears once, after their
// names.
std::string Listed(const Columns& columns, Multiplicity occurs) {
  std::string text, before;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const Layout::Column& column = columns[i];
    if (column.occurs != occurs) continue;
    // In a group, the name of the list is left out.
    std::string name = column.name;
    if (occurs == Multiplicity::kRepeated) name = name.substr(name.find('.') + 1);
    text += (text.empty() ? "" : ", ") + Shortened(name, before);
    before = name;
    const bool ends_unit = i + 1 == columns.size() || columns[i + 1].unit != column.unit ||
                           columns[i + 1].occurs != occurs;
    if (ends_unit && !column.unit.empty()) text += " (" + column.unit + ")";
  }
  return text;
}

std::string Listed(const Columns& columns) {
  const std::string once = Listed(columns, Multiplicity::kOnce);
  const std::string perhaps = Listed(columns, Multiplicity::kOptional);
  const std::string repeatedly = Listed(columns, Multiplicity::kRepeated);
  std::string text = once;
  if (!perhaps.empty()) text += "; perhaps " + perhaps;
  if (!repeatedly.empty()) text += (text.empty() ? "each: " : "; then each: ") + repeatedly;
  return text;
}

}  // namespace

Place Place::Inside(const char* field, const char* field_unit, const char* field_path) const {
  return {Joined(name, field), *field_unit != '\0' ? field_unit : unit,
          Joined(path, field_path != nullptr ? field_path : field), occurs};
}

std::string Layout::Text() const {
  const std::string names = Listed(labels);
  return Listed(values) + (names.empty() ? "" : " [" + names + "]");
}

std::string Layout::Sizes() const {
  const std::size_t once = CountOf(values, Multiplicity::kOnce);
  const std::size_t perhaps = CountOf(values, Multiplicity::kOptional);
  std::string text = Counted(once, CountOf(labels, Multiplicity::kOnce));
  if (perhaps > 0) text = std::to_string(once) + " or " + Counted(once + perhaps, 0);
  const std::string group =
      Counted(CountOf(values, Multiplicity::kRepeated), CountOf(labels, Multiplicity::kRepeated));
  if (group.empty()) return text;
  return text.empty() ? "groups of " + group : text + ", then groups of " + group;
}

std::map<std::string, std::string> Layout::Units() const {
  std::map<std::string, std::string> units;
  for (const Column& column : values) {
    if (!column.unit.empty() && !column.path.empty()) units.emplace(column.path, column.unit);
  }
  return units;
}

base::Error WrongSize(const Layout& layout, std::size_t values, std::size_t labels,
                      const std::string& where) {
  return {base::ErrorCode::kCorrupt,
          "a reading has the wrong size: expected " + layout.Sizes() + ", found " +
              base::Counted(values, "value") + " and " + base::Counted(labels, "label"),
          where};
}

}  // namespace gsv::readings
