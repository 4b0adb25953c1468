// A radio: sends messages to other robots, and receives messages from them.
//
// Time        a message that is sent at t is received with the next step, according to the
//             positions of all robots at t. Messages arrive in the order of their senders' names.
//             Messages of one sender arrive in the order of sending. A radio receives messages
//             after it is opened.
// Reading     for each message in the inbox, the oldest first: the values {number (received
//             messages are counted from 1), instant of sending (s), strength (dBm)}. The labels of
//             a message are the sender and the content, in base64.
// Parameters  (with their default values)
//   range (0 m)             maximum range of sending; 0: limited by the power only
//   power (14.5 dBm), gain (2.5 dBi), sensitivity (-90 dBm)
//   path_loss_exponent (2), wall_loss (10 dB per wall)
//   frequency (2442 MHz), essid ("")   as in SDFormat's <transceiver>; must be equal for
//                           sender and receiver
//   inbox (16)              number of received messages that are kept
//   max_size (1024)         maximum size of a message in bytes
//   fading (0 dB)           standard deviation of a received message's strength
//   loss_probability (0)    probability that a message is lost
//   capture_ratio (0 dB)    by how much a message must be stronger than the sum of all other
//                           robots' messages in the same step; 0: radios do not disturb each other
// Message     gsv_msgs/Radio
#pragma once

#include "gsv/sensing/registry.h"

namespace gsv::sensing {

SensorType RadioType();

}  // namespace gsv::sensing
