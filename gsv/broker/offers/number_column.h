// The numbers that offers have in a property, side by side, so that looking through many of them
// does not go from offer to offer.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gsv/base/mutex.h"
#include "gsv/broker/language/offer.h"
#include "gsv/broker/offers/number_terms.h"

namespace gsv::broker {

// Nothing when a double cannot hold it exactly.
std::optional<double> ExactNumber(std::int64_t integer);

// What is known of an offer after some terms.
enum class Choice : std::uint8_t {
  kNo,       // one of them is FALSE or has no value
  kYes,      // all of them are TRUE
  kUnknown,  // the expression must be evaluated
};

class NumberColumn {
 public:
  NumberColumn(const Offers& offers, const std::string& property);

  // What min and max order the offer at `index` by: NaN for none. Nothing when the offer must be
  // asked.
  std::optional<double> At(std::size_t index) const;
  // Narrows `choices`, one for each offer, to those for which `term` is TRUE.
  void Narrow(const NumberTerm& term, std::vector<Choice>& choices) const;

 private:
  std::vector<double> numbers_;
  std::vector<Choice> known_;  // kYes: it has the number
};

// The columns of offers that do not change. Made when a property is asked for the second time, so
// that they cost nothing where every query sees other offers.
//
// Threads  any may ask.
class NumberColumns {
 public:
  // Null if the column does not exist (yet). `offers` are the same each time, until Clear().
  std::shared_ptr<const NumberColumn> Of(const Offers& offers, const std::string& property);
  // Call it while no query runs.
  void Clear() {
    const base::MutexLock lock(mutex_);
    columns_.clear();
  }

 private:
  base::Mutex mutex_;
  std::map<std::string, std::shared_ptr<const NumberColumn>> columns_
      GSV_GUARDED_BY(mutex_);  // null: asked for once
};

}  // namespace gsv::broker
