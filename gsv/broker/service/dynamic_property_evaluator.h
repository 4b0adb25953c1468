// Gets the values of dynamic properties from services (CosTradingDynamic::DynamicPropEval).
//
// Values and failed calls are cached for a short time, so that many queries need few calls.
//
// Threads  any; no lock is held during a call.
#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "gsv/base/mutex.h"
#include "gsv/broker/language/limits.h"
#include "gsv/broker/offers/dynamic_values.h"

namespace gsv::broker {

class DynamicPropertyEvaluator : public DynamicEvaluator {
 public:
  explicit DynamicPropertyEvaluator(const DynamicLimits& limits) : limits_(limits) {}

  std::optional<Value> Evaluate(const std::string& name, const OtherValue& property,
                                Clock::time_point deadline) override;

 private:
  // The key of a cached answer: the property's name, and the service and arguments of the call as
  // CDR.
  using Question = std::pair<std::string, std::string>;
  // A cached answer of a service.
  struct Answer {
    std::optional<Value> value;  // nullopt if the call failed
    Clock::time_point expires;   // after this time, the service is called again
  };

  // Adds an answer to the cache, within the limits.
  void Remember(Question question, Answer answer);

  const DynamicLimits limits_;
  base::Mutex mutex_;
  std::map<Question, Answer> answers_ GSV_GUARDED_BY(mutex_);
};

}  // namespace gsv::broker
