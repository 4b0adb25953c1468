#include "gsv/broker/testing/broker_fixture.h"

#include <COS/CosTradingDynamic.hh>

#include "gsv/base/check.h"
#include "gsv/broker/encoding/corba_values.h"

namespace gsv::broker {
namespace {

class Service : public POA_CosTradingDynamic::DynamicPropEval {
 public:
  CORBA::Any* evalDP(const char*, CORBA::TypeCode_ptr, const CORBA::Any&) override {
    return new CORBA::Any;
  }
};

CORBA::ORB_ptr StartOrb() {
  const char* settings[][2] = {{"endPoint", "giop:tcp:127.0.0.1:"},
                               {"clientCallTimeOutPeriod", "20000"},
                               {"traceLevel", "0"},
                               {nullptr, nullptr}};
  int no_arguments = 0;
  CORBA::ORB_ptr orb = CORBA::ORB_init(no_arguments, nullptr, "omniORB4", settings);
  const CORBA::Object_var object = orb->resolve_initial_references("RootPOA");
  const PortableServer::POA_var poa = PortableServer::POA::_narrow(object);
  PortableServer::POAManager_var(poa->the_POAManager())->activate();
  return orb;
}

}  // namespace

CORBA::ORB_ptr TestOrb() {
  static const CORBA::ORB_ptr orb = StartOrb();
  return orb;
}

CORBA::Object_ptr TestService() {
  static const CORBA::Object_ptr service = [] {
    TestOrb();
    return (new Service)->_this();
  }();
  return service;
}

BrokerFixture::BrokerFixture(std::vector<std::string> arguments) : broker_(std::move(arguments)) {
  const CORBA::Object_var object = TestOrb()->string_to_object(broker_.reference().c_str());
  lookup_ = Lookup::_narrow(object);
  GSV_CHECK(!CORBA::is_nil(lookup_));
  register_ = lookup_->register_if();
  admin_ = lookup_->admin_if();
  const CORBA::Object_var types = lookup_->type_repos();
  types_ = Repository::_narrow(types);
}

BrokerFixture::Repository::IncarnationNumber BrokerFixture::AddType(
    const std::string& name, const std::vector<Repository::PropStruct>& properties,
    const std::vector<std::string>& super_types, const std::string& interface_name) {
  Repository::PropStructSeq props;
  props.length(static_cast<CORBA::ULong>(properties.size()));
  for (CORBA::ULong i = 0; i < properties.size(); ++i) props[i] = properties[i];
  Repository::ServiceTypeNameSeq supers;
  supers.length(static_cast<CORBA::ULong>(super_types.size()));
  for (CORBA::ULong i = 0; i < super_types.size(); ++i) supers[i] = super_types[i].c_str();
  return types_->add_type(name.c_str(), interface_name.c_str(), props, supers);
}

BrokerFixture::Repository::PropStruct BrokerFixture::Define(const char* name,
                                                            CORBA::TypeCode_ptr type,
                                                            Repository::PropertyMode mode) {
  Repository::PropStruct prop;
  prop.name = name;
  prop.value_type = CORBA::TypeCode::_duplicate(type);
  prop.mode = mode;
  return prop;
}

std::string BrokerFixture::Export(const std::string& type,
                                  const std::vector<Property>& properties) {
  const CORBA::String_var id =
      register_->_cxx_export(TestService(), type.c_str(), Sequence(properties));
  return id.in();
}

CosTrading::PropertySeq BrokerFixture::Sequence(const std::vector<Property>& properties) {
  CosTrading::PropertySeq result;
  result.length(static_cast<CORBA::ULong>(properties.size()));
  for (CORBA::ULong i = 0; i < properties.size(); ++i) result[i] = ToCorba(properties[i]);
  return result;
}

CosTrading::Policy BrokerFixture::Policy(const char* name, const CORBA::Any& value) {
  CosTrading::Policy policy;
  policy.name = name;
  policy.value = value;
  return policy;
}

BrokerFixture::Answer BrokerFixture::Query(const std::string& type, const std::string& constraint,
                                           const std::string& preference,
                                           const std::vector<CosTrading::Policy>& policies,
                                           CORBA::ULong how_many) {
  Lookup::SpecifiedProps desired;
  desired._d(Lookup::all);
  return Query(type, constraint, preference, policies, how_many, desired);
}

BrokerFixture::Answer BrokerFixture::Query(const std::string& type, const std::string& constraint,
                                           const std::string& preference,
                                           const std::vector<CosTrading::Policy>& policies,
                                           CORBA::ULong how_many,
                                           const Lookup::SpecifiedProps& desired) {
  CosTrading::PolicySeq sequence;
  sequence.length(static_cast<CORBA::ULong>(policies.size()));
  for (CORBA::ULong i = 0; i < policies.size(); ++i) sequence[i] = policies[i];
  Answer answer;
  lookup_->query(type.c_str(), constraint.c_str(), preference.c_str(), sequence, desired, how_many,
                 answer.offers, answer.rest, answer.limits_applied);
  return answer;
}

}  // namespace gsv::broker
