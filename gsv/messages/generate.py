#!/usr/bin/env python3
"""Makes C++ from ROS 2 message definitions: one header and one source per package.

  generate.py MSG_ROOT OUT PACKAGE/NAME...     the message types, and OUT/all.h
  generate.py --samples MSG_ROOT OUT PACKAGE/NAME...   OUT/samples.h, for tests

MSG_ROOT holds PACKAGE/NAME.msg. PACKAGE/NAME.srv names a service, whose definition is
MSG_ROOT/../srv/PACKAGE/NAME.srv: it becomes the types NAMERequest and NAMEResponse. PACKAGE/NAME.action names
an action in MSG_ROOT/../action, which becomes NAMEGoal, NAMEResult, NAMEFeedback and the types of its
services and topics (design.ros2.org, "Actions"). Every type that is used must be listed. A definition may
contain fields of primitive and message types, arrays of them (fixed, bounded, unbounded), constants, and
defaults of numbers. Anything else is refused with its file and line. The bound of an array is not in the
C++ type, which is a plain std::vector.
"""
import pathlib
import re
import sys
from dataclasses import dataclass, field

# ROS type -> (C++ type, size in bytes)
PRIMITIVES = {
    "bool": ("bool", 1), "byte": ("std::uint8_t", 1), "char": ("std::uint8_t", 1),
    "float32": ("float", 4), "float64": ("double", 8),
    **{f"{u}int{8 * n}": (f"std::{u}int{8 * n}_t", n) for u in ("", "u") for n in (1, 2, 4, 8)},
}
SIZES = dict(PRIMITIVES.values())  # bytes of a number, by C++ type
FIELD = re.compile(r"^([\w/]+)(\[((?:<=)?\d*)\])?\s+([a-z][a-z0-9_]*)(?:\s+(-?[\d.]+))?$")
CONSTANT = re.compile(r"^(\w+)\s+([A-Z][A-Z0-9_]*)\s*=\s*(-?[\d.]+)$")
SEPARATOR = "=" * 80


@dataclass
class Field:
    type: str  # a primitive, "string", or "package/Name"
    name: str
    array: str  # "" for one value, "[]" for a sequence, "[9]" for a fixed array
    default: str

    @property
    def length(self):
        return int(self.array[1:-1]) if self.array not in ("", "[]") else 1


@dataclass
class Message:
    package: str
    name: str
    text: str
    ros_name: str  # "sensor_msgs/msg/Range", "rcl_interfaces/srv/GetParameters_Request"
    fields: list = field(default_factory=list)
    constants: list = field(default_factory=list)  # (type, name, value)

    @property
    def key(self):
        return f"{self.package}/{self.name}"

    @property
    def text_name(self):
        """Returns the name by which other definitions refer to this type."""
        return self.ros_name if "/action/" in self.ros_name else self.key


def parse(root, key):
    """Returns the types of a key: the message, a service's request and response, or all types of an action."""
    package, name = key.split("/")
    if name.endswith(".action"):
        return parse_action(root, package, name)
    if not name.endswith(".srv"):
        path = root / package / f"{name}.msg"
        return [parse_text(path, Message(package, name, path.read_text(), f"{package}/msg/{name}"))]
    path = root.parent / "srv" / package / name
    name = name.removesuffix(".srv")
    halves = re.split(r"^---\n", path.read_text(), flags=re.MULTILINE)
    if len(halves) != 2:
        sys.exit(f"{path}: expected one line '---' between request and response")
    messages = []
    for half, text in zip(("Request", "Response"), halves):
        # A struct of IDL cannot be empty, so this adds the member that rosidl adds.
        text = text or "uint8 structure_needs_at_least_one_member\n"
        message = Message(package, name + half, text, f"{package}/srv/{name}_{half}")
        messages.append(parse_text(path, message))
    return messages


