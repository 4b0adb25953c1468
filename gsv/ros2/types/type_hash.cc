#include "gsv/ros2/types/type_hash.h"

#include <algorithm>
#include <array>
#include <map>

#include <openssl/evp.h>

#include "gsv/base/check.h"
#include "gsv/messages/all.h"

namespace gsv::ros2 {
namespace {

constexpr std::string_view kPrefix = "RIHS01_";
constexpr std::string_view kKey = "typehash=";
constexpr std::string_view kRequest = "_Request", kResponse = "_Response";
constexpr std::size_t kDigits = 64;

const messages::Schema* FindSchema(std::string_view name) {
  const auto& schemas = messages::AllSchemas();
  const auto found = std::lower_bound(
      schemas.begin(), schemas.end(), name,
      [](const messages::Schema& schema, std::string_view wanted) { return schema.name < wanted; });
  return found != schemas.end() && found->name == name ? &*found : nullptr;
}

// The definitions in GSV are always valid, so `description` is no error.
std::string HashOf(const base::Result<TypeDescription>& description) {
  GSV_CHECK(description.has_value());
  return TypeHash(*description);
}

std::map<std::string, std::string, std::less<>> AllHashes() {
  std::map<std::string, std::string, std::less<>> hashes;
  for (const messages::Schema& schema : messages::AllSchemas()) {
    hashes.emplace(schema.name, HashOf(DescribeType(schema)));
    if (!schema.name.ends_with(kRequest)) continue;
    const std::string service(schema.name.substr(0, schema.name.size() - kRequest.size()));
    const messages::Schema* response = FindSchema(service + std::string(kResponse));
    GSV_CHECK(response != nullptr);
    hashes.emplace(service, HashOf(DescribeService(service, schema, *response)));
  }
  return hashes;
}

bool IsHexadecimal(char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); }

}  // namespace

std::string TypeHash(const TypeDescription& description) {
  const std::string json = CanonicalJson(description);
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int size = 0;
  GSV_CHECK(EVP_Digest(json.data(), json.size(), digest.data(), &size, EVP_sha256(), nullptr) == 1);
  GSV_CHECK(size * 2 == kDigits);
  constexpr std::string_view kHex = "0123456789abcdef";
  std::string hash(kPrefix);
  for (std::size_t i = 0; i < size; ++i) {
    hash += kHex[digest[i] >> 4];
    hash += kHex[digest[i] & 15];
  }
  return hash;
}

std::string TypeHashOf(std::string_view type) {
  static const auto kHashes = AllHashes();
  const auto found = kHashes.find(type);
  return found == kHashes.end() ? std::string() : found->second;
}

std::string TypeHashUserData(std::string_view type) {
  for (const std::string_view half : {kRequest, kResponse}) {
    const bool is_service = type.find("/srv/") != std::string_view::npos ||
                            type.find("/action/") != std::string_view::npos;
    if (is_service && type.ends_with(half)) {
      type.remove_suffix(half.size());
      break;
    }
  }
  const std::string hash = TypeHashOf(type);
  return hash.empty() ? std::string() : std::string(kKey) + hash + ";";
}

std::string_view TypeHashIn(std::string_view user_data) {
  const std::size_t key = user_data.find(kKey);
  if (key == std::string_view::npos) return {};
  const std::string_view hash =
      user_data.substr(key + kKey.size()).substr(0, kPrefix.size() + kDigits);
  const bool is_hash = hash.size() == kPrefix.size() + kDigits && hash.starts_with(kPrefix) &&
                       std::all_of(hash.begin() + kPrefix.size(), hash.end(), IsHexadecimal);
  return is_hash ? hash : std::string_view();
}

}  // namespace gsv::ros2
