// Implements the CORBA interface CosTradingRepos::ServiceTypeRepository: adds, describes and
// removes service types.
#pragma once

#include <COS/CosTradingRepos.hh>

#include "gsv/broker/trader/trader.h"

namespace gsv::broker {

class TypeRepositoryServant : public POA_CosTradingRepos::ServiceTypeRepository {
 public:
  using Repository = CosTradingRepos::ServiceTypeRepository;

  explicit TypeRepositoryServant(Trader& trader) : trader_(trader) {}

  Repository::IncarnationNumber incarnation() override;
  Repository::IncarnationNumber add_type(
      const char* name, const char* if_name, const Repository::PropStructSeq& props,
      const Repository::ServiceTypeNameSeq& super_types) override;
  void remove_type(const char* name) override;
  Repository::ServiceTypeNameSeq* list_types(
      const Repository::SpecifiedServiceTypes& which_types) override;
  Repository::TypeStruct* describe_type(const char* name) override;
  Repository::TypeStruct* fully_describe_type(const char* name) override;
  void mask_type(const char* name) override;
  void unmask_type(const char* name) override;

 private:
  Trader& trader_;
};

}  // namespace gsv::broker
