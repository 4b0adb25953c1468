#include "gsv/broker/encoding/record_encoding.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "gsv/orb/testing/raw_message.h"

namespace gsv::broker {
namespace {

using orb::RawCdr;

// Values of CORBA's TCKind.
constexpr std::uint32_t kTkLong = 3, kTkStruct = 15;

class RecordEncodingTest : public ::testing::Test {
 protected:
  static CORBA::ORB_ptr StartOrb() {
    int no_arguments = 0;
    return CORBA::ORB_init(no_arguments, nullptr);
  }
  const CORBA::ORB_var orb_ = StartOrb();
};

// Returns the encapsulation of a property "p" with the long 7.
RawCdr OneProperty() { return RawCdr().Octet(1).ULong(1).String("p").ULong(kTkLong).ULong(7); }

TEST_F(RecordEncodingTest, ReadsPropertiesAsCdr) {
  const auto properties = DecodeProperties(OneProperty().bytes());
  ASSERT_TRUE(properties);
  ASSERT_EQ(properties->size(), 1u);
  ASSERT_NE(properties->Find("p"), nullptr);
  EXPECT_EQ(*properties->Find("p"), Value::Long(7));
}

TEST_F(RecordEncodingTest, WritesThePropertiesThatItReads) {
  const PropertyList list(std::vector<Property>{
      {"name", Value::String("arm")},
      {"reach", Value::Double(0.9)},
      {"tools", Value::Strings({"gripper", "camera"})},
  });
  const auto again = DecodeProperties(EncodeProperties(list));
  ASSERT_TRUE(again);
  ASSERT_EQ(*again->names(), *list.names());
  for (std::size_t i = 0; i < list.size(); ++i) EXPECT_EQ((*again)[i].value, list[i].value);
  EXPECT_TRUE(DecodeProperties(EncodeProperties({})));
}

TEST_F(RecordEncodingTest, RejectsTruncatedProperties) {
  const std::string bytes = OneProperty().bytes();
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    const auto properties = DecodeProperties(bytes.substr(0, size));
    ASSERT_FALSE(properties) << size;
    EXPECT_EQ(properties.error().code, base::ErrorCode::kCorrupt);
    EXPECT_EQ(properties.error().message, "an offer cannot be decoded (MARSHAL)");
  }
}

TEST_F(RecordEncodingTest, RejectsBytesThatAreNotProperties) {
  const struct {
    const char* what;
    RawCdr bytes;
  } kCases[] = {
      {"more elements than bytes", RawCdr().Octet(1).ULong(0xFFFFFFFF)},
      {"a name without its null", RawCdr().Octet(1).ULong(1).Octets("pq").ULong(kTkLong).ULong(7)},
      {"a TypeCode that does not exist", RawCdr().Octet(1).ULong(1).String("p").ULong(99)},
      {"a struct without its members",
       RawCdr().Octet(1).ULong(1).String("p").ULong(kTkStruct).Octets(
           RawCdr().Octet(1).String("IDL:T:1.0").String("T").ULong(0x00FFFFFF).bytes())},
  };
  for (const auto& each : kCases) EXPECT_FALSE(DecodeProperties(each.bytes.bytes())) << each.what;
}

TEST_F(RecordEncodingTest, RejectsTwoPropertiesWithTheSameName) {
  const RawCdr twice = RawCdr()
                           .Octet(1)
                           .ULong(2)
                           .String("p")
                           .ULong(kTkLong)
                           .ULong(7)
                           .String("p")
                           .ULong(kTkLong)
                           .ULong(8);
  const auto properties = DecodeProperties(twice.bytes());
  ASSERT_FALSE(properties);
  EXPECT_EQ(properties.error().message, "an offer has two properties with the same name");
}

TEST_F(RecordEncodingTest, PoliciesAreUnchangedAfterEncoding) {
  const auto policies = DecodePolicies(OneProperty().bytes());
  ASSERT_TRUE(policies);
  ASSERT_EQ(policies->length(), 1u);
  EXPECT_STREQ((*policies)[0].name, "p");
  const auto again = DecodePolicies(EncodePolicies(*policies));
  ASSERT_TRUE(again);
  CORBA::Long value = 0;
  EXPECT_TRUE((*again)[0].value >>= value);
  EXPECT_EQ(value, 7);
  EXPECT_FALSE(DecodePolicies("no policies"));
}

TEST_F(RecordEncodingTest, ServiceTypesAreUnchangedAfterEncoding) {
  const ServiceType type{.name = "Arm",
                         .interface_name = "IDL:acme/Arm:1.0",
                         .properties = {{"reach", {.scalar = Scalar::kDouble}}},
                         .super_types = {"Service"},
                         .incarnation = 3};
  const std::string bytes = EncodeServiceType(type);
  const auto again = DecodeServiceType("Arm", bytes);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->name, "Arm");
  EXPECT_EQ(again->interface_name, type.interface_name);
  EXPECT_EQ(again->properties.at(0).name, "reach");
  EXPECT_EQ(again->properties.at(0).type, type.properties[0].type);
  EXPECT_EQ(again->super_types, type.super_types);
  EXPECT_EQ(again->incarnation, 3u);
  const auto cut_off = DecodeServiceType("Arm", bytes.substr(0, bytes.size() - 5));
  ASSERT_FALSE(cut_off);
  EXPECT_EQ(cut_off.error().code, base::ErrorCode::kCorrupt);
}

}  // namespace
}  // namespace gsv::broker
