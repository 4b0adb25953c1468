#include "gsv/broker/service/dynamic_property_evaluator.h"

#include <algorithm>

#include <COS/CosTradingDynamic.hh>

#include "gsv/broker/encoding/corba_values.h"

namespace gsv::broker {
namespace {

using std::chrono::milliseconds;

std::optional<Value> Ask(const std::string& name, const OtherValue& property, milliseconds timeout,
                         std::size_t largest) {
  try {
    const CORBA::Any any = ToAny(Value::Other(property));
    const CosTradingDynamic::DynamicProp* question = nullptr;
    if (!(any >>= question) || CORBA::is_nil(question->eval_if)) return std::nullopt;
    // The reference was decoded for this call, so the timeout applies to this call only.
    omniORB::setClientCallTimeout(question->eval_if, static_cast<unsigned long>(timeout.count()));
    const CORBA::Any_var answer =
        question->eval_if->evalDP(name.c_str(), question->returned_type, question->extra_info);
    Value value = ToValue(answer.in());
    if (IsDynamic(value) || !value.Is(*property.promised_type) || value.EncodedSize() > largest) {
      return std::nullopt;
    }
    return value;
  } catch (const CORBA::Exception&) {
    return std::nullopt;  // the service raised DPEvalFailure, or does not respond
  }
}

}  // namespace

std::optional<Value> DynamicPropertyEvaluator::Evaluate(const std::string& name,
                                                        const OtherValue& property,
                                                        Clock::time_point deadline) {
  Question question(name, property.encoded);
  {
    const base::MutexLock lock(mutex_);
    const auto known = answers_.find(question);
    if (known != answers_.end() && known->second.expires > Clock::now()) {
      return known->second.value;
    }
  }
  const auto left = std::chrono::duration_cast<milliseconds>(deadline - Clock::now());
  if (left <= milliseconds::zero()) return std::nullopt;
  Answer answer;
  answer.value = Ask(name, property, std::min(limits_.call_timeout, left), limits_.value_bytes);
  answer.expires = Clock::now() + limits_.lifetime;
  Remember(std::move(question), answer);
  return answer.value;
}

void DynamicPropertyEvaluator::Remember(Question question, Answer answer) {
  const base::MutexLock lock(mutex_);
  if (answers_.size() >= limits_.answers) {
    const auto now = Clock::now();
    std::erase_if(answers_, [&](const auto& entry) { return entry.second.expires <= now; });
  }
  if (answers_.size() >= limits_.answers) answers_.clear();
  answers_.insert_or_assign(std::move(question), std::move(answer));
}

}  // namespace gsv::broker
