// A radio: sends messages to other robots, and hears theirs.
//
// Time        A message that is sent at t is heard with the next step, by the places of all robots
//             at t. Messages arrive in the order of their senders' names, then in that in which
//             each was sent. A radio hears from when it was opened.
// Reading     for each message that it keeps, the oldest first: its number (what this radio has
//             heard is counted from 1), the instant it was sent at (s), its strength (dBm). Labels:
//             for each the sender and the content, in base64.
// Parameters  range (m; 0: as far as its power reaches), power (14.5 dBm), gain (2.5 dBi),
//             sensitivity (-90 dBm), frequency (2442 MHz) and essid (""), which both must share, as
//             SDFormat's <transceiver> has them; path_loss_exponent (2), wall_loss (10 dB for each
//             wall); inbox (16: messages that are kept), max_size (1024: bytes of a message).
//             Of the receiver, all 0: fading (dB: deviation of each message's strength),
//             loss_probability, and capture_ratio (dB: how much stronger than all other robots'
//             messages of the same step a message must arrive; 0: radios do not disturb each other).
// Message     gsv_msgs/Radio
#pragma once

#include "gsv/sensing/registry.h"

namespace gsv::sensing {

SensorType RadioType();

}  // namespace gsv::sensing
