// For tests: random offers and correct constraints over the same few properties. The types of
// operands are often wrong, and properties are often missing.
#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <string>

#include "gsv/broker/language/property.h"

namespace gsv::broker {

class RandomConstraints {
 public:
  explicit RandomConstraints(std::uint64_t seed) : random_(seed) {}

  // Returns the properties of a random offer.
  PropertyList Offer() {
    PropertyList offer;
    for (const char* name : kNames) {
      if (Below(4) != 0) offer.Set({name, AnyValue()});
    }
    return offer;
  }

  // Returns an offer whose properties have the types of the properties of `model`. A property is
  // sometimes missing.
  PropertyList OfferLike(const PropertyList& model) {
    PropertyList offer;
    for (const auto& [name, value] : model) {
      Value other = AnyValue();
      while (!(other.Type() == value.Type())) other = AnyValue();
      if (Below(6) != 0) offer.Set({name, std::move(other)});
    }
    return offer;
  }

  // Returns a random constraint, which may be empty.
  std::string Constraint() { return Below(20) == 0 ? "" : Truth(4); }

 private:
  static constexpr std::array<const char*, 6> kNames = {"a", "b", "c", "d", "order", "in_1"};

  // Returns a random number from 0 to `bound` - 1.
  std::size_t Below(std::size_t bound) { return random_() % bound; }

  // Returns one of the choices.
  template <typename T, std::size_t kSize>
  T Pick(const std::array<T, kSize>& choices) {
    return choices[Below(kSize)];
  }

  // These functions return random parts of a constraint.
  std::string Space() { return Pick(std::array<const char*, 3>{" ", "  ", "\t"}); }
  std::string Name() { return Pick(kNames); }
  std::int64_t SmallInteger() { return static_cast<std::int64_t>(Below(7)) - 3; }
  std::string Letters() {
    return Pick(std::array<const char*, 6>{"", "x", "y", "xy", "xyx", "it's\\"});
  }

  Value AnyValue() {
    switch (Below(8)) {
      case 0:
        return Value::Boolean(Below(2) == 0);
      case 1:
        return Value::Double(static_cast<double>(SmallInteger()) / 2);
      case 2:
        return Value::String(Letters());
      case 3:
        return Value::Char('x');
      case 4:
        return Value::Strings({Letters(), Letters()});
      case 5:
        return Value::SequenceOf(Scalar::kLong, {SmallInteger(), SmallInteger()});
      case 6:
        return Value::Other({"any", ""});
      default:
        return Value::Long(static_cast<std::int32_t>(SmallInteger()));
    }
  }

  // Returns a random string literal.
  std::string Quoted() {
    std::string result = "'";
    for (const char c : Letters()) {
      if (c == '\'' || c == '\\') result += '\\';
      result += c;
    }
    return result + "'";
  }

  std::string NumberLiteral() {
    switch (Below(5)) {
      case 0:
        return Pick(std::array<const char*, 4>{"0.5", "1.", ".25e1", "15E-1"});
      case 1:
        return "-" + std::to_string(Below(4));
      case 2:
        return Pick(std::array<const char*, 3>{"9223372036854775807", "9007199254740993",
                                               "4611686018427387904"});
      default:
        return std::to_string(Below(4));
    }
  }

  // Returns a random term that is meant to be a number.
  std::string Numeric(int depth) {
    if (depth <= 0 || Below(3) == 0) return Below(2) == 0 ? Name() : NumberLiteral();
    const std::string sign = Pick(std::array<const char*, 4>{"+", "-", "*", "/"});
    const std::string plain = Numeric(depth - 1) + Space() + sign + Space() + Numeric(depth - 1);
    return Below(2) == 0 ? "(" + plain + ")" : plain;
  }

  // The type of an operand is sometimes wrong.
  std::string Operand(int depth) {
    switch (Below(5)) {
      case 0:
        return Quoted();
      case 1:
        return Name();
      case 2:
        return "(" + Truth(depth - 1) + ")";
      default:
        return Numeric(depth - 1);
    }
  }

  // Returns a random boolean term. `depth` limits the levels of nested terms.
  std::string Truth(int depth) {
    if (depth <= 0) {
      return Pick(std::array<std::string, 4>{"TRUE", "FALSE", "exist " + Name(), Name()});
    }
    switch (Below(8)) {
      case 0:
        return Truth(depth - 1) + Space() + "or" + Space() + Truth(depth - 1);
      case 1:
        return Truth(depth - 1) + Space() + "and" + Space() + Truth(depth - 1);
      case 2:
        return "not" + Space() + "(" + Truth(depth - 1) + ")";
      case 3:
        return "(" + Truth(depth - 1) + ")";
      case 4:
        return Quoted() + Space() + "~" + Space() + (Below(2) == 0 ? Quoted() : Name());
      case 5:
        return Numeric(1) + Space() + "in" + Space() + Name();
      default:
        break;
    }
    const std::string sign = Pick(std::array<const char*, 6>{"==", "!=", "<", "<=", ">", ">="});
    return Operand(depth) + Space() + sign + Space() + Operand(depth);
  }

  std::mt19937_64 random_;
};

}  // namespace gsv::broker
