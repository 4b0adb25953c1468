#include "gsv/sensing/devices/radio.h"

#include "gsv/base/base64.h"
#include "gsv/messages/gsv_msgs.h"
#include "gsv/sensing/device.h"
#include "gsv/sensing/devices/radio_state.h"
#include "gsv/sensing/sensor_type.h"

namespace gsv::sensing {
namespace {

constexpr double kHertzAMegahertz = 1e6;
constexpr std::size_t kMaxNameLength = 128;

world::RadioSetupPtr ReadSetup(ParameterReader& reader) {
  const world::RadioSetup usual;
  auto setup = std::make_shared<world::RadioSetup>();
  setup->network = reader.Text("essid", "");
  setup->frequency =
      kHertzAMegahertz * reader.Number("frequency", usual.frequency / kHertzAMegahertz, 1e-3, 1e6);
  setup->power = reader.Number("power", usual.power, -200, 200);
  setup->gain = reader.Number("gain", usual.gain, -100, 100);
  setup->sensitivity = reader.Number("sensitivity", usual.sensitivity, -300, 200);
  setup->range = reader.Number("range", usual.range, 0, 1e7);
  setup->path_loss_exponent = reader.Number("path_loss_exponent", usual.path_loss_exponent, 0, 20);
  setup->wall_loss = reader.Number("wall_loss", usual.wall_loss, 0, 1e3);
  setup->inbox =
      static_cast<std::size_t>(reader.Count("inbox", static_cast<int>(usual.inbox), 1, 256));
  setup->max_size =
      static_cast<std::size_t>(reader.Count("max_size", static_cast<int>(usual.max_size), 1, 4096));
  return setup;
}

RadioErrors ReadErrors(ParameterReader& reader) {
  RadioErrors errors;
  errors.fading = reader.Number("fading", 0, 0, 100);
  errors.loss_probability = reader.Number("loss_probability", 0, 0, 1);
  errors.capture_ratio = reader.Number("capture_ratio", 0, 0, 100);
  return errors;
}

class Radio final : public SensorOf<readings::Radio, messages::gsv_msgs::Radio, Device> {
 public:
  Radio(const model::SensorDescription& description, ParameterReader& reader)
      : SensorOf(description), setup_(ReadSetup(reader)), errors_(ReadErrors(reader)) {}

  bool IsOnWhileOpen() const override { return true; }
  bool SendsMessages() const override { return true; }

  base::Status Check(const world::DeviceCommand& message) const override {
    if (message.content.size() > setup_->max_size) {
      return Refuse("a message of " + std::to_string(message.content.size()) +
                    " bytes is longer than the radio's max_size, " +
                    std::to_string(setup_->max_size));
    }
    if (message.word.size() > kMaxNameLength) {
      return Refuse("the receiver's name has " + std::to_string(message.word.size()) +
                    " characters; at most " + std::to_string(kMaxNameLength) + " are allowed");
    }
    return {};
  }

  world::DeviceStatePtr SwitchedOn(const std::string& robot) const override {
    return std::make_shared<const RadioState>(MountOn(robot), setup_, errors_);
  }

  // A radio that is not open can send as well.
  world::DeviceStatePtr Apply(const std::string& robot, const world::DeviceStatePtr& before,
                              const world::DeviceCommand& command,
                              world::DeviceStep& step) const override {
    world::RadioMessage message;
    message.sender = robot;
    message.radio = description().name;
    message.receiver = command.word;
    message.sent = step.now->state.time;
    message.content = command.content;
    step.transmissions.push_back(
        {world::WithDigest(std::move(message)), AntennaOf(*step.now, MountOn(robot), setup_), {}});
    return before;
  }

  base::Result<Reading> Sample(const Sampling& sampling) const override {
    Values heard;
    const auto* const radio = dynamic_cast<const RadioState*>(StateIn(sampling));
    for (std::size_t i = 0; radio != nullptr && i < radio->inbox().size(); ++i) {
      const auto& [message, number, strength] = radio->inbox()[i];
      heard.messages.push_back({.number = number,
                                .sent = base::ToSeconds(message->sent),
                                .strength = strength,
                                .sender = message->sender,
                                .content_base64 = base::ToBase64(message->content)});
    }
    Reading reading = sampling.Stamped();
    Fill(heard, reading);
    return reading;
  }

 private:
  Message ToMessage(const Values& heard, const Reading&, const std::string&) const override {
    Message message;
    for (const readings::HeardMessage& each : heard.messages) {
      messages::gsv_msgs::RadioMessage sent;
      sent.number = each.number;
      sent.sender = each.sender;
      sent.sent = messages::ToMessage(base::FromSeconds(each.sent));
      sent.strength_dbm = each.strength;
      const auto content = base::FromBase64(each.content_base64);
      if (content) sent.content.assign(content->begin(), content->end());
      message.messages.push_back(std::move(sent));
    }
    return message;
  }

  const world::RadioSetupPtr setup_;
  const RadioErrors errors_;
};

}  // namespace

SensorType RadioType() {
  return MakeSensorType<Radio>(
      readings::Radio::kType,
      {"transceiver", "wireless_transceiver", "wireless_transmitter", "wireless_receiver"});
}

}  // namespace gsv::sensing
