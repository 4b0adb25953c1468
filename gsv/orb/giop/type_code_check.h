// Checks TypeCodes and the values that they describe before the ORB reads them. omniORB 4.2.5
// crashes on some malformed TypeCodes. For nested TypeCodes it needs memory that grows with the
// square of their depth.
//
// Some valid CORBA is also rejected: recursive types, value types, and anything that exceeds the
// limits below.
//
// Source  CORBA 3.1 part 2, 7.3.5 (TypeCodes), 7.3.2 and 7.3.4 (values).
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "gsv/base/cdr_reader.h"

namespace gsv::orb {

using base::CdrReader;

struct TypeCodeLimits {
  // maximum nesting of types, and of values around an any; other values may nest twice as deep
  std::size_t depth = 64;
  // maximum number of types in one message; each reference to a type counts again
  std::size_t types = 4096;
  // maximum number of values in one message; elements of sequences and arrays do not count if their
  // size is fixed, as for numbers
  std::size_t values = 65536;
};

// Checks the TypeCodes of one message. After each function, the reader is at the first byte that
// the function has not read, or the reader has failed.
class TypeCodeCheck {
 public:
  explicit TypeCodeCheck(const TypeCodeLimits& limits = {}) : limits_(limits) {}

  // Reads and checks a TypeCode.
  void TypeCode(CdrReader& in) { ReadTypeCode(in, 0); }
  // Reads and checks an any: its TypeCode and its value.
  void Any(CdrReader& in) { ReadAny(in, 0); }

 private:
  // A TypeCode that was read. Other TypeCodes refer to it by its index in types_.
  struct Type {
    std::uint32_t kind = 0;  // a value of CORBA's TCKind
    std::size_t depth = 1;   // number of nested levels of types, including this type
    std::size_t size = 1;    // number of types in this type, including itself
    // length of an array, number of names of an enumeration, or digits of a fixed-point type
    std::uint32_t length = 0;
    // the types of the members, of the element, or of the aliased type; a union's first part is its
    // discriminator
    std::vector<std::size_t> parts;
    std::vector<std::uint64_t> labels;  // labels of a union, one for each member
    std::int32_t default_member = -1;   // index of a union's default member; -1 if there is none
  };

  // The functions below read and check one part of the message. `depth` is the nesting of this
  // part. Functions that return an index return an index in types_; if `in` has failed, this type
  // has no meaning.
  std::size_t ReadTypeCode(CdrReader& in, std::size_t depth);
  // Reads a reference to an earlier part of the same TypeCode.
  std::size_t Repeated(CdrReader& in);
  void ReadParameters(Type& type, CdrReader in, std::size_t depth);
  void ReadMembers(Type& type, CdrReader& in, std::size_t depth);
  void ReadUnion(Type& type, CdrReader& in, std::size_t depth);
  void AddPart(Type& type, CdrReader& in, std::size_t depth);

  void ReadAny(CdrReader& in, std::size_t depth);
  // Reads an any that contains a value of fixed size, such as a number, or a string. For any other,
  // reads nothing and returns false.
  bool ReadSimpleAny(CdrReader& in);
  void ReadValue(std::size_t type, CdrReader& in, std::size_t depth);
  void ReadUnionValue(std::size_t type, CdrReader& in, std::size_t depth);
  void ReadElements(std::size_t element, std::size_t count, CdrReader& in, std::size_t depth);
  std::uint64_t ReadDiscriminator(std::size_t type, CdrReader& in);
  // Returns the type behind all aliases (typedefs).
  std::size_t WithoutAlias(std::size_t type) const;

  TypeCodeLimits limits_;
  std::vector<Type> types_;  // all types of the message, in the order of reading
  // the types of the current TypeCode, by the address of their first byte
  std::map<const char*, std::size_t> read_;
  std::size_t type_count_ = 0;   // number of types so far, for TypeCodeLimits::types
  std::size_t value_count_ = 0;  // number of values so far, for TypeCodeLimits::values
};

}  // namespace gsv::orb
