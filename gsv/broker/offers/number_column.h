// The numbers of many offers for one property, in one array. A scan over the array does not access
// the offers.
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

// Returns the integer as a double, or nullopt if a double cannot hold it exactly.
std::optional<double> ExactNumber(std::int64_t integer);

// The state of an offer after some terms were evaluated.
enum class Choice : std::uint8_t {
  kNo,       // one of the terms is FALSE or has no value
  kYes,      // all terms are TRUE
  kUnknown,  // the expression must be evaluated for the offer
};

class NumberColumn {
 public:
  NumberColumn(const Offers& offers, const std::string& property);

  // Returns the number by which min and max order the offer at `index`, or NaN if it has none.
  // Returns nullopt if the number must be read from the offer.
  std::optional<double> At(std::size_t index) const;
  // Narrows `choices`, which has one element per offer, to the offers for which `term` is TRUE.
  void Narrow(const NumberTerm& term, std::vector<Choice>& choices) const;

 private:
  std::vector<double> numbers_;
  std::vector<Choice> known_;  // kYes if the column has the offer's number
};

// The columns of offers that do not change. A column is made at the second request for its
// property. So columns cost nothing if every query has other offers.
//
// Threads  any thread may call Of().
class NumberColumns {
 public:
  // Returns null if the column does not exist (yet). `offers` must be the same in every call until
  // Clear().
  std::shared_ptr<const NumberColumn> Of(const Offers& offers, const std::string& property);
  // Removes all columns. Call it while no query runs.
  void Clear() {
    const base::MutexLock lock(mutex_);
    columns_.clear();
  }

 private:
  base::Mutex mutex_;
  std::map<std::string, std::shared_ptr<const NumberColumn>> columns_
      GSV_GUARDED_BY(mutex_);  // null after the first request for the property
};

}  // namespace gsv::broker
