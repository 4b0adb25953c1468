#include <COS/CosTradingDynamic.hh>

#include "gsv/broker/testing/broker_fixture.h"

namespace gsv::broker {
namespace {

class RegisterServantTest : public BrokerFixture {
 protected:
  RegisterServantTest() {
    AddType("Robot", {Define("name", CORBA::_tc_string, Repository::PROP_MANDATORY_READONLY),
                      Define("speed", CORBA::_tc_double, Repository::PROP_NORMAL),
                      Define("legs", CORBA::_tc_ulong, Repository::PROP_MANDATORY)});
  }

  std::vector<Property> Minimal() {
    return {{"name", Value::String("r")}, {"legs", Value::ULong(4)}};
  }

  std::vector<Property> MinimalAnd(Property property) {
    std::vector<Property> properties = Minimal();
    properties.push_back(std::move(property));
    return properties;
  }

  void Modify(const std::string& id, const std::vector<const char*>& remove,
              const std::vector<Property>& set) {
    CosTrading::PropertyNameSeq names;
    names.length(static_cast<CORBA::ULong>(remove.size()));
    for (CORBA::ULong i = 0; i < remove.size(); ++i) names[i] = remove[i];
    register_->modify(id.c_str(), names, Sequence(set));
  }

  static CosTrading::TraderName Name(const char* component) {
    CosTrading::TraderName name;
    name.length(1);
    name[0] = component;
    return name;
  }
};

TEST_F(RegisterServantTest, DescribesExports) {
  const std::string id = Export("Robot", MinimalAnd({"speed", Value::Double(1.5)}));
  const Register::OfferInfo_var info = register_->describe(id.c_str());
  EXPECT_STREQ(info->type, "Robot");
  EXPECT_TRUE(info->reference->_is_equivalent(TestService()));
  ASSERT_EQ(info->properties.length(), 3u);
  EXPECT_STREQ(info->properties[2].name, "speed");
  CORBA::Double speed = 0;
  EXPECT_TRUE(info->properties[2].value >>= speed);
  EXPECT_EQ(speed, 1.5);
}

TEST_F(RegisterServantTest, ReturnsValuesOfEveryTypeUnchanged) {
  CosTrading::Property structure;
  structure.name = "structure";
  CosTrading::Policy content;
  content.name = "inner";
  content.value <<= "text";
  structure.value <<= content;

  std::vector<Property> simple = Minimal();
  simple.push_back({"boolean", Value::Boolean(true)});
  simple.push_back({"character", Value::Char('x')});
  simple.push_back({"single", Value::Float(0.5f)});
  simple.push_back({"small", Value::Short(-2)});
  simple.push_back({"small_unsigned", Value::UShort(65535)});
  simple.push_back({"large", Value::ULong(4294967295u)});
  simple.push_back({"numbers", Value::SequenceOf(Scalar::kDouble, {1.5, -2.5})});
  simple.push_back({"flags", Value::SequenceOf(Scalar::kBoolean, {true, false})});
  CosTrading::PropertySeq properties = Sequence(simple);
  properties.length(properties.length() + 1);
  properties[properties.length() - 1] = structure;

  const CORBA::String_var id = register_->_cxx_export(TestService(), "Robot", properties);
  const Register::OfferInfo_var info = register_->describe(id);
  ASSERT_EQ(info->properties.length(), properties.length());
  for (CORBA::ULong i = 0; i < properties.length(); ++i) {
    bool found = false;
    for (CORBA::ULong j = 0; j < info->properties.length(); ++j) {
      if (std::string(info->properties[j].name) != properties[i].name.in()) continue;
      found = true;
      const CORBA::TypeCode_var sent = properties[i].value.type();
      const CORBA::TypeCode_var received = info->properties[j].value.type();
      EXPECT_TRUE(sent->equal(received)) << properties[i].name;
      const CosTrading::Policy* policy = nullptr;
      if (info->properties[j].value >>= policy) {
        const char* text = nullptr;
        EXPECT_TRUE(policy->value >>= text);
        EXPECT_STREQ(text, "text");
      }
    }
    EXPECT_TRUE(found) << properties[i].name;
  }
  EXPECT_EQ(Query("Robot",
                  "boolean and character == 'x' and single == 0.5 and small == -2 and "
                  "small_unsigned == 65535 and large == 4294967295 and -2.5 in numbers "
                  "and FALSE in flags and exist structure")
                .offers->length(),
            1u);
  EXPECT_EQ(Query("Robot", "structure == 1").offers->length(), 0u);
}

TEST_F(RegisterServantTest, RaisesForInvalidExports) {
  const auto attempt = [&](const char* type, const std::vector<Property>& properties) {
    register_->_cxx_export(TestService(), type, Sequence(properties));
  };
  EXPECT_TRUE(CORBA::is_nil(Raised<Register::InvalidObjectRef>([&] {
                              register_->_cxx_export(CORBA::Object::_nil(), "Robot",
                                                     Sequence(Minimal()));
                            }).ref));
  EXPECT_STREQ(Raised<CosTrading::IllegalServiceType>([&] { attempt("<x>", Minimal()); }).type,
               "<x>");
  EXPECT_STREQ(Raised<CosTrading::UnknownServiceType>([&] { attempt("Plane", Minimal()); }).type,
               "Plane");
  EXPECT_STREQ(Raised<CosTrading::IllegalPropertyName>([&] {
                 attempt("Robot", MinimalAnd({"<foo-bar", Value::Long(1)}));
               }).name,
               "<foo-bar");
  EXPECT_STREQ(Raised<CosTrading::DuplicatePropertyName>([&] {
                 attempt("Robot", MinimalAnd({"legs", Value::ULong(1)}));
               }).name,
               "legs");
  const auto mismatch = Raised<CosTrading::PropertyTypeMismatch>([&] {
    attempt("Robot", MinimalAnd({"speed", Value::String("fast")}));
  });
  EXPECT_STREQ(mismatch.type, "Robot");
  EXPECT_STREQ(mismatch.prop.name, "speed");
  const char* value = nullptr;
  EXPECT_TRUE(mismatch.prop.value >>= value);
  EXPECT_STREQ(value, "fast");
  const auto missing = Raised<CosTrading::MissingMandatoryProperty>([&] {
    attempt("Robot", {{"name", Value::String("r")}});
  });
  EXPECT_STREQ(missing.type, "Robot");
  EXPECT_STREQ(missing.name, "legs");
}

TEST_F(RegisterServantTest, RaisesForDynamicProperties) {
  CosTradingDynamic::DynamicProp dynamic;
  dynamic.eval_if = CosTradingDynamic::DynamicPropEval::_narrow(TestService());
  dynamic.returned_type = CORBA::TypeCode::_duplicate(CORBA::_tc_string);
  CosTrading::PropertySeq properties = Sequence(Minimal());
  properties[0].value <<= dynamic;
  const auto readonly = Raised<CosTrading::ReadonlyDynamicProperty>(
      [&] { register_->_cxx_export(TestService(), "Robot", properties); });
  EXPECT_STREQ(readonly.type, "Robot");
  EXPECT_STREQ(readonly.name, "name");
  properties = Sequence(MinimalAnd({"speed", Value::Double(1)}));
  properties[2].value <<= dynamic;
  EXPECT_STREQ(Raised<CosTrading::PropertyTypeMismatch>([&] {
                 register_->_cxx_export(TestService(), "Robot", properties);
               }).prop.name,
               "speed");
}

TEST_F(RegisterServantTest, RaisesForADynamicPropertyThatAModificationAdds) {
  AddType("Ship", {Define("hull", CORBA::_tc_string, Repository::PROP_READONLY)});
  const std::string id = Export("Ship");
  CosTradingDynamic::DynamicProp dynamic;
  dynamic.eval_if = CosTradingDynamic::DynamicPropEval::_narrow(TestService());
  dynamic.returned_type = CORBA::TypeCode::_duplicate(CORBA::_tc_string);
  CosTrading::PropertySeq properties;
  properties.length(1);
  properties[0].name = "hull";
  properties[0].value <<= dynamic;
  const auto readonly = Raised<CosTrading::ReadonlyDynamicProperty>(
      [&] { register_->modify(id.c_str(), {}, properties); });
  EXPECT_STREQ(readonly.type, "Ship");
  EXPECT_STREQ(readonly.name, "hull");
}

TEST_F(RegisterServantTest, ChecksTheInterfaceOfTheService) {
  AddType("Evaluator", {}, {}, kServiceInterface);
  AddType("Scoped", {}, {}, "::CosTradingDynamic::DynamicPropEval");
  AddType("Broker", {}, {}, "IDL:omg.org/CosTrading/TraderComponents:1.0");
  Export("Evaluator");
  Export("Scoped");
  const auto mismatch = Raised<Register::InterfaceTypeMismatch>([&] { Export("Broker"); });
  EXPECT_STREQ(mismatch.type, "Broker");
  EXPECT_TRUE(mismatch.reference->_is_equivalent(TestService()));
  // The service has a derived interface, which only the service itself knows.
  const CORBA::String_var id = register_->_cxx_export(lookup_, "Broker", {});
  EXPECT_STRNE(id, "");
}

TEST_F(RegisterServantTest, RaisesForAServiceThatDoesNotAnswer) {
  AddType("Evaluator", {}, {}, kServiceInterface);
  // Port 1 refuses connections.
  const CORBA::Object_var nobody = TestOrb()->string_to_object("corbaloc::1.2@127.0.0.1:1/Nobody");
  const auto invalid =
      Raised<Register::InvalidObjectRef>([&] { register_->_cxx_export(nobody, "Evaluator", {}); });
  EXPECT_FALSE(CORBA::is_nil(invalid.ref));
}

TEST_F(RegisterServantTest, WithdrawsOnce) {
  const std::string id = Export("Robot", Minimal());
  register_->withdraw(id.c_str());
  EXPECT_STREQ(Raised<CosTrading::UnknownOfferId>([&] { register_->withdraw(id.c_str()); }).id,
               id.c_str());
  EXPECT_STREQ(Raised<CosTrading::UnknownOfferId>([&] { register_->describe(id.c_str()); }).id,
               id.c_str());
  EXPECT_STREQ(Raised<CosTrading::IllegalOfferId>([&] { register_->withdraw("x"); }).id, "x");
  EXPECT_STREQ(Raised<CosTrading::IllegalOfferId>([&] { register_->describe("x"); }).id, "x");
}

TEST_F(RegisterServantTest, ModifiesAndRaises) {
  const std::string id = Export("Robot", MinimalAnd({"speed", Value::Double(1)}));
  Modify(id, {"speed"}, {{"legs", Value::ULong(6)}, {"colour", Value::String("red")}});
  EXPECT_EQ(Query("Robot", "not exist speed and legs == 6 and colour == 'red'").offers->length(),
            1u);

  EXPECT_STREQ(Raised<CosTrading::IllegalOfferId>([&] { Modify("x", {}, {}); }).id, "x");
  const std::string unknown = id.substr(0, 9) + "ffffffffffffffff";
  EXPECT_STREQ(Raised<CosTrading::UnknownOfferId>([&] { Modify(unknown, {}, {}); }).id,
               unknown.c_str());
  EXPECT_STREQ(Raised<CosTrading::IllegalPropertyName>([&] { Modify(id, {"1"}, {}); }).name, "1");
  EXPECT_STREQ(Raised<Register::UnknownPropertyName>([&] { Modify(id, {"speed"}, {}); }).name,
               "speed");
  EXPECT_STREQ(Raised<CosTrading::PropertyTypeMismatch>([&] {
                 Modify(id, {}, {{"legs", Value::Long(1)}});
               }).prop.name,
               "legs");
  const auto mandatory = Raised<Register::MandatoryProperty>([&] { Modify(id, {"legs"}, {}); });
  EXPECT_STREQ(mandatory.type, "Robot");
  EXPECT_STREQ(mandatory.name, "legs");
  const auto readonly = Raised<Register::ReadonlyProperty>([&] {
    Modify(id, {}, {{"name", Value::String("other")}});
  });
  EXPECT_STREQ(readonly.type, "Robot");
  EXPECT_STREQ(readonly.name, "name");
  EXPECT_STREQ(Raised<CosTrading::DuplicatePropertyName>([&] {
                 Modify(id, {"colour"}, {{"colour", Value::Long(1)}});
               }).name,
               "colour");
  EXPECT_TRUE(admin_->set_supports_modifiable_properties(false));
  Raised<CosTrading::NotImplemented>([&] { Modify(id, {}, {}); });
}

TEST_F(RegisterServantTest, WithdrawsUsingAConstraint) {
  Export("Robot", Minimal());
  Export("Robot", {{"name", Value::String("s")}, {"legs", Value::ULong(2)}});
  const auto withdraw = [&](const char* type, const char* constraint) {
    register_->withdraw_using_constraint(type, constraint);
  };
  withdraw("Robot", "legs == 4");
  EXPECT_EQ(Query("Robot").offers->length(), 1u);
  EXPECT_STREQ(Raised<Register::NoMatchingOffers>([&] { withdraw("Robot", "legs == 4"); }).constr,
               "legs == 4");
  EXPECT_STREQ(Raised<CosTrading::IllegalConstraint>([&] { withdraw("Robot", "((("); }).constr,
               "(((");
  EXPECT_STREQ(Raised<CosTrading::UnknownServiceType>([&] { withdraw("Plane", ""); }).type,
               "Plane");
  EXPECT_STREQ(Raised<CosTrading::IllegalServiceType>([&] { withdraw("", ""); }).type, "");
}

TEST_F(RegisterServantTest, ResolvesNoOtherTrader) {
  EXPECT_EQ(Raised<Register::IllegalTraderName>([&] { register_->resolve({}); }).name.length(), 0u);
  EXPECT_STREQ(
      Raised<Register::IllegalTraderName>([&] { register_->resolve(Name("a b")); }).name[0], "a b");
  EXPECT_STREQ(
      Raised<Register::UnknownTraderName>([&] { register_->resolve(Name("other")); }).name[0],
      "other");
}

}  // namespace
}  // namespace gsv::broker