def parse_action(root, package, name):
    path = root.parent / "action" / package / name
    name = name.removesuffix(".action")
    parts = re.split(r"^---\n", path.read_text(), flags=re.MULTILINE)
    if len(parts) != 3:
        sys.exit(f"{path}: expected two lines '---': between goal, result and feedback")
    own = f"{package}/action/{name}"
    goal_id = "unique_identifier_msgs/UUID goal_id\n"
    texts = {
        **dict(zip(("Goal", "Result", "Feedback"), parts)),
        "SendGoal_Request": f"{goal_id}{own}_Goal goal\n",
        "SendGoal_Response": "bool accepted\nbuiltin_interfaces/Time stamp\n",
        "GetResult_Request": goal_id,
        "GetResult_Response": f"int8 status\n{own}_Result result\n",
        "FeedbackMessage": f"{goal_id}{own}_Feedback feedback\n",
    }
    return [parse_text(path, Message(package, name + part.replace("_", ""), text, f"{own}_{part}"))
            for part, text in texts.items()]


def key_of_type(type_, package):
    """Returns the key of a field's message type, from Name, package/Name or package/action/Name_Part."""
    parts = type_.split("/")
    if len(parts) == 1:
        return f"{package}/{type_}"
    return type_ if len(parts) == 2 else f"{parts[0]}/{parts[2].replace('_', '')}"


def parse_text(path, message):
    for number, line in enumerate(message.text.splitlines(), 1):
        line = line.split("#")[0].strip()
        if not line:
            continue
        if found := CONSTANT.match(line):
            message.constants.append(found.groups())
        elif found := FIELD.match(line):
            type_, array, bound, field_name, default = found.groups()
            if type_ not in PRIMITIVES and type_ != "string":
                type_ = key_of_type(type_, message.package)
            if bound and bound.startswith("<="):
                array = "[]"
            message.fields.append(Field(type_, field_name, array or "", default or ""))
        else:
            sys.exit(f"{path}:{number}: expected a field or a constant, found '{line}'")
    if not message.fields:
        sys.exit(f"{path}: a message needs at least one field")
    return message


class MessageSet:
    def __init__(self, root, keys):
        parsed = [message for key in keys for message in parse(root, key)]
        self.messages = {message.key: message for message in parsed}
        for message in self.messages.values():
            self.dependencies(message)  # checks that all types exist, and that none contains itself

    def dependencies(self, message, above=()):
        """Returns the keys of all types that a type contains, directly or not, each once, in order of first use."""
        found = []
        for f in message.fields:
            if "/" not in f.type:
                continue
            if f.type not in self.messages:
                sys.exit(f"{message.key}: field '{f.name}' has the unlisted type {f.type}")
            if f.type in above or f.type == message.key:
                sys.exit(f"{message.key}: field '{f.name}' contains its own type")
            inner = self.dependencies(self.messages[f.type], above + (message.key,))
            found += [key for key in (f.type, *inner) if key not in found]
        return found

    def in_order(self, package):
        """Returns a package's messages, in an order in which each comes after the messages that it contains."""
        ordered = []
        for message in self.messages.values():
            for key in (*reversed(self.dependencies(message)), message.key):
                if self.messages[key].package == package and self.messages[key] not in ordered:
                    ordered.append(self.messages[key])
        return ordered

    def packages(self):
        return sorted({message.package for message in self.messages.values()})

    def sorted_keys(self):
        return sorted(self.messages, key=lambda key: self.messages[key].ros_name)

    def schema_text(self, message):
        parts = [message.text]
        parts += [f"MSG: {self.messages[key].text_name}\n{self.messages[key].text}"
                  for key in self.dependencies(message)]
        return f"\n{SEPARATOR}\n".join(part.rstrip("\n") for part in parts) + "\n"

    def least_size(self, type_):
        """Returns a lower bound of the size of one value in bytes, without padding."""
        if type_ in PRIMITIVES:
            return PRIMITIVES[type_][1]
        if type_ == "string":
            return 4
        return sum(4 if f.array == "[]" else f.length * self.least_size(f.type)
                   for f in self.messages[type_].fields)

    def scalar_of(self, type_):
        """Returns the C++ type of the first number in a value if all its numbers have the same size, otherwise None.
        Such a value has the same bytes in memory as in CDR."""
        if type_ in PRIMITIVES:
            return None if type_ == "bool" else PRIMITIVES[type_][0]
        if type_ == "string" or any(f.array == "[]" for f in self.messages[type_].fields):
            return None
        scalars = [self.scalar_of(f.type) for f in self.messages[type_].fields]
        if None in scalars or len({SIZES[scalar] for scalar in scalars}) > 1:
            return None
        return scalars[0]


