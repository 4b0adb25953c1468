#include "gsv/broker/trader/type_repository.h"

#include <gtest/gtest.h>

namespace gsv::broker {
namespace {

constexpr PropertyMode kNormal = PropertyMode::kNormal;
constexpr PropertyMode kReadonly = PropertyMode::kReadonly;
constexpr PropertyMode kMandatory = PropertyMode::kMandatory;
constexpr PropertyMode kMandatoryReadonly = PropertyMode::kMandatoryReadonly;

PropertyDefinition Define(std::string name, Scalar scalar, PropertyMode mode) {
  return {std::move(name), {.scalar = scalar}, mode};
}

class TypeRepositoryTest : public testing::Test {
 protected:
  TradingResult<std::uint64_t> Add(std::string name,
                                   std::vector<PropertyDefinition> properties = {},
                                   std::vector<std::string> super_types = {},
                                   std::string interface_name = "") {
    return repository_.Add({.name = std::move(name),
                            .interface_name = std::move(interface_name),
                            .properties = std::move(properties),
                            .super_types = std::move(super_types)});
  }

  TypeRepository repository_{TraderLimits{}};
};

TEST_F(TypeRepositoryTest, CountsIncarnationsAndListsTypesSinceAnIncarnation) {
  EXPECT_EQ(repository_.next_incarnation(), 1u);
  EXPECT_EQ(*Add("A"), 1u);
  const std::uint64_t since = repository_.next_incarnation();
  EXPECT_EQ(*Add("C"), 2u);
  EXPECT_EQ(*Add("B"), 3u);
  EXPECT_EQ(repository_.List({}), (std::vector<std::string>{"A", "B", "C"}));
  EXPECT_EQ(repository_.List(since), (std::vector<std::string>{"B", "C"}));
  EXPECT_EQ(repository_.List(4), std::vector<std::string>{});
}

TEST_F(TypeRepositoryTest, RejectsNamesThatAreNotServiceTypes) {
  for (const char* name : {"", "1A", "A B", "A::", "::", "A:B", "IDL:x", "<A>"}) {
    const auto added = Add(name);
    ASSERT_FALSE(added) << name;
    EXPECT_EQ(added.error().refusal, Refusal::kIllegalServiceType) << name;
    EXPECT_EQ(added.error().type, name);
    EXPECT_EQ(repository_.Describe(name).error().refusal, Refusal::kIllegalServiceType) << name;
  }
  for (const char* name : {"A", "A_1", "::A::B", "A::B", "IDL:omg.org/A/B:1.0"}) {
    EXPECT_TRUE(Add(name)) << name;
  }
}

TEST_F(TypeRepositoryTest, InheritsPropertiesWithTheStrongestMode) {
  ASSERT_TRUE(
      Add("Base", {Define("a", Scalar::kLong, kReadonly), Define("b", Scalar::kString, kNormal)}));
  ASSERT_TRUE(Add("Side", {Define("a", Scalar::kLong, kMandatory)}));
  ASSERT_TRUE(Add("Middle", {Define("b", Scalar::kString, kMandatory)}, {"Base"}));
  ASSERT_TRUE(Add("Leaf", {Define("c", Scalar::kDouble, kNormal)}, {"Middle", "Side"}));

  const ServiceType leaf = *repository_.FullyDescribe("Leaf");
  EXPECT_EQ(leaf.super_types, (std::vector<std::string>{"Middle", "Side", "Base"}));
  ASSERT_EQ(leaf.properties.size(), 3u);
  EXPECT_EQ(leaf.properties[0].name, "c");
  EXPECT_EQ(leaf.properties[1].name, "b");
  EXPECT_EQ(leaf.properties[1].mode, kMandatory);
  EXPECT_EQ(leaf.properties[2].name, "a");
  EXPECT_EQ(leaf.properties[2].mode, kMandatoryReadonly);

  EXPECT_EQ(repository_.Describe("Leaf")->properties.size(), 1u);
  EXPECT_EQ(repository_.Describe("Leaf")->super_types,
            (std::vector<std::string>{"Middle", "Side"}));
  EXPECT_EQ(*repository_.WithSubTypes("Base"),
            (std::vector<std::string>{"Base", "Leaf", "Middle"}));
}

TEST_F(TypeRepositoryTest, RejectsAWeakerRedefinition) {
  ASSERT_TRUE(Add("Base", {Define("a", Scalar::kLong, kMandatory)}));
  const auto other_type = Add("X", {Define("a", Scalar::kString, kMandatory)}, {"Base"});
  ASSERT_FALSE(other_type);
  EXPECT_EQ(other_type.error().refusal, Refusal::kValueTypeRedefinition);
  const Redefinition& redefinition = *other_type.error().redefinition;
  EXPECT_EQ(redefinition.type_1, "X");
  EXPECT_EQ(redefinition.definition_1.type.scalar, Scalar::kString);
  EXPECT_EQ(redefinition.type_2, "Base");
  EXPECT_EQ(redefinition.definition_2.type.scalar, Scalar::kLong);

  EXPECT_EQ(Add("X", {Define("a", Scalar::kLong, kNormal)}, {"Base"}).error().refusal,
            Refusal::kValueTypeRedefinition)
      << "a weaker mode";
  EXPECT_TRUE(Add("X", {Define("a", Scalar::kLong, kMandatoryReadonly)}, {"Base"}));
}

TEST_F(TypeRepositoryTest, RejectsContradictorySuperTypes) {
  ASSERT_TRUE(Add("P", {Define("a", Scalar::kLong, kNormal)}));
  ASSERT_TRUE(Add("Q", {Define("a", Scalar::kString, kNormal)}));
  const auto added = Add("X", {}, {"P", "Q"});
  ASSERT_FALSE(added);
  EXPECT_EQ(added.error().refusal, Refusal::kValueTypeRedefinition);
  EXPECT_EQ(added.error().redefinition->type_1, "P");
  EXPECT_EQ(added.error().redefinition->type_2, "Q");
}

TEST_F(TypeRepositoryTest, RejectsOtherErrorsInAType) {
  ASSERT_TRUE(Add("A", {}, {}, "IDL:acme/A:1.0"));
  EXPECT_EQ(Add("A").error().refusal, Refusal::kServiceTypeExists);
  EXPECT_EQ(Add("X", {}, {"Nowhere"}).error().refusal, Refusal::kUnknownServiceType);
  EXPECT_EQ(Add("X", {}, {"Nowhere"}).error().type, "Nowhere");
  EXPECT_EQ(Add("X", {}, {"A", "A"}, "IDL:acme/X:1.0").error().refusal,
            Refusal::kDuplicateServiceTypeName);
  EXPECT_EQ(Add("X", {Define("no way", Scalar::kLong, kNormal)}).error().refusal,
            Refusal::kIllegalPropertyName);
  EXPECT_EQ(Add("X", {Define("and", Scalar::kLong, kNormal)}).error().refusal,
            Refusal::kIllegalPropertyName);
  EXPECT_EQ(Add("X", {Define("a", Scalar::kLong, kNormal), Define("a", Scalar::kLong, kNormal)})
                .error()
                .refusal,
            Refusal::kDuplicatePropertyName);
  const auto mismatch = Add("X", {}, {"A"}, "");
  EXPECT_EQ(mismatch.error().refusal, Refusal::kInterfaceTypeMismatch);
  EXPECT_EQ(mismatch.error().interfaces->base_service, "A");
  EXPECT_EQ(mismatch.error().interfaces->base_interface, "IDL:acme/A:1.0");
  EXPECT_EQ(mismatch.error().interfaces->derived_service, "X");
}

TEST_F(TypeRepositoryTest, RemovesOnlyTypesWithoutSubTypes) {
  ASSERT_TRUE(Add("A"));
  ASSERT_TRUE(Add("B", {}, {"A"}));
  const auto refused = repository_.Remove("A");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().refusal, Refusal::kHasSubTypes);
  EXPECT_EQ(refused.error().type, "A");
  EXPECT_EQ(refused.error().name, "B");
  EXPECT_TRUE(repository_.Remove("B"));
  EXPECT_TRUE(repository_.Remove("A"));
  EXPECT_EQ(repository_.Remove("A").error().refusal, Refusal::kUnknownServiceType);
}

TEST_F(TypeRepositoryTest, MaskingAMaskedTypeOrUnmaskingAnUnmaskedTypeIsRefused) {
  ASSERT_TRUE(Add("A"));
  EXPECT_EQ(repository_.Unmask("A").error().refusal, Refusal::kNotMasked);
  EXPECT_TRUE(repository_.Mask("A"));
  EXPECT_TRUE(repository_.Describe("A")->masked);
  EXPECT_EQ(repository_.Mask("A").error().refusal, Refusal::kAlreadyMasked);
  EXPECT_TRUE(repository_.Unmask("A"));
  EXPECT_EQ(repository_.Mask("B").error().refusal, Refusal::kUnknownServiceType);
}

TEST(TypeRepository, RejectsTypesBeyondItsLimits) {
  TraderLimits limits;
  limits.type_names_bytes = 40;
  limits.super_types = 1;
  TypeRepository repository(limits);
  EXPECT_TRUE(repository.Add({.name = "A"}));
  EXPECT_TRUE(repository.Add({.name = "B", .super_types = {"A"}}));
  EXPECT_EQ(repository.Add({.name = "C", .super_types = {"B"}}).error().refusal, Refusal::kLimit);
  EXPECT_EQ(repository.Add({.name = std::string(30, 'x')}).error().refusal, Refusal::kLimit);
}

}  // namespace
}  // namespace gsv::broker
