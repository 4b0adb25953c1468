#include "gsv/broker/corba_values.h"

#include <optional>

#include <COS/CosTradingDynamic.hh>

#include "gsv/base/check.h"
#include "gsv/broker/encapsulation.h"

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

// "sequence<octet>", "struct IDL:acme/Place:1.0": equal for types that CORBA calls equivalent.
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

// The type as the constraint language sees it, `encoded` left empty.
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

ScalarValue ReadScalar(Scalar scalar, cdrStream& stream) {
  switch (scalar) {
    case Scalar::kBoolean:
      return static_cast<bool>(stream.unmarshalBoolean());
    case Scalar::kShort: {
      CORBA::Short value = 0;
      value <<= stream;
      return std::int64_t{value};
    }
    case Scalar::kUShort: {
      CORBA::UShort value = 0;
      value <<= stream;
      return std::int64_t{value};
    }
    case Scalar::kLong: {
      CORBA::Long value = 0;
      value <<= stream;
      return std::int64_t{value};
    }
    case Scalar::kULong: {
      CORBA::ULong value = 0;
      value <<= stream;
      return std::int64_t{value};
    }
    case Scalar::kFloat: {
      CORBA::Float value = 0;
      value <<= stream;
      return static_cast<double>(value);
    }
    case Scalar::kDouble: {
      CORBA::Double value = 0;
      value <<= stream;
      return value;
    }
    case Scalar::kChar:
      return std::string(1, static_cast<char>(stream.unmarshalChar()));
    case Scalar::kString: {
      const CORBA::String_var text = stream.unmarshalString();
      return std::string(text.in());
    }
    case Scalar::kOther:
      break;
  }
  GSV_CHECK(!"a simple type was expected");
  return false;
}

void WriteScalar(Scalar scalar, const ScalarValue& value, cdrStream& stream) {
  const auto integer = [&] { return std::get<std::int64_t>(value); };
  switch (scalar) {
    case Scalar::kBoolean:
      stream.marshalBoolean(std::get<bool>(value));
      return;
    case Scalar::kShort:
      static_cast<CORBA::Short>(integer()) >>= stream;
      return;
    case Scalar::kUShort:
      static_cast<CORBA::UShort>(integer()) >>= stream;
      return;
    case Scalar::kLong:
      static_cast<CORBA::Long>(integer()) >>= stream;
      return;
    case Scalar::kULong:
      static_cast<CORBA::ULong>(integer()) >>= stream;
      return;
    case Scalar::kFloat:
      static_cast<CORBA::Float>(std::get<double>(value)) >>= stream;
      return;
    case Scalar::kDouble:
      static_cast<CORBA::Double>(std::get<double>(value)) >>= stream;
      return;
    case Scalar::kChar:
      stream.marshalChar(static_cast<CORBA::Char>(std::get<std::string>(value).at(0)));
      return;
    case Scalar::kString:
      stream.marshalString(std::get<std::string>(value).c_str());
      return;
    case Scalar::kOther:
      break;
  }
  GSV_CHECK(!"a simple type was expected");
}

Value ToSimpleValue(Scalar scalar, const ScalarValue& content) {
  const auto integer = [&] { return std::get<std::int64_t>(content); };
  switch (scalar) {
    case Scalar::kBoolean:
      return Value::Boolean(std::get<bool>(content));
    case Scalar::kShort:
      return Value::Short(static_cast<std::int16_t>(integer()));
    case Scalar::kUShort:
      return Value::UShort(static_cast<std::uint16_t>(integer()));
    case Scalar::kLong:
      return Value::Long(static_cast<std::int32_t>(integer()));
    case Scalar::kULong:
      return Value::ULong(static_cast<std::uint32_t>(integer()));
    case Scalar::kFloat:
      return Value::Float(static_cast<float>(std::get<double>(content)));
    case Scalar::kDouble:
      return Value::Double(std::get<double>(content));
    case Scalar::kChar:
      return Value::Char(std::get<std::string>(content).at(0));
    default:
      return Value::String(std::get<std::string>(content));
  }
}

ScalarValue Content(const Value& value) {
  if (const auto* truth = value.As<bool>()) return *truth;
  if (const auto* integer = value.As<std::int64_t>()) return *integer;
  if (const auto* real = value.As<double>()) return *real;
  return *value.As<std::string>();
}

Value ReadSequence(Scalar element, cdrStream& stream) {
  CORBA::ULong length = 0;
  length <<= stream;
  Value::Sequence elements;
  for (CORBA::ULong i = 0; i < length; ++i) elements.push_back(ReadScalar(element, stream));
  return Value::SequenceOf(element, std::move(elements));
}

CORBA::TypeCode_ptr SequenceTypeCode(Scalar element) {
  int no_arguments = 0;
  const CORBA::ORB_var orb = CORBA::ORB_init(no_arguments, nullptr);
  return orb->create_sequence_tc(0, SimpleTypeCode(element));
}

}  // namespace

