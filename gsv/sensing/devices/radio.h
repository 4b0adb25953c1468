// A radio: sends messages to other robots, and receives theirs.
//
// Time        a message that is sent at t is received with the next step, according to the
//             positions of all robots at t. Messages arrive in the order of their senders' names,
//             and those of one sender in the order of sending. A radio receives from the instant at
//             which it is opened.
// Reading     for each message that it keeps, the oldest first: its number (received messages are
//             counted from 1), the instant at which it was sent (s), and its strength (dBm). The
//             labels of a message are the sender and the content, in base64.
// Parameters  range (m; 0: as far as its power reaches), power (14.5 dBm), gain (2.5 dBi),
//             sensitivity (-90 dBm), path_loss_exponent (2), wall_loss (10 dB per wall). frequency
//             (2442 MHz) and essid ("") must be equal at both ends, as in SDFormat's <transceiver>.
//             inbox (16: number of messages that are kept), max_size (1024: bytes of a message).
//             For the receiver, all 0 by default: fading (dB: deviation of each message's
//             strength), loss_probability, and capture_ratio (dB: how much stronger than all other
//             robots' messages of the same step a message must be; 0: radios do not disturb each
//             other).
// Message     gsv_msgs/Radio
#pragma once

#include "gsv/sensing/registry.h"

namespace gsv::sensing {

SensorType RadioType();

}  // namespace gsv::sensing
