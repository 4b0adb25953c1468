#include "gsv/base/hash.h"

#include <cstdio>

#include <xxhash.h>

namespace gsv::base {

Hash::Hash() : state_(XXH3_createState()) { XXH3_64bits_reset(state_.get()); }
Hash::~Hash() = default;
Hash::Hash(Hash&&) noexcept = default;
Hash& Hash::operator=(Hash&&) noexcept = default;

void Hash::Free::operator()(XXH3_state_s* state) const { XXH3_freeState(state); }

void Hash::Add(std::uint64_t value) { XXH3_64bits_update(state_.get(), &value, sizeof value); }

void Hash::Add(std::string_view bytes) {
  Add(static_cast<std::uint64_t>(bytes.size()));
  XXH3_64bits_update(state_.get(), bytes.data(), bytes.size());
}

std::uint64_t Hash::Digest() const { return XXH3_64bits_digest(state_.get()); }

std::string Hash::Hex() const {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(Digest()));
  return text;
}

}  // namespace gsv::base