def cpp_type(type_):
    if type_ == "string":
        return "std::string"
    return PRIMITIVES[type_][0] if type_ in PRIMITIVES else type_.replace("/", "::")


def element_type(f):
    """Returns the C++ type of an element. A bool becomes a byte, because std::vector<bool> is packed."""
    return "std::uint8_t" if f.type == "bool" else cpp_type(f.type)


def field_declaration(f):
    if f.array == "[]":
        return f"  std::vector<{element_type(f)}> {f.name};"
    if f.array:
        return f"  std::array<{element_type(f)}, {f.length}> {f.name}{{}};"
    if f.type not in PRIMITIVES:
        return f"  {cpp_type(f.type)} {f.name};"
    value = f.default or ("false" if f.type == "bool" else "0")
    return f"  {cpp_type(f.type)} {f.name} = {value};"


def constant_declaration(constant):
    type_, name, value = constant
    camel = "k" + "".join(word.capitalize() for word in name.split("_"))
    return f"  static constexpr {cpp_type(type_)} {camel} = {value};"


def struct_declaration(message):
    lines = [f"struct {message.name} {{"]
    lines += [constant_declaration(constant) for constant in message.constants]
    lines += [field_declaration(f) for f in message.fields]
    lines += [f"\n  friend bool operator==(const {message.name}&, const {message.name}&) = default;",
              "};",
              f"void Encode(const {message.name}& message, CdrWriter& writer);",
              f"void Decode(CdrReader& reader, {message.name}& message);", ""]
    return lines


def header(messages, package):
    ordered = messages.in_order(package)
    used = {messages.messages[key].package for m in ordered for key in messages.dependencies(m)}
    lines = [f"// Generated from the definitions in gsv/messages/msg/{package}.",
             "#pragma once", "", "#include <array>", "#include <cstdint>", "#include <string>",
             "#include <vector>", "", '#include "gsv/messages/cdr.h"']
    lines += [f'#include "gsv/messages/{other}.h"' for other in sorted(used - {package})]
    lines += ["", f"namespace gsv::messages::{package} {{", ""]
    for message in ordered:
        lines += struct_declaration(message)
    lines += [f"}}  // namespace gsv::messages::{package}", "", "namespace gsv::messages {", ""]
    for m in ordered:
        lines += ["template <>", f"const Schema& SchemaOf<{package}::{m.name}>();"]
    return lines + ["", "}  // namespace gsv::messages"]


def encode_statements(messages, f):
    value = f"message.{f.name}"
    lines = [f"  writer.WriteCount({value}.size());"] if f.array == "[]" else []
    scalar = messages.scalar_of(f.type)
    if f.array and scalar:
        return lines + [f"  writer.WriteBlock({value}.data(), {value}.size() * "
                        f"sizeof({cpp_type(f.type)}), sizeof({scalar}));"]
    if not f.array and scalar and f.type not in PRIMITIVES:
        return [f"  writer.WriteBlock(&{value}, sizeof {value}, sizeof({scalar}));"]
    one = ("writer.Write({})" if f.type in PRIMITIVES or f.type == "string" else
           "Encode({}, writer)")
    if f.array:
        return lines + [f"  for (const auto& element : {value}) {one.format('element')};"]
    return [f"  {one.format(value)};"]


def decode_statements(messages, f):
    value = f"message.{f.name}"
    least = messages.least_size(f.type)
    lines = [f"  {value}.resize(reader.ReadCount({least}));"] if f.array == "[]" else []
    scalar = messages.scalar_of(f.type)
    if f.array and scalar:
        return lines + [f"  reader.ReadBlock({value}.data(), {value}.size() * "
                        f"sizeof({cpp_type(f.type)}), sizeof({scalar}));"]
    one = "reader.Read({})" if f.type in PRIMITIVES or f.type == "string" else "Decode(reader, {})"
    if f.array:
        return lines + [f"  for (auto& element : {value}) {one.format('element')};"]
    return [f"  {one.format(value)};"]


def memory_check(messages, message):
    """Returns assertions of the properties that WriteBlock requires of a type that is copied as one block."""
    if messages.scalar_of(message.key) is None:
        return []
    return [f"static_assert(sizeof({message.name}) == {messages.least_size(message.key)} && "
            f"std::is_trivially_copyable_v<{message.name}>);", ""]


