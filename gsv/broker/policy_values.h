// The policies that come with a query.
#pragma once

#include <COS/CosTrading.hh>

#include "gsv/broker/import_policies.h"

namespace gsv::broker {

// A policy with a name that the standard does not know is passed over.
// Errors  throws IllegalPolicyName, DuplicatePolicyName, PolicyTypeMismatch, InvalidPolicyValue.
ImportPolicies ToImportPolicies(const CosTrading::PolicySeq& policies);

}  // namespace gsv::broker
