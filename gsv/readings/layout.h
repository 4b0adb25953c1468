// What the values and labels of a sensor type's readings are: names, units and counts, as data.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "gsv/base/error.h"

namespace gsv::readings {

enum class Multiplicity {
  kOnce,
  kOptional,  // once, or missing at the end
  kRepeated,  // any number of times, to the end
};

// Where a field stands: in which others, and what it has from them.
struct Place {
  std::string name;  // "touches.point.x"
  std::string unit;  // of the innermost field that has one
  std::string path;  // in the message: "contacts.point.x"
  Multiplicity occurs = Multiplicity::kOnce;

  // `path` null: as the name.
  Place Inside(const char* field, const char* field_unit, const char* field_path) const;
};

struct Layout {
  struct Column {
    std::string name;  // "angular_velocity.x"
    std::string unit;  // empty: none
    std::string path;  // in the type's message
    Multiplicity occurs = Multiplicity::kOnce;
  };
  // In the order of a reading: first those that occur once. Those that occur repeatedly form a
  // group, which is repeated as a whole.
  std::vector<Column> values, labels;

  void AddValue(const Place& place) { values.push_back(ColumnAt(place)); }
  void AddLabel(const Place& place) { labels.push_back(ColumnAt(place)); }

  // For people: "range (m)", "each: point.x, .y, .z (m), … [other]".
  std::string Text() const;
  // How many values and labels a reading has: "6 or 10 values", "groups of 8 values and 1 label".
  std::string Sizes() const;
  // Units by path in the message; a path stands for all below it.
  std::map<std::string, std::string> Units() const;

 private:
  static Column ColumnAt(const Place& place) {
    return {place.name, place.unit, place.path, place.occurs};
  }
};

// kCorrupt: what the layout expects, and what was found.
base::Error WrongSize(const Layout& layout, std::size_t values, std::size_t labels,
                      const std::string& where);

}  // namespace gsv::readings
