#include "gsv/orb/giop/type_code_check.h"

#include <algorithm>

#include "gsv/orb/giop/giop_header.h"

namespace gsv::orb {
namespace {

// The values of CORBA::TCKind.
enum TypeCodeKind : std::uint32_t {
  kNull = 0,
  kVoid = 1,
  kShort = 2,
  kLong = 3,
  kUShort = 4,
  kULong = 5,
  kFloat = 6,
  kDouble = 7,
  kBoolean = 8,
  kChar = 9,
  kOctet = 10,
  kAny = 11,
  kTypeCode = 12,
  kObject = 14,
  kStruct = 15,
  kUnion = 16,
  kEnum = 17,
  kString = 18,
  kSequence = 19,
  kArray = 20,
  kAlias = 21,
  kException = 22,
  kLongLong = 23,
  kULongLong = 24,
  kLongDouble = 25,
  kWChar = 26,
  kWString = 27,
  kFixed = 28,
};
constexpr std::uint32_t kIndirection = 0xFFFFFFFF;

struct FixedSize {
  std::size_t size = 0;  // size of a value in bytes; 0 if it varies
  std::size_t alignment = 1;
};

FixedSize SizeOf(std::uint32_t kind) {
  switch (kind) {
    case kBoolean:
    case kChar:
    case kOctet:
      return {1, 1};
    case kShort:
    case kUShort:
      return {2, 2};
    case kLong:
    case kULong:
    case kFloat:
      return {4, 4};
    case kDouble:
    case kLongLong:
    case kULongLong:
      return {8, 8};
    case kLongDouble:
      return {16, 8};
    default:
      return {};
  }
}

bool MayDiscriminate(std::uint32_t kind) {
  switch (kind) {
    case kShort:
    case kLong:
    case kUShort:
    case kULong:
    case kBoolean:
    case kChar:
    case kEnum:
    case kLongLong:
    case kULongLong:
      return true;
    default:
      return false;
  }
}

}  // namespace

std::size_t TypeCodeCheck::ReadTypeCode(CdrReader& in, std::size_t depth) {
  if (depth == 0) read_.clear();
  in.Align(4);
  const char* const begin = in.here();
  Type type{.kind = in.ULong()};
  if (type.kind == kIndirection) return Repeated(in);
  if (depth >= limits_.depth) in.Fail();
  switch (type.kind) {
    case kString:
    case kWString:
      in.ULong();
      break;
    case kFixed: {
      // omniORB crashes if a fixed-point type has more decimals than digits.
      type.length = in.UShort();
      const std::uint16_t scale = in.UShort();
      if (type.length == 0 || type.length > 31 || scale > type.length) in.Fail();
      break;
    }
    case kObject:
    case kStruct:
    case kUnion:
    case kEnum:
    case kSequence:
    case kArray:
    case kAlias:
    case kException: {
      CdrReader parameters = in.Encapsulation();
      if (!in.ok()) break;
      ReadParameters(type, parameters, depth);
      if (type.size == 0) in.Fail();
      break;
    }
    default:
      if (type.kind > kTypeCode && SizeOf(type.kind).size == 0 && type.kind != kWChar) in.Fail();
  }
  type_count_ += 1;
  if (type_count_ > limits_.types || type.depth > limits_.depth) in.Fail();
  types_.push_back(std::move(type));
  read_[begin] = types_.size() - 1;
  return types_.size() - 1;
}

// Reads an indirection: a reference to an earlier, complete type.
std::size_t TypeCodeCheck::Repeated(CdrReader& in) {
  in.Align(4);
  const char* const here = in.here();
  const auto offset = static_cast<std::int32_t>(in.ULong());
  const auto found = in.ok() && offset < -4 ? read_.find(here + offset) : read_.end();
  if (found == read_.end()) {
    in.Fail();
    types_.emplace_back();
    return types_.size() - 1;
  }
  type_count_ += types_[found->second].size;
  if (type_count_ > limits_.types) in.Fail();
  return found->second;
}

// Reads the parameters of a type. If they are invalid, `type.size` becomes 0.
void TypeCodeCheck::ReadParameters(Type& type, CdrReader in, std::size_t depth) {
  if (type.kind != kSequence && type.kind != kArray) {
    in.String();
    in.String();
  }
  switch (type.kind) {
    case kStruct:
    case kException:
      ReadMembers(type, in, depth);
      break;
    case kUnion:
      ReadUnion(type, in, depth);
      break;
    case kEnum:
      type.length = in.Count();
      for (std::uint32_t i = 0; i < type.length && in.ok(); ++i) in.String();
      break;
    case kSequence:
    case kArray:
      AddPart(type, in, depth);
      type.length = in.ULong();
      break;
    case kAlias:
      AddPart(type, in, depth);
      break;
    default:
      break;
  }
  if (!in.ok()) type.size = 0;
}

void TypeCodeCheck::ReadMembers(Type& type, CdrReader& in, std::size_t depth) {
  for (std::uint32_t left = in.Count(); left > 0 && in.ok(); --left) {
    in.String();
    AddPart(type, in, depth);
  }
}

void TypeCodeCheck::ReadUnion(Type& type, CdrReader& in, std::size_t depth) {
  AddPart(type, in, depth);
  if (in.ok() && !MayDiscriminate(types_[WithoutAlias(type.parts[0])].kind)) in.Fail();
  type.default_member = static_cast<std::int32_t>(in.ULong());
  const std::uint32_t count = in.Count();
  if (type.default_member < -1 || type.default_member >= static_cast<std::int64_t>(count)) {
    in.Fail();
  }
  for (std::uint32_t i = 0; i < count && in.ok(); ++i) {
    type.labels.push_back(ReadDiscriminator(type.parts[0], in));
    in.String();
    AddPart(type, in, depth);
  }
}

void TypeCodeCheck::AddPart(Type& type, CdrReader& in, std::size_t depth) {
  if (!in.ok()) return;
  const std::size_t part = ReadTypeCode(in, depth + 1);
  type.parts.push_back(part);
  type.depth = std::max(type.depth, types_[part].depth + 1);
  type.size += types_[part].size;
}

void TypeCodeCheck::ReadAny(CdrReader& in, std::size_t depth) {
  if (depth >= limits_.depth) return in.Fail();
  if (ReadSimpleAny(in)) return;
  const std::size_t type = ReadTypeCode(in, 0);
  ReadValue(type, in, depth + 1);
}

// Reads an any that contains a number, a character, a boolean or a string. These are the most
// frequent cases. For other types, reads nothing and returns false.
bool TypeCodeCheck::ReadSimpleAny(CdrReader& in) {
  CdrReader behind = in;
  const std::uint32_t kind = behind.ULong();
  const FixedSize fixed = SizeOf(kind);
  if (fixed.size == 0 && kind != kString) return false;
  in = behind;
  if (++type_count_ > limits_.types || ++value_count_ > limits_.values) in.Fail();
  if (kind == kString) {
    in.ULong();
    in.String();
  } else {
    in.SkipValues(1, fixed.size, fixed.alignment);
  }
  return true;
}

void TypeCodeCheck::ReadValue(std::size_t index, CdrReader& in, std::size_t depth) {
  if (++value_count_ > limits_.values || depth > 2 * limits_.depth) in.Fail();
  if (!in.ok()) return;
  const std::uint32_t kind = types_[index].kind;
  switch (kind) {
    case kNull:
    case kVoid:
      return;
    case kAny:
      return ReadAny(in, depth);
    case kTypeCode:
      ReadTypeCode(in, 0);
      return;
    case kObject:
      return SkipReference(in);
    case kException:
      in.String();
      [[fallthrough]];
    case kStruct:
      for (std::size_t i = 0; i < types_[index].parts.size() && in.ok(); ++i) {
        ReadValue(types_[index].parts[i], in, depth + 1);
      }
      return;
    case kUnion:
      return ReadUnionValue(index, in, depth);
    case kEnum:
      if (in.ULong() >= types_[index].length) in.Fail();
      return;
    case kString:
      in.String();
      return;
    case kSequence:
      return ReadElements(types_[index].parts[0], in.Count(), in, depth);
    case kArray:
      return ReadElements(types_[index].parts[0], types_[index].length, in, depth);
    case kAlias:
      return ReadValue(types_[index].parts[0], in, depth + 1);
    case kWChar:
      if (in.minor() < 2) return in.SkipValues(1, 2, 2);
      return in.Skip(in.Octet());
    case kWString:
      if (in.minor() < 2) return in.SkipValues(in.Count(), 2, 2);
      in.Octets();
      return;
    case kFixed:
      return in.Skip(types_[index].length / 2 + 1);
    default:
      return in.SkipValues(1, SizeOf(kind).size, SizeOf(kind).alignment);
  }
}

void TypeCodeCheck::ReadUnionValue(std::size_t index, CdrReader& in, std::size_t depth) {
  const std::uint64_t label = ReadDiscriminator(types_[index].parts[0], in);
  const std::vector<std::uint64_t>& labels = types_[index].labels;
  const std::int32_t default_member = types_[index].default_member;
  std::size_t member = labels.size();
  for (std::size_t i = 0; i < labels.size() && member == labels.size(); ++i) {
    if (labels[i] == label && static_cast<std::int32_t>(i) != default_member) member = i;
  }
  if (member == labels.size() && default_member >= 0) {
    member = static_cast<std::size_t>(default_member);
  }
  if (member < labels.size()) ReadValue(types_[index].parts[1 + member], in, depth + 1);
}

void TypeCodeCheck::ReadElements(std::size_t element, std::size_t count, CdrReader& in,
                                 std::size_t depth) {
  const FixedSize fixed = SizeOf(types_[WithoutAlias(element)].kind);
  if (fixed.size != 0) return in.SkipValues(count, fixed.size, fixed.alignment);
  for (std::size_t i = 0; i < count && in.ok(); ++i) ReadValue(element, in, depth + 1);
}

std::uint64_t TypeCodeCheck::ReadDiscriminator(std::size_t type, CdrReader& in) {
  switch (SizeOf(types_[WithoutAlias(type)].kind).size) {
    case 1:
      return in.Octet();
    case 2:
      return in.UShort();
    case 8:
      return in.ULongLong();
    default:
      return in.ULong();
  }
}

std::size_t TypeCodeCheck::WithoutAlias(std::size_t type) const {
  while (types_[type].kind == kAlias && !types_[type].parts.empty()) type = types_[type].parts[0];
  return type;
}

}  // namespace gsv::orb
