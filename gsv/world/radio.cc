#include "gsv/world/radio.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace gsv::world {

RadioMessagePtr Sealed(RadioMessage message) {
  base::Hash hash;
  for (const std::string* text :
       {&message.sender, &message.radio, &message.receiver, &message.content}) {
    hash.Add(std::string_view(*text));
  }
  hash.Add(static_cast<std::int64_t>(message.sent.count()));
  message.digest = hash.Digest();
  return std::make_shared<const RadioMessage>(std::move(message));
}

const RadioState* FindRadio(const Radios* radios, const std::string& robot,
                            const std::string& sensor) {
  if (radios == nullptr) return nullptr;
  const auto at = std::lower_bound(radios->begin(), radios->end(), std::tie(robot, sensor),
                                   [](const RadioStatePtr& radio, const auto& wanted) {
                                     return std::tie(radio->robot, radio->sensor) < wanted;
                                   });
  const bool is_there = at != radios->end() && (*at)->robot == robot && (*at)->sensor == sensor;
  return is_there ? at->get() : nullptr;
}

void AddToHash(const Radios& radios, base::Hash& hash) {
  for (const RadioStatePtr& radio : radios) {
    hash.Add(std::string_view(radio->robot));
    hash.Add(std::string_view(radio->sensor));
    hash.Add(radio->heard);
    for (const HeardMessage& heard : radio->inbox) {
      hash.Add(heard.number);
      hash.Add(heard.strength);
      hash.Add(heard.message->digest);
    }
  }
}

}  // namespace gsv::world
