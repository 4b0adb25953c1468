// An incremental hash of bit patterns, equal on every x86-64 machine (XXH3, 64 bits).
//
// Add() takes only scalars and texts, so that padding and pointers cannot affect the hash.
#pragma once

#include <bit>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

struct XXH3_state_s;

namespace gsv::base {

// Adds values one after the other; Digest() returns the hash of all values so far.
class Hash {
 public:
  Hash();
  ~Hash();
  Hash(Hash&&) noexcept;
  Hash& operator=(Hash&&) noexcept;

  void Add(std::uint64_t value);
  void Add(std::int64_t value) { Add(static_cast<std::uint64_t>(value)); }
  void Add(double value) { Add(std::bit_cast<std::uint64_t>(value)); }
  // Adds the bytes and their number, so that "ab", "c" and "a", "bc" have different hashes.
  void Add(std::string_view bytes);

  // Returns the hash of all values so far.
  std::uint64_t Digest() const;
  // The hash as sixteen lower-case hexadecimal digits.
  std::string Hex() const;

 private:
  // The deleter of XXH3's state.
  struct Free {
    void operator()(XXH3_state_s* state) const;
  };
  std::unique_ptr<XXH3_state_s, Free> state_;  // null after a move
};

}  // namespace gsv::base
