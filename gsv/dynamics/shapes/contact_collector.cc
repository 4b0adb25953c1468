#include "gsv/dynamics/shapes/contact_collector.h"

#include <algorithm>
#include <tuple>

namespace gsv::dynamics {

ContactCollector::ContactCollector(std::vector<world::Contact>& contacts, double gap)
    : contacts_(contacts), gap_(gap) {
  contacts_.clear();
}

void ContactCollector::Offer(const BodyPair& bodies, const Separation& separation, double height) {
  if (separation.distance > gap_) return;
  const world::Contact contact{bodies.first,
                               bodies.second,
                               {separation.point.x, separation.point.y, height},
                               {separation.normal.x, separation.normal.y, 0},
                               -separation.distance,
                               false};
  for (std::size_t i = contacts_.size(); i-- > 0 && contacts_[i].first == bodies.first;) {
    if (contacts_[i].second != bodies.second) continue;
    if (contact.depth > contacts_[i].depth) contacts_[i] = contact;
    return;
  }
  contacts_.push_back(contact);
}

void ContactCollector::Finish(const std::vector<BodyPair>& touching) {
  std::sort(contacts_.begin(), contacts_.end(),
            [](const world::Contact& a, const world::Contact& b) {
              return std::tie(a.first, a.second) < std::tie(b.first, b.second);
            });
  for (world::Contact& contact : contacts_) {
    contact.depth = std::max(contact.depth, 0.0);
    contact.began = !std::binary_search(touching.begin(), touching.end(),
                                        BodyPair{contact.first, contact.second});
  }
}

}  // namespace gsv::dynamics
