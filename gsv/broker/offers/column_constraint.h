// Evaluates a constraint for many offers at once. Each property of the constraint has a column with
// the values of all offers, and each operator processes whole columns. For each offer, the result
// is the same as that of Matches().
//
// Threads  any thread may call const members.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "gsv/broker/language/expression.h"
#include "gsv/broker/offers/property_column.h"

namespace gsv::broker {

// The result of a constraint for an offer, as far as the columns determine it. The result of `and`
// is the smaller one of its operands' results.
enum class Choice : std::uint8_t {
  kNo,       // the constraint is FALSE or has no value
  kUnknown,  // the constraint must be evaluated for the offer
  kYes,      // the constraint is TRUE
};

class ColumnConstraint {
 public:
  using Columns = std::vector<std::shared_ptr<const PropertyColumn>>;

  // `constraint` must exist as long as this object.
  explicit ColumnConstraint(const Expression& constraint);

  // The names of the properties in the constraint. Each name occurs once.
  const std::vector<std::string>& properties() const { return properties_; }
  // Returns one choice per offer. `columns` are the columns of properties(), in the same order. A
  // column is null, or has one cell for each of `offers` offers. A term that uses the property of a
  // null column is unknown.
  std::vector<Choice> Choose(const Columns& columns, std::size_t offers) const;

 private:
  // A part of the constraint. All terms must be TRUE for the constraint to be TRUE.
  struct Term {
    std::size_t root = 0;                   // index of the term's last node
    std::vector<std::size_t> properties{};  // indices in properties_
  };

  // Adds the operands of the `and` at the node `root` as terms. An operand that is an `and` is
  // replaced by its own operands. If `root` is no `and`, adds `root` as the only term.
  void AddTerms(std::size_t root);
  // Adds the indices of the properties that are used at or below the node `root`.
  void AddProperties(std::size_t root, std::vector<std::size_t>& properties) const;

  const Expression& constraint_;
  std::vector<std::string> properties_;
  std::vector<std::size_t> column_of_node_;  // per node, the index of its property in properties_
  std::vector<Term> terms_;                  // the operands of `and` at the top level, in order
};

}  // namespace gsv::broker
