// A SupportTable has the tables of element_tables.h as a tree: GSV's support of each element of
// SDFormat and URDF.
//
// Threads  immutable once built.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gsv::formats {

// How well GSV supports an element, an attribute or a plugin.
enum class Support {
  kFull,
  kPartial,
  kNone,
  kNoEffect,  // without effect on a simulation, such as settings of a window
};

// An element or attribute, and its content.
struct ElementSupport {
  std::string name;  // without "@"
  Support support = Support::kFull;
  int since = 0, until = 0;  // first and last minor version of SDFormat 1 (0: still exists)
  bool is_repeatable = false;
  std::optional<std::string_view> otherwise;  // text with the same meaning as a missing element
  std::string_view note;                      // a clause about the replacement in GSV; may be empty

  // Returns the child element with that name; null if the format does not define it here.
  const ElementSupport* Child(std::string_view child) const;
  // Returns the attribute with that name; null if the format does not define it here.
  const ElementSupport* Attribute(std::string_view attribute) const;

  using ByName = std::map<std::string, std::unique_ptr<ElementSupport>, std::less<>>;
  ByName children, attributes;
  // The definition whose elements and attributes are also allowed here; null if there is none.
  const ElementSupport* definition = nullptr;

  // Other definitions whose elements are also allowed here (for URDF's <gazebo>).
  std::vector<const ElementSupport*> borrowed;
};

// A row of the plugin table: GSV's support of one plugin of Gazebo.
struct PluginSupport {
  Support support;
  std::string_view part;  // part of the file or class name, lower case, no "-" and "_"
  std::string_view note;  // a clause about the replacement in GSV; may be empty
};

// GSV's support of each element of SDFormat and URDF.
class SupportTable {
 public:
  // Returns the program's table. Aborts if a row cannot be read.
  static const SupportTable& Get();

  const ElementSupport& sdf() const { return Definition("root"); }
  const ElementSupport& urdf() const { return Definition("robot"); }
  // Returns the definition with that name.
  const ElementSupport& Definition(std::string_view name) const;

  // Returns the row of the plugin with this file or class name; null if there is none.
  const PluginSupport* Plugin(std::string_view file_name, std::string_view class_name) const;

 private:
  SupportTable();
  // Returns the definition with that name, and creates it if necessary.
  ElementSupport& DefinitionToFill(std::string_view name);
  // Reads a table of elements.
  void ReadElements(std::string_view table);
  // Reads a row of a table into a definition.
  void ReadRow(std::string_view line, ElementSupport& definition);
  // Reads the table of plugins.
  void ReadPlugins(std::string_view table);

  ElementSupport::ByName definitions_;  // the definitions of element_tables.h, such as "box_shape"
  std::vector<PluginSupport> plugins_;
};

}  // namespace gsv::formats
