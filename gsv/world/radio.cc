#include "gsv/world/radio.h"

#include <utility>

#include "gsv/base/hash.h"

namespace gsv::world {

RadioMessagePtr WithDigest(RadioMessage message) {
  base::Hash hash;
  for (const std::string* text :
       {&message.sender, &message.radio, &message.receiver, &message.content}) {
    hash.Add(std::string_view(*text));
  }
  hash.Add(static_cast<std::int64_t>(message.sent.count()));
  message.digest = hash.Digest();
  return std::make_shared<const RadioMessage>(std::move(message));
}

}  // namespace gsv::world
