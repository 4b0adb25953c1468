// For tests: a behaviour that switches a lamp, plays sounds and listens. It drives according to the
// sounds that it hears, and fails if it never hears a sound.
#include <stdexcept>

#include "sdk/behaviour/module.h"

namespace {

using namespace gsv;

class Signalling final : public Behaviour {
 public:
  base::Status Init(Robot& robot) override {
    auto lamp = robot.Open<Lamp>("lamp");
    if (!lamp) return base::Fail(lamp.error());
    auto speaker = robot.Open<Speaker>("speaker");
    if (!speaker) return base::Fail(speaker.error());
    auto ear = robot.Create<Microphone>("ear", {0, 0, 0.3});
    if (!ear) return base::Fail(ear.error());
    lamp_ = *std::move(lamp), speaker_ = *std::move(speaker), ear_ = *std::move(ear);
    return {};
  }
  void Run(Robot& robot) override {
    const double own = 400.0 + 100 * static_cast<double>(robot.name().size() % 7);
    bool heard = false;
    for (int cycle = 0; robot.IsRunning(); ++cycle) {
      const Microphone::Hearing hearing = ear_->Listen();
      heard = heard || !hearing.source.empty();
      if (robot.Now() >= 1s && !heard) throw std::runtime_error("it hears nobody");
      Expect(lamp_->Set({1, 0, static_cast<double>(cycle % 2)}, hearing.level > 60 ? 1 : 0.5));
      if (cycle % 5 == 0) Expect(speaker_->Beep(own, 0.12));
      robot.Drive(0.005 * hearing.level, 0.001 * hearing.frequency);
      robot.SleepFor(50ms);
    }
  }

 private:
  static void Expect(const base::Status& done) {
    if (!done && done.error().code != base::ErrorCode::kEnded) {
      throw std::runtime_error(done.error().Sentence());
    }
  }

  std::unique_ptr<Lamp> lamp_;
  std::unique_ptr<Speaker> speaker_;
  std::unique_ptr<Microphone> ear_;
};

}  // namespace

GSV_BEHAVIOUR("signalling", "Blinks, beeps and listens.", Signalling)
