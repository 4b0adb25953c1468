#include "gsv/gateway/live/step_event_topic.h"

#include "gsv/presentation/state_messages.h"

namespace gsv::gateway {

void CollectContacts(const world::Snapshot& snapshot,
                     std::vector<messages::gsv_msgs::Contact>& found) {
  for (const world::Contact& contact : snapshot.contacts) {
    if (contact.began && !contact.supports)
      found.push_back(presentation::ContactMessage(snapshot, contact));
  }
}

void CollectTransmissions(const world::Snapshot& snapshot,
                          std::vector<messages::gsv_msgs::Transmission>& found) {
  for (const world::Transmission& transmission : snapshot.transmissions) {
    found.push_back(presentation::TransmissionMessage(snapshot, transmission));
  }
}

}  // namespace gsv::gateway
