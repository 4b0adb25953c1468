// An immutable value that many objects share, such as a service type or a property name of offers.
// Equal values are stored once. An Interned has the size of a pointer. The stored value is deleted
// with its last user.
//
// Threads  safe. Creating an object from a value takes a lock; copying does not.
#pragma once

#include <utility>

#include <boost/flyweight.hpp>

namespace gsv::broker {

template <typename T>
class Interned {
 public:
  Interned() = default;                            // a default-constructed value
  Interned(T value) : value_(std::move(value)) {}  // NOLINT(google-explicit-constructor): is a T

  const T& operator*() const { return value_.get(); }
  const T* operator->() const { return &value_.get(); }
  operator const T&() const { return value_.get(); }  // NOLINT(google-explicit-constructor)

  // Compares the addresses, because equal values are stored once.
  friend bool operator==(const Interned& a, const Interned& b) {
    return &a.value_.get() == &b.value_.get();
  }

 private:
  boost::flyweight<T> value_;
};

}  // namespace gsv::broker
