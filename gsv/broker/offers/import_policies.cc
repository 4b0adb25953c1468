#include "gsv/broker/offers/import_policies.h"

#include <algorithm>

namespace gsv::broker {

Cardinalities EffectiveCardinalities(const ImportPolicies& policies,
                                     const TraderAttributes& attributes) {
  return {
      .search = std::min(policies.search_card.value_or(attributes.def_search_card),
                         attributes.max_search_card),
      .match = std::min(policies.match_card.value_or(attributes.def_match_card),
                        attributes.max_match_card),
      .returned = std::min(policies.return_card.value_or(attributes.def_return_card),
                           attributes.max_return_card),
  };
}

}  // namespace gsv::broker
