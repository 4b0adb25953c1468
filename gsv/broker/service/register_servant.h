// Implements the CORBA interface CosTrading::Register: exports, describes, changes and withdraws
// offers.
#pragma once

#include <COS/CosTrading.hh>

#include "gsv/broker/service/attribute_servants.h"

namespace gsv::broker {

class RegisterServant : public POA_CosTrading::Register,
                        public ComponentsServant,
                        public SupportServant {
 public:
  explicit RegisterServant(TradingObjects& objects)
      : ComponentsServant(objects), SupportServant(objects) {}

  // omniORB's spelling of `export`, which is a keyword of C++.
  char* _cxx_export(CORBA::Object_ptr reference, const char* type,
                    const CosTrading::PropertySeq& properties) override;
  void withdraw(const char* id) override;
  CosTrading::Register::OfferInfo* describe(const char* id) override;
  void modify(const char* id, const CosTrading::PropertyNameSeq& del_list,
              const CosTrading::PropertySeq& modify_list) override;
  void withdraw_using_constraint(const char* type, const char* constr) override;
  CosTrading::Register_ptr resolve(const CosTrading::TraderName& name) override;
};

}  // namespace gsv::broker
