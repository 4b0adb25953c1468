// Implements the CORBA interface CosTrading::Lookup: answers queries, and serves the iterators over
// their results.
#pragma once

#include <COS/CosTrading.hh>

#include "gsv/broker/service/attribute_servants.h"

namespace gsv::broker {

class LookupServant : public POA_CosTrading::Lookup,
                      public ComponentsServant,
                      public SupportServant,
                      public ImportServant {
 public:
  explicit LookupServant(TradingObjects& objects);

  void query(const char* type, const char* constr, const char* pref,
             const CosTrading::PolicySeq& policies,
             const CosTrading::Lookup::SpecifiedProps& desired_props, CORBA::ULong how_many,
             CosTrading::OfferSeq_out offers, CosTrading::OfferIterator_out offer_itr,
             CosTrading::PolicyNameSeq_out limits_applied) override;
};

// One servant serves all iterators: the object id is the cursor's key.
class OfferIteratorServant : public POA_CosTrading::OfferIterator {
 public:
  explicit OfferIteratorServant(TradingObjects& objects) : objects_(objects) {}

  CORBA::ULong max_left() override;
  CORBA::Boolean next_n(CORBA::ULong n, CosTrading::OfferSeq_out offers) override;
  void destroy() override;

 private:
  TradingObjects& objects_;  // the trader, and the cursors of all iterators over offers
};

}  // namespace gsv::broker
