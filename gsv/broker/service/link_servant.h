// Implements the CORBA interface CosTrading::Link: adds, changes, lists and removes links to other
// traders.
#pragma once

#include <COS/CosTrading.hh>

#include "gsv/broker/service/attribute_servants.h"

namespace gsv::broker {

class LinkServant : public POA_CosTrading::Link, public ComponentsServant, public SupportServant {
 public:
  explicit LinkServant(TradingObjects& objects)
      : ComponentsServant(objects), SupportServant(objects) {}

  CosTrading::FollowOption max_link_follow_policy() override;

  void add_link(const char* name, CosTrading::Lookup_ptr target,
                CosTrading::FollowOption def_pass_on_follow_rule,
                CosTrading::FollowOption limiting_follow_rule) override;
  void remove_link(const char* name) override;
  // Gets the target's Register within a second. The reference is nil if the target has none.
  CosTrading::Link::LinkInfo* describe_link(const char* name) override;
  CosTrading::LinkNameSeq* list_links() override;
  void modify_link(const char* name, CosTrading::FollowOption def_pass_on_follow_rule,
                   CosTrading::FollowOption limiting_follow_rule) override;
};

// Returns the Register of the trader at `target`, or nil if it has none or does not answer within a
// second.
CosTrading::Register_ptr RegisterOf(CORBA::ORB_ptr orb, const std::string& target);

// Returns the reference to another trader's Lookup as a string.
// Errors  throws InvalidLookupRef if `target` is nil, has another interface, or does not tell.
std::string CheckLookup(CORBA::ORB_ptr orb, CosTrading::Lookup_ptr target);

}  // namespace gsv::broker
