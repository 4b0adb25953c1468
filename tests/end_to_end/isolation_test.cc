// Several simulations run in one server. Events in one of them must not affect the others.
#include <algorithm>
#include <atomic>
#include <functional>
#include <iostream>
#include <thread>

#include <gmock/gmock.h>

#include "gsv/orb/orb.h"
#include "sdk/behaviour_servant.h"
#include "tests/end_to_end/fleet.h"
#include "tests/end_to_end/served.h"

namespace gsv::testing {
namespace {

constexpr double kSeconds = 2;  // time for 40 control cycles of each robot
constexpr int kFlooding = 12;   // number of robots whose behaviours never stop calling

// Calls `work` repeatedly on separate threads.
class Repeatedly {
 public:
  Repeatedly(int threads, const std::function<void()>& work) {
    for (int i = 0; i < threads; ++i) {
      threads_.emplace_back([this, work](const std::stop_token& stop) {
        for (; !stop.stop_requested(); ++count_) work();
      });
    }
  }
  int count() const { return count_; }

 private:
  std::atomic<int> count_ = 0;
  std::vector<std::jthread> threads_;
};

class Isolation : public Served {
 protected:
  static std::unique_ptr<Running> StartBad(const std::string& broker, const char* fault) {
    auto bad = std::make_unique<Running>(
        "../tests/bad_behaviour", std::vector<std::string>{"--broker", broker, "--fault", fault});
    bad->AwaitLine("offered at");
    return bad;
  }
  // Creates a real-time simulation whose robots' behaviours read their sonars as fast as they can.
  sba::Simulation_ptr Flood() {
    bad_ = StartBad(broker_.reference(), "flood");
    sba::Simulation_var flooded = service_->create_simulation(Playground(sba::REAL_TIME));
    for (int i = 0; i < kFlooding; ++i)
      AddPebble(flooded, 0.3 * (i - (kFlooding - 1) / 2.0), "bad");
    flooded->start();
    return flooded._retn();
  }
  // Expects that the program of the flood still runs, and that none of its behaviours has died or
  // finished.
  void ExpectFloodContinues(sba::Simulation_ptr flooded) {
    const sba::SimulationState_var state = flooded->state();
    EXPECT_EQ(CountOf(state.in(), sba::AGENT_DEAD) + CountOf(state.in(), sba::AGENT_FINISHED), 0);
    EXPECT_EQ(bad_->process().Ending(), "") << bad_->errors();
  }
  // Creates a simulation in lockstep at full speed.
  sba::Simulation_ptr Rush() {
    sba::Simulation_var rushing = service_->create_simulation(Playground(sba::LOCKSTEP));
    for (const double x : {-1.0, 0.0, 1.0}) AddPebble(rushing, x, "");
    rushing->start();
    return rushing._retn();
  }

  const Fleet fleet_{broker_.reference()};
  std::unique_ptr<Running> bad_;
};

// A simulation whose hash is compared with the hash of a run without other simulations.
class HashBesideAnotherSimulation : public Isolation {
 protected:
  HashBesideAnotherSimulation() {
    AddFleet(simulation_);
    expected_ = RunOnce();
  }
  std::string RunOnce() {
    RunTo(simulation_, kSeconds);
    const std::string hash = HashOf(simulation_);
    simulation_->reset();
    return hash;
  }
  // Repeats the run at least three times, and then until `holds` returns true.
  void ExpectUndisturbedUntil(const std::function<bool()>& holds) {
    const auto give_up = std::chrono::steady_clock::now() + kProgramTimeout;
    for (int run = 0; run < 3 * Rounds() || !holds(); ++run) {
      ASSERT_EQ(RunOnce(), expected_) << "run " << run;
      ASSERT_LT(std::chrono::steady_clock::now(), give_up) << "it never came to that";
    }
  }
  static std::function<bool()> Comes(sba::Simulation_ptr simulation, sba::AgentPhase phase) {
    return [simulation, phase] {
      return CountOf(sba::SimulationState_var(simulation->state()).in(), phase) > 0;
    };
  }

