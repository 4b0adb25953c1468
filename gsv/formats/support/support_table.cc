#include "gsv/formats/support/support_table.h"

#include <cctype>
#include <charconv>

#include "gsv/base/check.h"
#include "gsv/formats/support/element_tables.h"

namespace gsv::formats {
namespace {

std::string_view TrimmedField(std::string_view text) {
  const std::size_t first = text.find_first_not_of(' ');
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(' ') - first + 1);
}

// Removes the text before `separator` and returns it; the whole text if there is no separator.
std::string_view TakeUntil(std::string_view& text, std::string_view separator) {
  const std::size_t end = text.find(separator);
  const std::string_view taken = text.substr(0, end);
  text = end == std::string_view::npos ? std::string_view() : text.substr(end + separator.size());
  return taken;
}

Support SupportOf(std::string_view sign) {
  if (sign == "+") return Support::kFull;
  if (sign == "~") return Support::kPartial;
  if (sign == "-") return Support::kNone;
  GSV_CHECK(sign == ".");
  return Support::kNoEffect;
}

// Returns 9 for "1.9", and 0 for an empty text.
int MinorVersion(std::string_view text) {
  if (text.empty()) return 0;
  int minor = 0;
  GSV_CHECK(text.substr(0, 2) == "1." &&
            std::from_chars(text.data() + 2, text.data() + text.size(), minor).ec == std::errc());
  return minor;
}

template <typename Take>
void ForEachLine(std::string_view table, Take take) {
  while (!table.empty()) {
    const std::string_view line = TakeUntil(table, "\n");
    if (!line.empty()) take(line);
  }
}

std::string LowerCaseName(std::string_view name) {
  std::string plain;
  for (const char c : name) {
    if (c != '-' && c != '_')
      plain += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return plain;
}

const ElementSupport* Find(const ElementSupport::ByName& where, std::string_view name) {
  const auto it = where.find(name);
  return it == where.end() ? nullptr : it->second.get();
}

ElementSupport& Entry(ElementSupport::ByName& where, std::string_view name) {
  auto& entry = where[std::string(name)];
  if (entry == nullptr) {
    entry = std::make_unique<ElementSupport>();
    entry->name = name;
  }
  return *entry;
}

}  // namespace

const ElementSupport* ElementSupport::Child(std::string_view child) const {
  if (const auto* own = Find(children, child)) return own;
  if (definition != nullptr) {
    if (const auto* defined = definition->Child(child)) return defined;
  }
  for (const ElementSupport* other : borrowed) {
    if (const auto* taken = other->Child(child)) return taken;
  }
  return nullptr;
}

const ElementSupport* ElementSupport::Attribute(std::string_view attribute) const {
  if (const auto* own = Find(attributes, attribute)) return own;
  return definition == nullptr ? nullptr : definition->Attribute(attribute);
}

const SupportTable& SupportTable::Get() {
  static const SupportTable table;
  return table;
}

SupportTable::SupportTable() {
  for (const std::string_view table :
       {kWorldElements, kModelElements, kSensorElements, kUrdfElements}) {
    ReadElements(table);
  }
  ReadPlugins(kKnownPlugins);
  // libsdformat moves the content of URDF's <gazebo> into the link, joint or model.
  ElementSupport& gazebo = DefinitionToFill("gazebo");
  for (const char* part : {"link", "joint", "model"}) {
    gazebo.borrowed.push_back(&Definition(part));
  }
}

const ElementSupport& SupportTable::Definition(std::string_view name) const {
  const ElementSupport* found = Find(definitions_, name);
  GSV_CHECK(found != nullptr);
  return *found;
}

ElementSupport& SupportTable::DefinitionToFill(std::string_view name) {
  return Entry(definitions_, name);
}

void SupportTable::ReadElements(std::string_view table) {
  ElementSupport* definition = nullptr;
  ForEachLine(table, [&](std::string_view line) {
    if (line.front() == '[') {
      definition = &DefinitionToFill(line.substr(1, line.size() - 2));
    } else {
      GSV_CHECK(definition != nullptr);
      ReadRow(line, *definition);
    }
  });
}

void SupportTable::ReadRow(std::string_view line, ElementSupport& definition) {
  std::string_view rest = line;
  std::string_view fields = TakeUntil(rest, " ;");
  const std::string_view note = TrimmedField(rest);
  std::string_view before_default = TakeUntil(fields, " =");
  const bool has_default = fields.data() != nullptr;
  const std::string_view otherwise = TrimmedField(fields);

  std::string_view path = TakeUntil(before_default, " ");
  const std::string_view sign = TakeUntil(before_default, " ");
  std::string_view versions = TrimmedField(before_default);
  const bool is_repeatable = path.back() == '*';
  if (is_repeatable) path.remove_suffix(1);
  std::string_view shape = path;
  path = TakeUntil(shape, ":");

  ElementSupport* at = &definition;
  while (path.find('/') != std::string_view::npos) {
    at = &Entry(at->children, TakeUntil(path, "/"));
  }
  const bool is_attribute = path.front() == '@';
  ElementSupport& row =
      is_attribute ? Entry(at->attributes, path.substr(1)) : Entry(at->children, path);
  row.support = SupportOf(sign);
  row.since = MinorVersion(TakeUntil(versions, "-"));
  row.until = MinorVersion(versions);
  row.is_repeatable = is_repeatable;
  if (has_default) row.otherwise = otherwise;
  row.note = note;
  if (!shape.empty()) row.definition = &DefinitionToFill(shape);
}

void SupportTable::ReadPlugins(std::string_view table) {
  ForEachLine(table, [&](std::string_view line) {
    const std::string_view sign = TakeUntil(line, " ");
    const std::string_view part = TakeUntil(line, ";");
    plugins_.push_back({SupportOf(sign), part, TrimmedField(line)});
  });
}

const PluginSupport* SupportTable::Plugin(std::string_view file_name,
                                          std::string_view class_name) const {
  for (const std::string_view name : {file_name, class_name}) {
    const std::string plain = LowerCaseName(name);
    for (const PluginSupport& known : plugins_) {
      if (plain.find(known.part) != std::string::npos) return &known;
    }
  }
  return nullptr;
}

}  // namespace gsv::formats
