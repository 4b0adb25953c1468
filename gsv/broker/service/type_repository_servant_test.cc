#include "gsv/broker/testing/broker_fixture.h"

namespace gsv::broker {
namespace {

class TypeRepositoryServantTest : public BrokerFixture {
 protected:
  static constexpr auto kNormal = CosTradingRepos::ServiceTypeRepository::PROP_NORMAL;
  static constexpr auto kMandatory = CosTradingRepos::ServiceTypeRepository::PROP_MANDATORY;

  std::vector<std::string> List(const Repository::SpecifiedServiceTypes& which) {
    const Repository::ServiceTypeNameSeq_var names = types_->list_types(which);
    std::vector<std::string> result;
    for (CORBA::ULong i = 0; i < names.in().length(); ++i) result.emplace_back(names.in()[i]);
    return result;
  }
};

TEST_F(TypeRepositoryServantTest, DescribesTypesAsTheyWereAdded) {
  const CORBA::TypeCode_var names = TestOrb()->create_sequence_tc(0, CORBA::_tc_string);
  AddType("Base", {Define("names", names, kMandatory)}, {}, "IDL:acme/Base:1.0");
  AddType("Derived",
          {Define("alias", CosTrading::_tc_PropertyName, kNormal),
           Define("structure", CosTrading::_tc_Policy, Repository::PROP_READONLY)},
          {"Base"}, "IDL:acme/Derived:1.0");
  const Repository::TypeStruct_var own = types_->describe_type("Derived");
  EXPECT_STREQ(own->if_name, "IDL:acme/Derived:1.0");
  ASSERT_EQ(own->props.length(), 2u);
  EXPECT_TRUE(own->props[0].value_type->equal(CosTrading::_tc_PropertyName)) << "alias and all";
  EXPECT_TRUE(own->props[1].value_type->equal(CosTrading::_tc_Policy));
  EXPECT_EQ(own->props[1].mode, Repository::PROP_READONLY);
  ASSERT_EQ(own->super_types.length(), 1u);
  EXPECT_STREQ(own->super_types[0], "Base");
  EXPECT_FALSE(own->masked);

  const Repository::TypeStruct_var full = types_->fully_describe_type("Derived");
  ASSERT_EQ(full->props.length(), 3u);
  EXPECT_STREQ(full->props[2].name, "names");
  EXPECT_TRUE(full->props[2].value_type->equal(names));
  EXPECT_EQ(full->props[2].mode, kMandatory);
}

TEST_F(TypeRepositoryServantTest, ListsAllTypesOrThoseSinceAnIncarnation) {
  AddType("A");
  const Repository::IncarnationNumber since = types_->incarnation();
  const Repository::IncarnationNumber added = AddType("B");
  EXPECT_EQ(added.low, since.low);
  EXPECT_EQ(added.high, since.high);
  Repository::SpecifiedServiceTypes which;
  which._default();
  EXPECT_EQ(List(which), (std::vector<std::string>{"A", "B"}));
  which.incarnation(since);
  EXPECT_EQ(List(which), std::vector<std::string>{"B"});
}

TEST_F(TypeRepositoryServantTest, RaisesForInvalidTypes) {
  AddType("A", {Define("a", CORBA::_tc_long, kMandatory)}, {}, "IDL:acme/A:1.0");
  const std::string interface_name = "IDL:acme/X:1.0";
  EXPECT_STREQ(Raised<CosTrading::IllegalServiceType>([&] { AddType("1"); }).type, "1");
  EXPECT_STREQ(Raised<Repository::ServiceTypeExists>([&] { AddType("A"); }).name, "A");
  EXPECT_STREQ(Raised<CosTrading::IllegalPropertyName>([&] {
                 AddType("X", {Define("a b", CORBA::_tc_long, kNormal)});
               }).name,
               "a b");
  EXPECT_STREQ(Raised<CosTrading::DuplicatePropertyName>([&] {
                 AddType("X", {Define("a", CORBA::_tc_long, kNormal),
                               Define("a", CORBA::_tc_long, kNormal)});
               }).name,
               "a");
  EXPECT_STREQ(Raised<CosTrading::UnknownServiceType>([&] { AddType("X", {}, {"B"}); }).type, "B");
  EXPECT_STREQ(Raised<Repository::DuplicateServiceTypeName>([&] {
                 AddType("X", {}, {"A", "A"}, interface_name);
               }).name,
               "A");
  const auto interfaces =
      Raised<Repository::InterfaceTypeMismatch>([&] { AddType("X", {}, {"A"}, ""); });
  EXPECT_STREQ(interfaces.base_service, "A");
  EXPECT_STREQ(interfaces.base_if, "IDL:acme/A:1.0");
  EXPECT_STREQ(interfaces.derived_service, "X");
  EXPECT_STREQ(interfaces.derived_if, "");
  const auto redefinition = Raised<Repository::ValueTypeRedefinition>(
      [&] { AddType("X", {Define("a", CORBA::_tc_string, kMandatory)}, {"A"}, interface_name); });
  EXPECT_STREQ(redefinition.type_1, "X");
  EXPECT_STREQ(redefinition.definition_1.name, "a");
  EXPECT_TRUE(redefinition.definition_1.value_type->equal(CORBA::_tc_string));
  EXPECT_EQ(redefinition.definition_1.mode, kMandatory);
  EXPECT_STREQ(redefinition.type_2, "A");
  EXPECT_TRUE(redefinition.definition_2.value_type->equal(CORBA::_tc_long));
}

TEST_F(TypeRepositoryServantTest, RemovesTypesWithoutSubTypes) {
  AddType("A");
  AddType("B", {}, {"A"});
  const auto has_sub_types = Raised<Repository::HasSubTypes>([&] { types_->remove_type("A"); });
  EXPECT_STREQ(has_sub_types.the_type, "A");
  EXPECT_STREQ(has_sub_types.sub_type, "B");
  types_->remove_type("B");
  types_->remove_type("A");
  EXPECT_STREQ(Raised<CosTrading::UnknownServiceType>([&] { types_->remove_type("A"); }).type, "A");
  EXPECT_STREQ(Raised<CosTrading::IllegalServiceType>([&] { types_->remove_type("?"); }).type, "?");
}

TEST_F(TypeRepositoryServantTest, MaskedTypesRefuseNewOffersAndKeepOldOnes) {
  AddType("A");
  AddType("B", {}, {"A"});
  Export("A");
  types_->mask_type("A");
  EXPECT_TRUE(Repository::TypeStruct_var(types_->describe_type("A"))->masked);
  EXPECT_STREQ(Raised<CosTrading::UnknownServiceType>([&] { Export("A"); }).type, "A");
  Export("B");
  EXPECT_EQ(Query("A").offers->length(), 2u);
  EXPECT_STREQ(Raised<Repository::AlreadyMasked>([&] { types_->mask_type("A"); }).name, "A");
  types_->unmask_type("A");
  Export("A");
  EXPECT_STREQ(Raised<Repository::NotMasked>([&] { types_->unmask_type("A"); }).name, "A");
}

TEST_F(TypeRepositoryServantTest, RaisesForInvalidOrUnknownNames) {
  const auto illegal = [](const auto& call) {
    EXPECT_STREQ(Raised<CosTrading::IllegalServiceType>([&] { call("a b"); }).type, "a b");
  };
  const auto unknown = [](const auto& call) {
    EXPECT_STREQ(Raised<CosTrading::UnknownServiceType>([&] { call("Q"); }).type, "Q");
  };
  const auto both = [&](const auto& call) {
    illegal(call);
    unknown(call);
  };
  both([&](const char* name) { Repository::TypeStruct_var(types_->describe_type(name)); });
  both([&](const char* name) { Repository::TypeStruct_var(types_->fully_describe_type(name)); });
  both([&](const char* name) { types_->mask_type(name); });
  both([&](const char* name) { types_->unmask_type(name); });
}

}  // namespace
}  // namespace gsv::broker
