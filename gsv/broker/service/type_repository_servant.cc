#include "gsv/broker/service/type_repository_servant.h"

#include "gsv/broker/encoding/corba_values.h"
#include "gsv/broker/service/raise.h"
#include "gsv/broker/transport/memory_reserve.h"

namespace gsv::broker {
namespace {

using Repository = CosTradingRepos::ServiceTypeRepository;

Repository::ServiceTypeNameSeq* ToTypeNames(const std::vector<std::string>& names) {
  Repository::ServiceTypeNameSeq_var result = new Repository::ServiceTypeNameSeq;
  result->length(static_cast<CORBA::ULong>(names.size()));
  for (CORBA::ULong i = 0; i < names.size(); ++i) result[i] = names[i].c_str();
  return result._retn();
}

}  // namespace

Repository::IncarnationNumber TypeRepositoryServant::incarnation() {
  return ToIncarnation(trader_.NextIncarnation());
}

Repository::IncarnationNumber TypeRepositoryServant::add_type(
    const char* name, const char* if_name, const Repository::PropStructSeq& props,
    const Repository::ServiceTypeNameSeq& super_types) {
  RequireMemoryReserve();
  ServiceType type{.name = name, .interface_name = if_name};
  for (CORBA::ULong i = 0; i < props.length(); ++i) {
    type.properties.push_back(ToDefinition(props[i]));
  }
  for (CORBA::ULong i = 0; i < super_types.length(); ++i) {
    type.super_types.emplace_back(super_types[i]);
  }
  return ToIncarnation(ValueOrRaise(trader_.AddType(std::move(type))));
}

void TypeRepositoryServant::remove_type(const char* name) {
  ValueOrRaise(trader_.RemoveType(name));
}

Repository::ServiceTypeNameSeq* TypeRepositoryServant::list_types(
    const Repository::SpecifiedServiceTypes& which_types) {
  std::optional<std::uint64_t> since;
  if (which_types._d() == Repository::since) since = FromIncarnation(which_types.incarnation());
  return ToTypeNames(trader_.ListTypes(since));
}

Repository::TypeStruct* TypeRepositoryServant::describe_type(const char* name) {
  return new Repository::TypeStruct(ToCorba(ValueOrRaise(trader_.DescribeType(name))));
}

Repository::TypeStruct* TypeRepositoryServant::fully_describe_type(const char* name) {
  return new Repository::TypeStruct(ToCorba(ValueOrRaise(trader_.FullyDescribeType(name))));
}

void TypeRepositoryServant::mask_type(const char* name) { ValueOrRaise(trader_.MaskType(name)); }

void TypeRepositoryServant::unmask_type(const char* name) {
  ValueOrRaise(trader_.UnmaskType(name));
}

}  // namespace gsv::broker
