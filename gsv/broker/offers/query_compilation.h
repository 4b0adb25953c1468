// Parses a query's constraint and preference and checks them against the service type.
#pragma once

#include <string>

#include "gsv/broker/language/expression.h"
#include "gsv/broker/language/limits.h"
#include "gsv/broker/offers/service_type.h"
#include "gsv/broker/offers/trading_error.h"

namespace gsv::broker {

// `type` must be fully described (see TypeRepository::FullyDescribe()).
// Errors  kIllegalConstraint, kIllegalPreference.
TradingResult<Expression> CompileConstraint(const std::string& text, const ServiceType& type,
                                            const ExpressionLimits& limits);
TradingResult<Preference> CompilePreference(const std::string& text, const ServiceType& type,
                                            const ExpressionLimits& limits);

}  // namespace gsv::broker
