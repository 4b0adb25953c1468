#include "gsv/sensing/devices/radio.h"

#include "gsv/base/base64.h"
#include "gsv/messages/gsv_msgs.h"
#include "gsv/sensing/device.h"
#include "gsv/sensing/devices/radio_state.h"
#include "gsv/sensing/sensor_type.h"

namespace gsv::sensing {
namespace {

constexpr std::size_t kValuesOfMessage = 3;  // of one message
constexpr double kHertzAMegahertz = 1e6;
constexpr std::size_t kLongestName = 128;

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

class Radio final : public Device {
 public:
  Radio(const model::SensorDescription& description, ParameterReader& reader)
      : Device(description), setup_(ReadSetup(reader)) {}

  bool IsOnWhileOpen() const override { return true; }
  bool SendsMessages() const override { return true; }

  base::Status Check(const world::DeviceCommand& message) const override {
    if (message.content.size() > setup_->max_size) {
      return Refuse("a message of " + std::to_string(message.content.size()) +
                    " bytes is longer than the radio's max_size, " +
                    std::to_string(setup_->max_size));
    }
    if (message.word.size() > kLongestName) {
      return Refuse("a robot's name has at most 128 characters");
    }
    return {};
  }

  world::DeviceStatePtr SwitchedOn(const std::string& robot) const override {
    return std::make_shared<const RadioState>(MountOn(robot), setup_);
  }

  // A radio that is not on sends as well.
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
        {world::Sealed(std::move(message)), AntennaOf(*step.now, MountOn(robot), setup_), {}});
    return before;
  }

  base::Result<Reading> Sample(const Sampling& sampling) const override {
    Reading reading = sampling.Stamped();
    auto labels = std::make_shared<std::vector<std::string>>();
    const auto* const radio = dynamic_cast<const RadioState*>(StateIn(sampling));
    for (std::size_t i = 0; radio != nullptr && i < radio->inbox().size(); ++i) {
      const auto& [message, number, strength] = radio->inbox()[i];
      reading.values.push_back(static_cast<double>(number));
      reading.values.push_back(base::ToSeconds(message->sent));
      reading.values.push_back(strength);
      labels->push_back(message->sender);
      labels->push_back(base::ToBase64(message->content));
    }
    reading.labels = std::move(labels);
    return reading;
  }

  static messages::gsv_msgs::Radio ToMessage(const model::SensorDescription&,
                                             const Reading& reading, const std::string&) {
    messages::gsv_msgs::Radio message;
    const std::size_t count = reading.values.size() / kValuesOfMessage;
    for (std::size_t i = 0; i < count; ++i) {
      const double* const v = &reading.values[kValuesOfMessage * i];
      messages::gsv_msgs::RadioMessage heard;
      heard.number = static_cast<std::uint64_t>(v[0]);
      heard.sender = (*reading.labels)[2 * i];
      heard.sent = messages::ToMessage(base::FromSeconds(v[1]));
      heard.strength_dbm = v[2];
      const auto content = base::FromBase64((*reading.labels)[2 * i + 1]);
      if (content) heard.content.assign(content->begin(), content->end());
      message.messages.push_back(std::move(heard));
    }
    return message;
  }

 private:
  const world::RadioSetupPtr setup_;
};

}  // namespace

SensorType RadioType() {
  return MakeSensorType<Radio, messages::gsv_msgs::Radio>(
      "radio",
      {"transceiver", "wireless_transceiver", "wireless_transmitter", "wireless_receiver"});
}

}  // namespace gsv::sensing