namespace {

// Null for a value that is no dynamic property.
std::shared_ptr<const PropertyType> PromisedType(const CORBA::Any& any) {
  const CosTradingDynamic::DynamicProp* dynamic = nullptr;
  if (!(any >>= dynamic)) return nullptr;
  return std::make_shared<const PropertyType>(ToPropertyType(dynamic->returned_type));
}

}  // namespace

Value ToValue(const CORBA::Any& any) {
  const CORBA::TypeCode_var type = any.type();
  const PropertyType kind = Classify(type);
  if (kind.scalar == Scalar::kOther) {
    cdrEncapsulationStream stream;
    any >>= stream;
    return Value::Other({kind.name, BytesOf(stream), PromisedType(any)});
  }
  cdrMemoryStream stream;
  any.NP_marshalDataOnly(stream);
  return kind.sequence ? ReadSequence(kind.scalar, stream)
                       : ToSimpleValue(kind.scalar, ReadScalar(kind.scalar, stream));
}

CORBA::Any ToAny(const Value& value) {
  CORBA::Any any;
  if (const OtherValue* other = value.AsOther()) {
    cdrEncapsulationStream stream = StreamOf(other->encoded);
    any <<= stream;
    return any;
  }
  cdrMemoryStream stream;
  if (const Value::Sequence* sequence = value.AsSequence()) {
    const CORBA::TypeCode_var type = SequenceTypeCode(value.scalar());
    any.replace(type, nullptr);
    static_cast<CORBA::ULong>(sequence->size()) >>= stream;
    for (const ScalarValue& element : *sequence) WriteScalar(value.scalar(), element, stream);
  } else {
    any.replace(SimpleTypeCode(value.scalar()), nullptr);
    WriteScalar(value.scalar(), Content(value), stream);
  }
  any.NP_unmarshalDataOnly(stream);
  return any;
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

std::vector<Property> ToProperties(const CosTrading::PropertySeq& properties) {
  std::vector<Property> result;
  result.reserve(properties.length());
  for (CORBA::ULong i = 0; i < properties.length(); ++i) {
    result.push_back({properties[i].name.in(), ToValue(properties[i].value)});
  }
  return result;
}

CosTrading::Property ToCorba(const Property& property) {
  CosTrading::Property result;
  result.name = property.name.c_str();
  result.value = ToAny(property.value);
  return result;
}

CosTradingRepos::ServiceTypeRepository::PropStruct ToCorba(const PropertyDefinition& definition) {
  CosTradingRepos::ServiceTypeRepository::PropStruct prop;
  prop.name = definition.name.c_str();
  prop.value_type = ToTypeCode(definition.type);
  prop.mode = static_cast<CosTradingRepos::ServiceTypeRepository::PropertyMode>(definition.mode);
  return prop;
}

PropertyDefinition ToDefinition(const CosTradingRepos::ServiceTypeRepository::PropStruct& prop) {
  return {prop.name.in(), ToPropertyType(prop.value_type), static_cast<PropertyMode>(prop.mode)};
}

CosTradingRepos::ServiceTypeRepository::TypeStruct ToCorba(const ServiceType& type) {
  CosTradingRepos::ServiceTypeRepository::TypeStruct result;
  result.if_name = type.interface_name.c_str();
  result.props.length(static_cast<CORBA::ULong>(type.properties.size()));
  for (CORBA::ULong i = 0; i < type.properties.size(); ++i) {
    result.props[i] = ToCorba(type.properties[i]);
  }
  result.super_types.length(static_cast<CORBA::ULong>(type.super_types.size()));
  for (CORBA::ULong i = 0; i < type.super_types.size(); ++i) {
    result.super_types[i] = type.super_types[i].c_str();
  }
  result.masked = type.masked;
  result.incarnation = ToIncarnation(type.incarnation);
  return result;
}

ServiceType ToServiceType(std::string name,
                          const CosTradingRepos::ServiceTypeRepository::TypeStruct& description) {
  ServiceType type{.name = std::move(name), .interface_name = description.if_name.in()};
  for (CORBA::ULong i = 0; i < description.props.length(); ++i) {
    type.properties.push_back(ToDefinition(description.props[i]));
  }
  for (CORBA::ULong i = 0; i < description.super_types.length(); ++i) {
    type.super_types.emplace_back(description.super_types[i]);
  }
  type.masked = description.masked;
  type.incarnation = FromIncarnation(description.incarnation);
  return type;
}

CosTradingRepos::ServiceTypeRepository::IncarnationNumber ToIncarnation(std::uint64_t number) {
  return {static_cast<CORBA::ULong>(number >> 32), static_cast<CORBA::ULong>(number)};
}

std::uint64_t FromIncarnation(
    const CosTradingRepos::ServiceTypeRepository::IncarnationNumber& number) {
  return std::uint64_t{number.high} << 32 | number.low;
}

}  // namespace gsv::broker
