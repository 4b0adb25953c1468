// The names, units and counts of the values and labels of a sensor type's readings.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "gsv/base/error.h"

namespace gsv::readings {

// The number of times that a column occurs in a reading.
enum class Multiplicity {
  kOnce,
  kOptional,  // once; or not at all, if a reading ends before it
  kRepeated,  // any number of times, up to the end of the values
};

// The place of a field in nested structs: its full name, its unit and its path in the message.
struct Place {
  std::string name;  // "touches.point.x"
  std::string unit;  // its unit, or else that of the innermost struct around it that has one
  std::string path;  // path in the message, such as "contacts.point.x"
  Multiplicity occurs = Multiplicity::kOnce;

  // Returns the place of a field of the struct at this place. If `field_path` is null, the field's
  // path is its name.
  Place Inside(const char* field, const char* field_unit, const char* field_path) const;
};

// The columns of a sensor type's readings.
struct Layout {
  struct Column {
    std::string name;  // "angular_velocity.x"
    std::string unit;  // empty if it has none
    std::string path;  // path in the type's message
    Multiplicity occurs = Multiplicity::kOnce;
  };
  // The columns in the order of a reading. Columns that occur once come first. Repeated columns
  // form a group; a reading contains the complete group several times.
  std::vector<Column> values, labels;

  void AddValue(const Place& place) { values.push_back(ColumnAt(place)); }
  void AddLabel(const Place& place) { labels.push_back(ColumnAt(place)); }

  // Returns a text for users, such as "range (m)" or "each: point.x, .y, .z (m), … [other]".
  std::string Text() const;
  // Returns the size of a reading as a text, such as "6 or 10 values" or "groups of 8 values and 1
  // label".
  std::string Sizes() const;
  // Returns the unit of each path in the message. The unit applies to all fields below the path.
  std::map<std::string, std::string> Units() const;

 private:
  static Column ColumnAt(const Place& place) {
    return {place.name, place.unit, place.path, place.occurs};
  }
};

// Returns the error kCorrupt with the expected and the actual size.
base::Error WrongSize(const Layout& layout, std::size_t values, std::size_t labels,
                      const std::string& where);

}  // namespace gsv::readings