  const sba::Simulation_var simulation_ = service_->create_simulation(Playground(sba::LOCKSTEP));
  std::string expected_;
};

TEST_F(HashBesideAnotherSimulation, IsUnchangedIfABehaviourIsKilled) {
  ASSERT_EQ(expected_.size(), 16u);
  bad_ = StartBad(broker_.reference(), "die");
  sba::Simulation_var other = service_->create_simulation(Playground(sba::LOCKSTEP));
  AddPebble(other, -1, "bad");
  AddPebble(other, 1, "wander");
  other->start();
  ExpectUndisturbedUntil(Comes(other, sba::AGENT_DEAD));
  EXPECT_EQ(bad_->AwaitEnd().ending, "signal 9");
}

TEST_F(HashBesideAnotherSimulation, IsUnchangedIfABehaviourNeverWaits) {
  bad_ = StartBad(broker_.reference(), "never-wait");
  auto specification = Playground(sba::LOCKSTEP);
  SetOption(specification, "deadline_s", "1");
  sba::Simulation_var other = service_->create_simulation(specification);
  AddPebble(other, -1, "bad");
  AddPebble(other, 1, "wander");
  other->start();
  ExpectUndisturbedUntil(Comes(other, sba::AGENT_UNRESPONSIVE));
}

TEST_F(HashBesideAnotherSimulation, IsUnchangedInAFloodOfCalls) {
  const sba::Simulation_var flooded = Flood();
  const Repeatedly asking(4, [&] {
    const sba::SimulationState_var state = flooded->state();
    const sba::Simulations_var all = service_->list();
  });
  // The flood of calls must also continue once all behaviours have started. On a busy machine the
  // first behaviour may count as unresponsive by then, because it reads its sensors without ever
  // waiting.
  ExpectUndisturbedUntil([&] {
    const sba::SimulationState_var state = flooded->state();
    return asking.count() > 100 && CountOf(state.in(), sba::AGENT_INITIALISED) == 0;
  });
  ExpectFloodContinues(flooded);
}

TEST_F(HashBesideAnotherSimulation, IsUnchangedIfSimulationsAreDestroyedDuringAStep) {
  // The other simulations have behaviours of the same programs as the simulation whose hash is
  // compared.
  const Repeatedly destroying(2, [&] {
    sba::Simulation_var other = service_->create_simulation(Playground(sba::LOCKSTEP));
    AddPebble(other, -1, "wander");
    AddPebble(other, 0, "");
    AddPebble(other, 1, "follow-wall");
    other->start();
    AwaitState(other, [](const auto& state) { return state.step > 10; });
    other->destroy();
  });
  ExpectUndisturbedUntil([&] { return destroying.count() > 10; });
}

// A behaviour that repeatedly sleeps for 50 ms and measures how much wall-clock time that takes.
class Meter final : public Behaviour {
 public:
  explicit Meter(std::vector<double>& intervals) : intervals_(intervals) {}
  void Run(Robot& robot) override {
    using Clock = std::chrono::steady_clock;
    SimTime next = robot.Now();
    for (Clock::time_point then = Clock::now(); robot.SleepUntil(next += 50ms);) {
      const Clock::time_point now = Clock::now();
      intervals_.push_back(std::chrono::duration<double>(now - then).count());
      then = now;
    }
  }

