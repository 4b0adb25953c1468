// An immutable value that many objects share, such as a service type or a property name of offers.
// Equal values are stored once. An Interned has the size of a pointer. The stored value is deleted
// with its last user.
//
// T is std::string or std::vector<std::string> (interned.cc).
//
// Threads  safe. Creating an object from a value and deleting a value's last user take a lock;
//          copying does not.
#pragma once

#include <atomic>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace gsv::broker {

template <typename T>
class Interned {
 public:
  Interned() = default;  // a default-constructed value
  Interned(T value);     // NOLINT(google-explicit-constructor): is a T
  Interned(const Interned& other) : stored_(other.stored_) {
    if (stored_ != nullptr) stored_->second.fetch_add(1, std::memory_order_relaxed);
  }
  Interned(Interned&& other) noexcept : stored_(std::exchange(other.stored_, nullptr)) {}
  Interned& operator=(Interned other) noexcept {
    std::swap(stored_, other.stored_);
    return *this;
  }
  ~Interned() {
    if (stored_ != nullptr) Release();
  }

  const T& operator*() const { return stored_ != nullptr ? stored_->first : kDefault; }
  const T* operator->() const { return &**this; }
  operator const T&() const { return **this; }  // NOLINT(google-explicit-constructor): is a T

  // Compares the addresses, because equal values are stored once.
  friend bool operator==(const Interned& a, const Interned& b) { return a.stored_ == b.stored_; }

  // The number of different values that are stored now.
  static std::size_t Count();

 private:
  // A value, and the number of its users. Only a thread that holds the lock makes the number 0, and
  // then deletes the value. So a value that is found is never about to be deleted.
  using Stored = std::pair<const T, std::atomic<std::size_t>>;
  struct Pool;
  static Pool& ThePool();
  static const T kDefault;

  void Release();

  Stored* stored_ = nullptr;  // null stands for a default-constructed value
};

extern template class Interned<std::string>;
extern template class Interned<std::vector<std::string>>;

}  // namespace gsv::broker
