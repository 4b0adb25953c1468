#include "gsv/broker/encoding/corba_values.h"

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <COS/CosTradingDynamic.hh>

namespace gsv::broker {
namespace {

class CorbaValuesTest : public ::testing::Test {
 protected:
  static CORBA::ORB_ptr StartOrb() {
    int no_arguments = 0;
    return CORBA::ORB_init(no_arguments, nullptr);
  }
  const CORBA::ORB_var orb_ = StartOrb();
};

template <typename T>
CORBA::Any AnyOf(const T& content) {
  CORBA::Any any;
  any <<= content;
  return any;
}

struct ValueCase {
  CORBA::Any any;
  Value value;
};

template <typename T>
using Limits = std::numeric_limits<T>;

std::vector<ValueCase> ScalarValues() {
  return {
      {AnyOf(CORBA::Any::from_boolean(true)), Value::Boolean(true)},
      {AnyOf(CORBA::Any::from_boolean(false)), Value::Boolean(false)},
      {AnyOf(CORBA::Short{-32768}), Value::Short(-32768)},
      {AnyOf(CORBA::UShort{65535}), Value::UShort(65535)},
      {AnyOf(Limits<CORBA::Long>::min()), Value::Long(-2147483647 - 1)},
      {AnyOf(CORBA::ULong{4294967295u}), Value::ULong(4294967295u)},
      {AnyOf(CORBA::Float{0.1f}), Value::Float(0.1f)},
      {AnyOf(CORBA::Double{1e300}), Value::Double(1e300)},
      {AnyOf(Limits<CORBA::Double>::infinity()), Value::Double(Limits<double>::infinity())},
      {AnyOf(CORBA::Any::from_char('\xFF')), Value::Char('\xFF')},
      {AnyOf(static_cast<const char*>("")), Value::String("")},
      {AnyOf(static_cast<const char*>("R\xC3\xA4"
                                      "der")),
       Value::String("R\xC3\xA4"
                     "der")},
  };
}

// `Sequence` is a sequence typedef of omniORB; this also tests aliases.
template <typename Sequence, typename Element>
CORBA::Any SequenceAny(const std::vector<Element>& elements) {
  Sequence sequence;
  sequence.length(static_cast<CORBA::ULong>(elements.size()));
  for (CORBA::ULong i = 0; i < elements.size(); ++i) sequence[i] = elements[i];
  return AnyOf(sequence);
}

std::vector<ValueCase> SequenceValues() {
  using Elements = Value::Sequence;
  return {
      {SequenceAny<CORBA::BooleanSeq, bool>({true, false}),
       Value::SequenceOf(Scalar::kBoolean, Elements{true, false})},
      {SequenceAny<CORBA::ShortSeq, CORBA::Short>({-1, 2}),
       Value::SequenceOf(Scalar::kShort, Elements{std::int64_t{-1}, std::int64_t{2}})},
      {SequenceAny<CORBA::UShortSeq, CORBA::UShort>({65535}),
       Value::SequenceOf(Scalar::kUShort, Elements{std::int64_t{65535}})},
      {SequenceAny<CORBA::LongSeq, CORBA::Long>({}), Value::SequenceOf(Scalar::kLong, {})},
      {SequenceAny<CORBA::ULongSeq, CORBA::ULong>({4294967295u}),
       Value::SequenceOf(Scalar::kULong, Elements{std::int64_t{4294967295}})},
      {SequenceAny<CORBA::FloatSeq, CORBA::Float>({0.5f}),
       Value::SequenceOf(Scalar::kFloat, Elements{0.5})},
      {SequenceAny<CORBA::DoubleSeq, CORBA::Double>({0.25, -1e-300}),
       Value::SequenceOf(Scalar::kDouble, Elements{0.25, -1e-300})},
      {SequenceAny<CORBA::CharSeq, char>({'a'}),
       Value::SequenceOf(Scalar::kChar, Elements{std::string("a")})},
      {SequenceAny<CORBA::StringSeq, const char*>({"one", ""}),
       Value::SequenceOf(Scalar::kString, Elements{std::string("one"), std::string()})},
  };
}

TEST_F(CorbaValuesTest, ReadsScalars) {
  for (const ValueCase& each : ScalarValues()) {
    const Value value = ToValue(each.any);
    EXPECT_EQ(value, each.value) << each.value.Type().Spelling();
    EXPECT_EQ(value.Type(), each.value.Type());
  }
}

TEST_F(CorbaValuesTest, ReadsSequencesBehindAliases) {
  for (const ValueCase& each : SequenceValues()) {
    const Value value = ToValue(each.any);
    EXPECT_EQ(value, each.value) << each.value.Type().Spelling();
    EXPECT_EQ(value.Type(), each.value.Type());
  }
}

// The value in the Any, without its type, as CDR. The value begins at offset 0, so there is no
// padding in front of it.
std::string Content(const CORBA::Any& any) {
  cdrMemoryStream stream;
  any.NP_marshalDataOnly(stream);
  return {static_cast<const char*>(stream.bufPtr()), stream.bufSize()};
}

TEST_F(CorbaValuesTest, WritesTheSameBytesAsCorba) {
  for (const auto& values : {ScalarValues(), SequenceValues()}) {
    for (const ValueCase& each : values) {
      const CORBA::Any any = ToAny(each.value);
      const CORBA::TypeCode_var type = any.type();
      const CORBA::TypeCode_var expected = each.any.type();
      EXPECT_TRUE(type->equivalent(expected)) << each.value.Type().Spelling();
      EXPECT_EQ(Content(any), Content(each.any)) << each.value.Type().Spelling();
    }
  }
}

TEST_F(CorbaValuesTest, KeepsAScalarBehindAnAlias) {
  const CORBA::TypeCode_var alias =
      orb_->create_alias_tc("IDL:acme/Metres:1.0", "Metres", CORBA::_tc_double);
  CORBA::Any any = AnyOf(CORBA::Double{2.5});
  any.type(alias);
  EXPECT_EQ(ToValue(any), Value::Double(2.5));
}

TEST_F(CorbaValuesTest, ValuesOfOtherTypesStayEncoded) {
  const Value value = ToValue(AnyOf(CORBA::Any::from_octet(7)));
  ASSERT_NE(value.AsOther(), nullptr);
  EXPECT_EQ(value.AsOther()->type_name, "octet");
  EXPECT_EQ(value.AsOther()->promised_type, nullptr);
  CORBA::Octet octet = 0;
  const CORBA::Any any = ToAny(value);
  EXPECT_TRUE(any >>= CORBA::Any::to_octet(octet));
  EXPECT_EQ(octet, 7);
}

TEST_F(CorbaValuesTest, ReadsTheDeclaredTypeOfADynamicProperty) {
  CosTradingDynamic::DynamicProp dynamic;
  dynamic.returned_type = CORBA::TypeCode::_duplicate(CORBA::_tc_double);
  const Value value = ToValue(AnyOf(dynamic));
  ASSERT_NE(value.AsOther(), nullptr);
  ASSERT_NE(value.AsOther()->promised_type, nullptr);
  EXPECT_EQ(*value.AsOther()->promised_type, (PropertyType{.scalar = Scalar::kDouble}));
}

TEST_F(CorbaValuesTest, PropertiesKeepTheirOrderInBothDirections) {
  CosTrading::PropertySeq sequence;
  const PropertyList list(std::vector<Property>{{"a", Value::Long(1)}, {"b", Value::String("x")}});
  FillProperties(list, sequence);
  ASSERT_EQ(sequence.length(), 2u);
  EXPECT_STREQ(sequence[0].name, "a");
  EXPECT_STREQ(sequence[1].name, "b");
  const std::vector<Property> again = ToProperties(sequence);
  EXPECT_EQ(again[0].value, Value::Long(1));
  EXPECT_EQ(again[1].value, Value::String("x"));
}

TEST_F(CorbaValuesTest, ServiceTypesAreUnchangedAfterEncoding) {
  const ServiceType type{.name = "Arm",
                         .interface_name = "IDL:acme/Arm:1.0",
                         .properties = {{"reach", {.scalar = Scalar::kDouble}},
                                        {"tools",
                                         {.scalar = Scalar::kString, .sequence = true},
                                         PropertyMode::kMandatoryReadonly}},
                         .super_types = {"Service", "Robot"},
                         .masked = true,
                         .incarnation = 0x1'0000'0002};
  const auto description = ToCorba(type);
  EXPECT_EQ(description.props[1].mode,
            CosTradingRepos::ServiceTypeRepository::PROP_MANDATORY_READONLY);
  EXPECT_EQ(description.incarnation.high, 1u);
  EXPECT_EQ(description.incarnation.low, 2u);
  const ServiceType again = ToServiceType("Arm", description);
  EXPECT_EQ(again.name, type.name);
  EXPECT_EQ(again.interface_name, type.interface_name);
  ASSERT_EQ(again.properties.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(again.properties[i].name, type.properties[i].name);
    EXPECT_EQ(again.properties[i].type, type.properties[i].type);
    EXPECT_EQ(again.properties[i].mode, type.properties[i].mode);
  }
  EXPECT_EQ(again.super_types, type.super_types);
  EXPECT_EQ(again.masked, type.masked);
  EXPECT_EQ(again.incarnation, type.incarnation);
}

}  // namespace
}  // namespace gsv::broker