def source(messages, package):
    ordered = messages.in_order(package)
    lines = [f'#include "gsv/messages/{package}.h"', "", f"namespace gsv::messages::{package} {{",
             ""]
    for message in ordered:
        lines += memory_check(messages, message)
        lines += [f"void Encode(const {message.name}& message, CdrWriter& writer) {{"]
        lines += [line for f in message.fields for line in encode_statements(messages, f)]
        lines += ["}", "", f"void Decode(CdrReader& reader, {message.name}& message) {{"]
        lines += [line for f in message.fields for line in decode_statements(messages, f)]
        lines += ["}", ""]
    lines += [f"}}  // namespace gsv::messages::{package}", "", "namespace gsv::messages {", ""]
    for m in ordered:
        lines += ["template <>", f"const Schema& SchemaOf<{package}::{m.name}>() {{",
                  f'  static constexpr Schema kSchema{{"{m.ros_name}", "ros2msg",',
                  f'      R"msg({messages.schema_text(m)})msg"}};',
                  "  return kSchema;", "}", ""]
    return lines + ["}  // namespace gsv::messages"]


def all_header(messages):
    return (["// Generated: every message type. Include a single package's header where one will do.",
             "#pragma once", "", "#include <array>", ""] +
            [f'#include "gsv/messages/{package}.h"' for package in messages.packages()] +
            ["", "namespace gsv::messages {", "", "// The schemas of all types, by name.",
             f"const std::array<Schema, {len(messages.messages)}>& AllSchemas();", "",
             "}  // namespace gsv::messages"])


def all_source(messages):
    return (['#include "gsv/messages/all.h"', "", "namespace gsv::messages {", "",
             f"const std::array<Schema, {len(messages.messages)}>& AllSchemas() {{",
             f"  static const std::array<Schema, {len(messages.messages)}> kSchemas{{"] +
            [f"      SchemaOf<{key.replace('/', '::')}>()," for key in messages.sorted_keys()] +
            ["  };", "  return kSchemas;", "}", "", "}  // namespace gsv::messages"])


def samples(messages):
    """Returns a function Fill() for each type. It sets every field to a test value (see sample_filler.h)."""
    lines = ["// Generated for tests.", "#pragma once", "", '#include "gsv/messages/all.h"', "",
             "namespace gsv::messages {", ""]
    ordered = []
    for message in messages.messages.values():
        for key in (*reversed(messages.dependencies(message)), message.key):
            if key not in ordered:
                ordered.append(key)
    for key in ordered:
        lines += ["template <typename Filler>",
                  f"void Fill({key.replace('/', '::')}& message, Filler& filler) {{"]
        for f in messages.messages[key].fields:
            value = f"message.{f.name}"
            one = "Fill({}, filler)" if "/" in f.type else "filler.Value({})"
            if f.type == "bool" and f.array:
                one = "{{ bool value; filler.Value(value); {} = value ? 1 : 0; }}"
            if f.array == "[]":
                lines += [f"  {value}.resize(filler.Count());"]
            lines += [f"  for (auto& element : {value}) {one.format('element')};" if f.array else
                      f"  {one.format(value)};"]
        lines += ["}", ""]
    lines += ["// Calls visit(SchemaOf<T>(), T{}) for every type T.",
              "template <typename Visitor>", "void ForEachType(Visitor&& visit) {"]
    for key in messages.sorted_keys():
        type_ = key.replace("/", "::")
        lines += [f"  visit(SchemaOf<{type_}>(), {type_}{{}});"]
    return lines + ["}", "", "}  // namespace gsv::messages"]


def write(path, lines):
    """Writes the file only if its content differs, so that nothing is compiled again for an unchanged file."""
    text = "\n".join(lines) + "\n"
    if not path.exists() or path.read_text() != text:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)


def main(arguments):
    for_tests = arguments[:1] == ["--samples"]
    root, out, *keys = arguments[1 if for_tests else 0:]
    messages, out = MessageSet(pathlib.Path(root), keys), pathlib.Path(out)
    if for_tests:
        write(out / "samples.h", samples(messages))
        return
    for package in messages.packages():
        write(out / f"{package}.h", header(messages, package))
        write(out / f"{package}.cc", source(messages, package))
    write(out / "all.h", all_header(messages))
    write(out / "all.cc", all_source(messages))


if __name__ == "__main__":
    main(sys.argv[1:])
