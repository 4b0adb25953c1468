#include "gsv/broker/encoding/corba_types.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace gsv::broker {
namespace {

class CorbaTypesTest : public ::testing::Test {
 protected:
  static CORBA::ORB_ptr StartOrb() {
    int no_arguments = 0;
    return CORBA::ORB_init(no_arguments, nullptr);
  }
  CORBA::TypeCode_var SequenceOf(CORBA::TypeCode_ptr element) {
    return orb_->create_sequence_tc(0, element);
  }
  CORBA::TypeCode_var AliasOf(CORBA::TypeCode_ptr type) {
    return orb_->create_alias_tc("IDL:acme/Alias:1.0", "Alias", type);
  }
  CORBA::TypeCode_var Struct() {
    CORBA::StructMemberSeq members;
    members.length(1);
    members[0].name = "x";
    members[0].type = CORBA::TypeCode::_duplicate(CORBA::_tc_double);
    return orb_->create_struct_tc("IDL:acme/Place:1.0", "Place", members);
  }

  const CORBA::ORB_var orb_ = StartOrb();
};

struct ScalarCase {
  CORBA::TypeCode_ptr type;
  Scalar scalar;
};

std::vector<ScalarCase> ScalarCases() {
  return {{CORBA::_tc_boolean, Scalar::kBoolean}, {CORBA::_tc_short, Scalar::kShort},
          {CORBA::_tc_ushort, Scalar::kUShort},   {CORBA::_tc_long, Scalar::kLong},
          {CORBA::_tc_ulong, Scalar::kULong},     {CORBA::_tc_float, Scalar::kFloat},
          {CORBA::_tc_double, Scalar::kDouble},   {CORBA::_tc_char, Scalar::kChar},
          {CORBA::_tc_string, Scalar::kString}};
}

TEST_F(CorbaTypesTest, ScalarsAndTheirSequencesArePlainData) {
  for (const ScalarCase& each : ScalarCases()) {
    const PropertyType scalar = ToPropertyType(each.type);
    EXPECT_EQ(scalar, (PropertyType{.scalar = each.scalar})) << Spelling(each.scalar);
    EXPECT_EQ(scalar.encoded, "");
    const PropertyType sequence = ToPropertyType(SequenceOf(each.type));
    EXPECT_EQ(sequence, (PropertyType{.scalar = each.scalar, .sequence = true}));
    EXPECT_EQ(sequence.encoded, "");
  }
}

TEST_F(CorbaTypesTest, AliasesAreClassifiedAsTheirTarget) {
  for (const ScalarCase& each : ScalarCases()) {
    EXPECT_EQ(Classify(AliasOf(each.type)), (PropertyType{.scalar = each.scalar}));
    EXPECT_EQ(Classify(AliasOf(AliasOf(SequenceOf(AliasOf(each.type))))),
              (PropertyType{.scalar = each.scalar, .sequence = true}));
  }
}

TEST_F(CorbaTypesTest, OtherTypesAreSpeltAsInIdl) {
  CORBA::EnumMemberSeq names;
  names.length(1);
  names[0] = "red";
  const CORBA::TypeCode_var color = orb_->create_enum_tc("IDL:acme/Color:1.0", "Color", names);
  const CORBA::TypeCode_var triple = orb_->create_array_tc(3, CORBA::_tc_long);
  const struct {
    CORBA::TypeCode_var type;
    const char* name;
  } kCases[] = {
      {CORBA::TypeCode::_duplicate(CORBA::_tc_octet), "octet"},
      {CORBA::TypeCode::_duplicate(CORBA::_tc_any), "any"},
      {CORBA::TypeCode::_duplicate(CORBA::_tc_TypeCode), "TypeCode"},
      {CORBA::TypeCode::_duplicate(CORBA::_tc_longlong), "long long"},
      {CORBA::TypeCode::_duplicate(CORBA::_tc_ulonglong), "unsigned long long"},
      {CORBA::TypeCode::_duplicate(CORBA::_tc_wstring), "wstring"},
      {CORBA::TypeCode::_duplicate(CORBA::_tc_null), "null"},
      {CORBA::TypeCode::_duplicate(CORBA::_tc_Object), "interface IDL:omg.org/CORBA/Object:1.0"},
      {Struct(), "struct IDL:acme/Place:1.0"},
      {color, "enum IDL:acme/Color:1.0"},
      {triple, "long[3]"},
      {SequenceOf(CORBA::_tc_octet), "sequence<octet>"},
      {SequenceOf(SequenceOf(CORBA::_tc_string)), "sequence<sequence<string>>"},
      {SequenceOf(AliasOf(Struct())), "sequence<struct IDL:acme/Place:1.0>"},
  };
  for (const auto& each : kCases) {
    EXPECT_EQ(Classify(each.type), (PropertyType{.name = each.name}));
  }
}

TEST_F(CorbaTypesTest, TypesAreUnchangedAfterEncoding) {
  std::vector<CORBA::TypeCode_var> types = {Struct(), AliasOf(Struct()), AliasOf(CORBA::_tc_long),
                                            SequenceOf(SequenceOf(CORBA::_tc_string))};
  for (const ScalarCase& each : ScalarCases()) {
    types.emplace_back(CORBA::TypeCode::_duplicate(each.type));
    types.push_back(SequenceOf(each.type));
  }
  for (const CORBA::TypeCode_var& type : types) {
    const CORBA::TypeCode_var again = ToTypeCode(ToPropertyType(type));
    EXPECT_TRUE(again->equal(type)) << type->kind();
  }
}

TEST_F(CorbaTypesTest, DeeplyNestedTypesAreSpeltUpToALimit) {
  CORBA::TypeCode_var type = CORBA::TypeCode::_duplicate(CORBA::_tc_octet);
  for (int i = 0; i < 20; ++i) type = SequenceOf(type);
  EXPECT_NE(Classify(type).name.find("…"), std::string::npos);
}

}  // namespace
}  // namespace gsv::broker
