// Checks TypeCodes and the values that they describe before the ORB reads them: omniORB 4.2.5 fails
// on some malformed ones, and the memory it takes is quadratic in their depth.
//
// Also refused, though they are valid CORBA: recursive types, value types, and what exceeds the
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
  std::size_t depth = 64;      // of types in types and values in values, together
  std::size_t types = 4096;    // in one message; one that is referred to counts again
  std::size_t values = 65536;  // in one message, but for elements of a fixed size
};

// The TypeCodes of one message. The functions move the reader behind what they read, or make it
// fail.
class TypeCodeCheck {
 public:
  explicit TypeCodeCheck(const TypeCodeLimits& limits = {}) : limits_(limits) {}

  void TypeCode(CdrReader& in) { ReadTypeCode(in, 0); }
  void Any(CdrReader& in) { ReadAny(in, 0); }

 private:
  struct Type {
    std::uint32_t kind = 0;
    std::size_t depth = 1;
    std::size_t size = 1;            // with all that it is made of
    std::uint32_t length = 0;        // of an array; an enumeration's names; a fixed-point's digits
    std::vector<std::size_t> parts;  // members, an element, what is named; a union's first is its
                                     // discriminator
    std::vector<std::uint64_t> labels;  // a union's, one for each member
    std::int32_t default_member = -1;
  };

  std::size_t ReadTypeCode(CdrReader& in, std::size_t depth);
  std::size_t Repeated(CdrReader& in);
  void ReadParameters(Type& type, CdrReader in, std::size_t depth);
  void ReadMembers(Type& type, CdrReader& in, std::size_t depth);
  void ReadUnion(Type& type, CdrReader& in, std::size_t depth);
  void AddPart(Type& type, CdrReader& in, std::size_t depth);

  void ReadAny(CdrReader& in, std::size_t depth);
  bool ReadSimpleAny(CdrReader& in);
  void ReadValue(std::size_t type, CdrReader& in, std::size_t depth);
  void ReadUnionValue(std::size_t type, CdrReader& in, std::size_t depth);
  void ReadElements(std::size_t element, std::size_t count, CdrReader& in, std::size_t depth);
  std::uint64_t ReadDiscriminator(std::size_t type, CdrReader& in);
  std::size_t WithoutAlias(std::size_t type) const;

  TypeCodeLimits limits_;
  std::vector<Type> types_;
  std::map<const char*, std::size_t> read_;  // by where they begin, in the present TypeCode
  std::size_t type_count_ = 0;
  std::size_t value_count_ = 0;
};

}  // namespace gsv::orb
