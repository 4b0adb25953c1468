// Implements the CORBA interface CosTrading::Admin: sets the trader's attributes, and lists the ids
// of all offers.
#pragma once

#include <string>
#include <vector>

#include <COS/CosTrading.hh>

#include "gsv/broker/service/attribute_servants.h"

namespace gsv::broker {

class AdminServant : public POA_CosTrading::Admin,
                     public ComponentsServant,
                     public SupportServant,
                     public ImportServant {
 public:
  explicit AdminServant(TradingObjects& objects);

  CosTrading::FollowOption max_link_follow_policy() override;
  CosTrading::Admin::OctetSeq* request_id_stem() override;

  // Each function returns the previous value.
  CORBA::ULong set_def_search_card(CORBA::ULong value) override;
  CORBA::ULong set_max_search_card(CORBA::ULong value) override;
  CORBA::ULong set_def_match_card(CORBA::ULong value) override;
  CORBA::ULong set_max_match_card(CORBA::ULong value) override;
  CORBA::ULong set_def_return_card(CORBA::ULong value) override;
  CORBA::ULong set_max_return_card(CORBA::ULong value) override;
  CORBA::ULong set_max_list(CORBA::ULong value) override;
  CORBA::ULong set_def_hop_count(CORBA::ULong value) override;
  CORBA::ULong set_max_hop_count(CORBA::ULong value) override;
  CosTrading::FollowOption set_def_follow_policy(CosTrading::FollowOption policy) override;
  CosTrading::FollowOption set_max_follow_policy(CosTrading::FollowOption policy) override;
  CosTrading::FollowOption set_max_link_follow_policy(CosTrading::FollowOption policy) override;
  CosTrading::Admin::OctetSeq* set_request_id_stem(
      const CosTrading::Admin::OctetSeq& stem) override;
  CORBA::Boolean set_supports_modifiable_properties(CORBA::Boolean value) override;
  CORBA::Boolean set_supports_dynamic_properties(CORBA::Boolean value) override;

  CORBA::Boolean set_supports_proxy_offers(CORBA::Boolean value) override;

  // Throws CORBA::NO_IMPLEMENT for any repository other than the trader's own repository.
  CORBA::Object_ptr set_type_repos(CORBA::Object_ptr repository) override;

  void list_offers(CORBA::ULong how_many, CosTrading::OfferIdSeq_out ids,
                   CosTrading::OfferIdIterator_out id_itr) override;
  void list_proxies(CORBA::ULong how_many, CosTrading::OfferIdSeq_out ids,
                    CosTrading::OfferIdIterator_out id_itr) override;

 private:
  // Sets an attribute and returns its previous value.
  template <typename T>
  T Exchange(T TraderAttributes::*attribute, T value);
  // Returns the first `how_many` ids, and an iterator for the other ids.
  void HandOut(std::vector<std::string> all, CORBA::ULong how_many, CosTrading::OfferIdSeq_out ids,
               CosTrading::OfferIdIterator_out id_itr);
};

// Serves all iterators over ids: the object id is the cursor's key.
class OfferIdIteratorServant : public POA_CosTrading::OfferIdIterator {
 public:
  explicit OfferIdIteratorServant(TradingObjects& objects) : objects_(objects) {}

  CORBA::ULong max_left() override;
  CORBA::Boolean next_n(CORBA::ULong n, CosTrading::OfferIdSeq_out ids) override;
  void destroy() override;

 private:
  TradingObjects& objects_;  // the trader, and the cursors of all iterators over ids
};

}  // namespace gsv::broker