 private:
  std::vector<double>& intervals_;  // in s
};

// A simulation in real time that runs while others cause disturbances. Its delays depend on the
// machine and are only printed. It must reach its end.
class StepTimeBesideAnotherSimulation : public Isolation {
 protected:
  void RunAndRecord(const char* beside) {
    const sba::Simulation_var simulation = service_->create_simulation(Playground(sba::REAL_TIME));
    AddFleet(simulation);
    AddMeter(simulation);
    const double seconds = kSeconds * Rounds();
    RunTo(simulation, seconds);
    const sba::SimulationState_var state = simulation->state();
    EXPECT_EQ(state->time_ns, static_cast<CORBA::LongLong>(seconds * 1e9));
    simulation->destroy();  // the run of the meter has ended
    ASSERT_GE(intervals_.size(), 2u);
    intervals_.erase(intervals_.begin());  // removes the interval of the start
    std::sort(intervals_.begin(), intervals_.end());
    double sum = 0;
    for (const double interval : intervals_) sum += interval;
    std::cout << "beside " << beside << ": " << state->late_steps << " of " << state->step
              << " steps late; 50 ms took " << 1e3 * sum / intervals_.size() << " ms on average, "
              << 1e3 * intervals_[intervals_.size() * 99 / 100] << " ms (99 %), "
              << 1e3 * intervals_.back() << " ms at most; " << state->real_time_factor
              << " x real time\n";
  }

 private:
  void AddMeter(sba::Simulation_ptr simulation) {
    const PortableServer::POA_var poa = orb::RootPoa(orb_);
    const PortableServer::Servant_var<sdk::BehaviourServant> servant(
        new sdk::BehaviourServant(poa, [this] { return std::make_unique<Meter>(intervals_); }));
    const PortableServer::ObjectId_var id = poa->activate_object(servant);
    const CORBA::Object_var reference = poa->id_to_reference(id);
    sba::RobotSpecification robot;
    robot.model = "pebble";
    robot.start = {0, 1.2, 0, 0, 0, 0};
    robot.behaviour = sba::AgentBehaviour::_narrow(reference);
    const CORBA::String_var name(simulation->add_robot(robot));
  }

  std::vector<double> intervals_;  // in s
};

TEST_F(StepTimeBesideAnotherSimulation, IsMeasuredAlone) { RunAndRecord("nothing"); }

TEST_F(StepTimeBesideAnotherSimulation, IsKeptBesideLockstepAtFullSpeed) {
  // There are so many simulations that no processor is idle.
  std::vector<sba::Simulation_var> rushing(std::thread::hardware_concurrency());
  for (sba::Simulation_var& each : rushing) each = Rush();
  RunAndRecord("lockstep at full speed");
  for (const sba::Simulation_var& each : rushing) {
    const sba::SimulationState_var state = each->state();
    EXPECT_EQ(state->phase, sba::PHASE_RUNNING);
    std::cout << "which went at " << state->real_time_factor << " x real time\n";
  }
}

TEST_F(StepTimeBesideAnotherSimulation, IsKeptBesideAFloodOfCalls) {
  const sba::Simulation_var flooded = Flood();
  const Repeatedly asking(4, [&] { const sba::SimulationState_var state = flooded->state(); });
  RunAndRecord("a flood of calls");
  ExpectFloodContinues(flooded);
  std::cout << "of which " << asking.count() << " asked for the state\n";
}

TEST_F(StepTimeBesideAnotherSimulation, IsKeptBesideABehaviourThatNeverWaits) {
  bad_ = StartBad(broker_.reference(), "never-wait");
  auto specification = Playground(sba::LOCKSTEP);
  SetOption(specification, "deadline_s", "1");
  const sba::Simulation_var other = service_->create_simulation(specification);
  AddPebble(other, -1, "bad");
  other->start();
  RunAndRecord("a behaviour that never waits");
}

TEST_F(StepTimeBesideAnotherSimulation, IsKeptWhileSimulationsAreDestroyed) {
  const Repeatedly destroying(2, [&] {
    sba::Simulation_var other = service_->create_simulation(Playground(sba::LOCKSTEP));
    AddPebble(other, 0, "wander");
    other->start();
    AwaitState(other, [](const auto& state) { return state.step > 10; });
    other->destroy();
  });
  RunAndRecord("simulations that are destroyed");
  std::cout << "of which there were " << destroying.count() << "\n";
}

}  // namespace
}  // namespace gsv::testing
