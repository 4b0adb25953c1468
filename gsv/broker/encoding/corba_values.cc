#include "gsv/broker/encoding/corba_values.h"

#include <optional>

#include <COS/CosTradingDynamic.hh>

#include "gsv/base/check.h"
#include "gsv/broker/transport/encapsulation.h"

namespace gsv::broker {
namespace {

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

Value ReadSequence(Scalar element, cdrStream& stream) {
  CORBA::ULong length = 0;
  length <<= stream;
  Value::Sequence elements;
  for (CORBA::ULong i = 0; i < length; ++i) elements.push_back(ReadScalar(element, stream));
  return Value::SequenceOf(element, std::move(elements));
}

// The declared type of a dynamic property, or null for any other value.
std::shared_ptr<const PropertyType> PromisedType(const CORBA::Any& any) {
  const CosTradingDynamic::DynamicProp* dynamic = nullptr;
  if (!(any >>= dynamic)) return nullptr;
  return std::make_shared<const PropertyType>(ToPropertyType(dynamic->returned_type));
}

template <typename T, typename Make>
std::optional<Value> Extract(const CORBA::Any& any, const Make& make) {
  T content{};
  if (!(any >>= content)) return std::nullopt;
  return make(content);
}

template <typename T, typename Holder, typename Make>
std::optional<Value> ExtractAs(const CORBA::Any& any, const Make& make) {
  T content{};
  if (!(any >>= Holder(content))) return std::nullopt;
  return make(content);
}

// Converts an Any without copying its content. Returns nullopt if its type is not a simple type.
std::optional<Value> SimpleValue(const CORBA::Any& any) {
  switch (any.NP_type()->kind()) {
    case CORBA::tk_boolean:
      return ExtractAs<CORBA::Boolean, CORBA::Any::to_boolean>(any, Value::Boolean);
    case CORBA::tk_short:
      return Extract<CORBA::Short>(any, Value::Short);
    case CORBA::tk_ushort:
      return Extract<CORBA::UShort>(any, Value::UShort);
    case CORBA::tk_long:
      return Extract<CORBA::Long>(any, Value::Long);
    case CORBA::tk_ulong:
      return Extract<CORBA::ULong>(any, Value::ULong);
    case CORBA::tk_float:
      return Extract<CORBA::Float>(any, Value::Float);
    case CORBA::tk_double:
      return Extract<CORBA::Double>(any, Value::Double);
    case CORBA::tk_char:
      return ExtractAs<CORBA::Char, CORBA::Any::to_char>(
          any, [](CORBA::Char c) { return Value::Char(static_cast<char>(c)); });
    case CORBA::tk_string:
      return Extract<const char*>(any, [](const char* text) { return Value::String(text); });
    default:
      return std::nullopt;
  }
}

void FillSimple(const Value& value, CORBA::Any& any) {
  const auto integer = [&] { return *value.AsInteger(); };
  switch (value.scalar()) {
    case Scalar::kBoolean:
      any <<= CORBA::Any::from_boolean(*value.AsBoolean());
      return;
    case Scalar::kShort:
      any <<= static_cast<CORBA::Short>(integer());
      return;
    case Scalar::kUShort:
      any <<= static_cast<CORBA::UShort>(integer());
      return;
    case Scalar::kLong:
      any <<= static_cast<CORBA::Long>(integer());
      return;
    case Scalar::kULong:
      any <<= static_cast<CORBA::ULong>(integer());
      return;
    case Scalar::kFloat:
      any <<= static_cast<CORBA::Float>(*value.AsReal());
      return;
    case Scalar::kDouble:
      any <<= static_cast<CORBA::Double>(*value.AsReal());
      return;
    case Scalar::kChar:
      any <<= CORBA::Any::from_char(static_cast<CORBA::Char>(value.AsText()->at(0)));
      return;
    case Scalar::kString:
      any <<= std::string(*value.AsText()).c_str();
      return;
    case Scalar::kOther:
      break;
  }
  GSV_CHECK(!"a simple type was expected");
}

// Sets `any` to `value`. `any` must be empty.
void FillAny(const Value& value, CORBA::Any& any) {
  if (const OtherValue* other = value.AsOther()) {
    cdrEncapsulationStream stream = StreamOf(other->encoded);
    any <<= stream;
  } else if (const Value::Sequence* sequence = value.AsSequence()) {
    cdrMemoryStream stream;
    const CORBA::TypeCode_var type = ToTypeCode(value.Type());
    any.replace(type, nullptr);
    static_cast<CORBA::ULong>(sequence->size()) >>= stream;
    for (const ScalarValue& element : *sequence) WriteScalar(value.scalar(), element, stream);
    any.NP_unmarshalDataOnly(stream);
  } else {
    FillSimple(value, any);
  }
}

}  // namespace

Value ToValue(const CORBA::Any& any) {
  if (auto simple = SimpleValue(any)) return *std::move(simple);
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
                       : Value::Of(kind.scalar, ReadScalar(kind.scalar, stream));
}

CORBA::Any ToAny(const Value& value) {
  CORBA::Any any;
  FillAny(value, any);
  return any;
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
  FillProperty(property.name, property.value, result);
  return result;
}

void FillProperty(const std::string& name, const Value& value, CosTrading::Property& property) {
  property.name = name.c_str();
  FillAny(value, property.value);
}

void FillProperties(const PropertyList& list, CosTrading::PropertySeq& properties) {
  properties.length(static_cast<CORBA::ULong>(list.size()));
  for (CORBA::ULong i = 0; i < properties.length(); ++i) {
    FillProperty(list[i].name, list[i].value, properties[i]);
  }
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
