#include "gsv/broker/encoding/corba_types.h"

#include <optional>
#include <string>

#include "gsv/base/check.h"
#include "gsv/broker/transport/encapsulation.h"

namespace gsv::broker {
namespace {

CORBA::TypeCode_var WithoutAlias(CORBA::TypeCode_ptr type) {
  CORBA::TypeCode_var plain = CORBA::TypeCode::_duplicate(type);
  while (plain->kind() == CORBA::tk_alias) plain = plain->content_type();
  return plain;
}

std::optional<Scalar> SimpleScalar(CORBA::TCKind kind) {
  switch (kind) {
    case CORBA::tk_boolean:
      return Scalar::kBoolean;
    case CORBA::tk_short:
      return Scalar::kShort;
    case CORBA::tk_ushort:
      return Scalar::kUShort;
    case CORBA::tk_long:
      return Scalar::kLong;
    case CORBA::tk_ulong:
      return Scalar::kULong;
    case CORBA::tk_float:
      return Scalar::kFloat;
    case CORBA::tk_double:
      return Scalar::kDouble;
    case CORBA::tk_char:
      return Scalar::kChar;
    case CORBA::tk_string:
      return Scalar::kString;
    default:
      return std::nullopt;
  }
}

CORBA::TypeCode_ptr SimpleTypeCode(Scalar scalar) {
  switch (scalar) {
    case Scalar::kBoolean:
      return CORBA::_tc_boolean;
    case Scalar::kShort:
      return CORBA::_tc_short;
    case Scalar::kUShort:
      return CORBA::_tc_ushort;
    case Scalar::kLong:
      return CORBA::_tc_long;
    case Scalar::kULong:
      return CORBA::_tc_ulong;
    case Scalar::kFloat:
      return CORBA::_tc_float;
    case Scalar::kDouble:
      return CORBA::_tc_double;
    case Scalar::kChar:
      return CORBA::_tc_char;
    case Scalar::kString:
      return CORBA::_tc_string;
    case Scalar::kOther:
      break;
  }
  GSV_CHECK(!"a simple type was expected");
  return CORBA::_tc_null;
}

// Returns a text such as "sequence<octet>" or "struct IDL:acme/Place:1.0". Types that CORBA defines
// as equivalent have equal texts.
std::string OtherSpelling(CORBA::TypeCode_ptr type, int depth = 0) {
  constexpr int kDepth = 16;
  if (depth > kDepth) return "…";
  const CORBA::TypeCode_var plain = WithoutAlias(type);
  if (const auto scalar = SimpleScalar(plain->kind())) return std::string(Spelling(*scalar));
  const auto named = [&](const char* kind) { return kind + std::string(plain->id()); };
  const auto element = [&] {
    const CORBA::TypeCode_var content = plain->content_type();
    return OtherSpelling(content, depth + 1);
  };
  switch (plain->kind()) {
    case CORBA::tk_null:
      return "null";
    case CORBA::tk_void:
      return "void";
    case CORBA::tk_octet:
      return "octet";
    case CORBA::tk_any:
      return "any";
    case CORBA::tk_TypeCode:
      return "TypeCode";
    case CORBA::tk_longlong:
      return "long long";
    case CORBA::tk_ulonglong:
      return "unsigned long long";
    case CORBA::tk_longdouble:
      return "long double";
    case CORBA::tk_wchar:
      return "wchar";
    case CORBA::tk_wstring:
      return "wstring";
    case CORBA::tk_struct:
      return named("struct ");
    case CORBA::tk_union:
      return named("union ");
    case CORBA::tk_enum:
      return named("enum ");
    case CORBA::tk_except:
      return named("exception ");
    case CORBA::tk_objref:
      return named("interface ");
    case CORBA::tk_sequence:
      return "sequence<" + element() + ">";
    case CORBA::tk_array:
      return element() + "[" + std::to_string(plain->length()) + "]";
    default:
      return "kind " + std::to_string(plain->kind());
  }
}

CORBA::TypeCode_ptr SequenceTypeCode(Scalar element) {
  int no_arguments = 0;
  const CORBA::ORB_var orb = CORBA::ORB_init(no_arguments, nullptr);
  return orb->create_sequence_tc(0, SimpleTypeCode(element));
}

}  // namespace

PropertyType Classify(CORBA::TypeCode_ptr type) {
  PropertyType result;
  const CORBA::TypeCode_var plain = WithoutAlias(type);
  if (const auto scalar = SimpleScalar(plain->kind())) {
    result.scalar = *scalar;
    return result;
  }
  if (plain->kind() == CORBA::tk_sequence) {
    const CORBA::TypeCode_var content = plain->content_type();
    if (const auto scalar = SimpleScalar(WithoutAlias(content)->kind())) {
      result.scalar = *scalar;
      result.sequence = true;
      return result;
    }
  }
  result.name = OtherSpelling(plain);
  return result;
}

PropertyType ToPropertyType(CORBA::TypeCode_ptr type) {
  PropertyType result = Classify(type);
  const bool simple = result.scalar != Scalar::kOther;
  const CORBA::TypeCode_var plain = simple ? ToTypeCode(result) : CORBA::TypeCode::_duplicate(type);
  if (simple && plain->equal(type)) return result;
  cdrEncapsulationStream stream;
  CORBA::TypeCode::marshalTypeCode(type, stream);
  result.encoded = BytesOf(stream);
  return result;
}

CORBA::TypeCode_ptr ToTypeCode(const PropertyType& type) {
  if (!type.encoded.empty()) {
    cdrEncapsulationStream stream = StreamOf(type.encoded);
    return CORBA::TypeCode::unmarshalTypeCode(stream);
  }
  return type.sequence ? SequenceTypeCode(type.scalar)
                       : CORBA::TypeCode::_duplicate(SimpleTypeCode(type.scalar));
}

}  // namespace gsv::broker
