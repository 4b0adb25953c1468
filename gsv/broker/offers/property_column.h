// The values of many offers for one property, in arrays. A scan over the arrays does not access the
// offers.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gsv/base/mutex.h"
#include "gsv/broker/language/offer.h"
#include "gsv/broker/language/operand.h"

namespace gsv::broker {

// The content of a column for one offer.
enum class CellKind : std::uint8_t {
  kNone,  // the offer has no such property
  kBoolean,
  kInteger,
  kReal,
  kText,
  kSequence,
  kOther,  // a value of any other type
  kOffer,  // not in the column: the property is dynamic, or the offer is a proxy
};

class PropertyColumn {
 public:
  // The column is valid as long as `offers`.
  PropertyColumn(const Offers& offers, std::string_view property);

  std::span<const CellKind> kinds() const { return kinds_; }
  // Whether a cell has this kind.
  bool Has(CellKind kind) const { return (present_ & BitOf(kind)) != 0; }
  // The kind of all cells that are neither kNone nor kOffer, or nullopt if their kinds differ. The
  // kind is kNone if there are no such cells.
  std::optional<CellKind> sole_kind() const;
  // The contents of the cells. A cell's kind determines its content: 0 or 1 for a boolean, an
  // integer, the bits of a real number, the index of a text in texts(), or the place of a sequence
  // for ContainsAt(). The content is 0 for all other kinds.
  std::span<const std::uint64_t> bits() const { return bits_; }
  // The different texts of the column.
  std::span<const std::string_view> texts() const { return texts_; }

  // Returns the value of a cell as an operand of the constraint language.
  Operand At(std::size_t index) const { return ToOperand(kinds_[index], bits_[index]); }
  // Whether the sequence of the cell contains `element`, see Contains(). If `element` is a text,
  // `element_text` is its index in texts(), as IndexOf() returns it.
  Operand ContainsAt(std::size_t index, const Operand& element,
                     std::optional<std::size_t> element_text) const;
  // The index of the text in texts(), or texts().size() if no cell has it.
  std::size_t IndexOf(std::string_view text) const;

 private:
  class Builder;

  static constexpr unsigned BitOf(CellKind kind) { return 1u << static_cast<unsigned>(kind); }
  Operand ToOperand(CellKind kind, std::uint64_t bits) const;

  std::vector<CellKind> kinds_;      // kind of each cell
  unsigned present_ = 0;             // the kinds of all cells, one bit for each kind
  std::vector<std::uint64_t> bits_;  // value of each cell, see bits()
  // The elements of all sequences, one sequence after the other.
  std::vector<CellKind> element_kinds_;
  std::vector<std::uint64_t> element_bits_;
  std::string short_texts_;              // characters of short texts; long texts stay in the offers
  std::vector<std::string_view> texts_;  // see texts()
};

// The property columns of a list of offers that does not change. A column is made at the second
// request for its property, so a list that is queried only once needs none.
//
// Threads  any thread may call Of() and ArePlain().
class PropertyColumns {
 public:
  // Returns the column of a property, or null if it does not exist (yet). `offers` must be the same
  // in every call until Clear().
  std::shared_ptr<const PropertyColumn> Of(const Offers& offers, const std::string& property);
  // Whether none of the offers is a proxy or has a dynamic property.
  bool ArePlain(const Offers& offers);
  // Removes all columns. Call it while no query runs.
  void Clear();

 private:
  base::Mutex mutex_;
  std::map<std::string, std::shared_ptr<const PropertyColumn>> columns_
      GSV_GUARDED_BY(mutex_);  // null after the first request for the property
  std::optional<bool> plain_ GSV_GUARDED_BY(mutex_);  // the result of ArePlain(), once computed
};

}  // namespace gsv::broker
