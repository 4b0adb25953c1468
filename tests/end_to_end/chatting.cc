// For tests: a behaviour that communicates by radio. It sends the number of messages that it
// received, and drives accordingly. It fails if it never receives a message.
#include <stdexcept>

#include <CLI/CLI.hpp>

#include "sdk/behaviour/module.h"

namespace {

using namespace gsv;

class Chatting final : public Behaviour {
 public:
  base::Status Init(Robot& robot) override {
    auto radio = robot.OpenRadio("radio");
    if (!radio) return base::Fail(radio.error());
    radio_ = *std::move(radio);
    return {};
  }
  void Run(Robot& robot) override {
    std::size_t heard = 0;
    do {
      for (const Radio::Message& message : radio_->Receive()) {
        heard += message.content.size();
      }
      if (const auto sent = radio_->Broadcast(robot.name() + " " + std::to_string(heard)); !sent) {
        throw std::runtime_error(sent.error().Sentence());
      }
      robot.Drive(0.05 * static_cast<double>(heard % 7), 0.2);
      if (robot.Now() >= 1s && heard == 0) throw std::runtime_error("it hears nobody");
    } while (robot.SleepFor(50ms));
  }

 private:
  std::unique_ptr<Radio> radio_;
};

}  // namespace

GSV_BEHAVIOUR("chatting", "Talks by radio.", Chatting)
