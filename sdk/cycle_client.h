// The client's side of the memory by which a behaviour's clock and a simulation on the same host
// exchange data, without remote calls (gsv/exchange/cycle_memory.h).
//
// Threads  Run() from the behaviour's thread, Interrupt() from any.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "gsv/exchange/cycle_memory.h"
#include "gsv/exchange/shared_file.h"
#include "sdk/behaviour/robot.h"

namespace gsv::sdk {

class CycleClient {
 public:
  // If the simulation has not answered a cycle after this wall-clock time, the caller repeats the
  // cycle by a remote call. The remote call fails if the simulation no longer exists.
  static constexpr std::chrono::milliseconds kLease{1000};

  // How a cycle has ended.
  enum class Outcome {
    kAnswered,
    kRepeat,         // repeat the cycle by a remote call
    kRepeatApplied,  // repeat the cycle by a remote call; its command has been applied
  };
  // The simulation's answer to a cycle.
  struct Answer {
    SimTime reached{0};       // simulated time at the end of the wait
    bool holds_time = false;  // whether simulated time stands still until the next wait
    std::vector<Reading> readings;
  };

  // Opens the memory. Fails if this process cannot reach it.
  static base::Result<std::unique_ptr<CycleClient>> Open(const exchange::FileAddress& file,
                                                         std::uint64_t offset, std::uint64_t key);

  // Runs a cycle and waits for its answer. For a cycle of sleep_and_read(), `sensors` are the names
  // of the sensors to read. `answer` is valid only if the outcome is kAnswered.
  Outcome Run(exchange::CycleRequest request, const std::vector<std::string>& sensors,
              Answer& answer);
  // Lets a waiting Run() return kRepeat or kRepeatApplied.
  void Interrupt();
  // Whether the simulation does not use the memory any more.
  bool is_closed() const { return exchange::StateOf(slot_.state) == exchange::CycleState::kClosed; }

 private:
  CycleClient(std::unique_ptr<exchange::Mapping> bell, std::unique_ptr<exchange::Mapping> slot);
  // Writes the request to the slot. Returns false if that is not possible now.
  bool Post(exchange::CycleRequest request, const std::vector<std::string>& sensors);
  // Waits until the simulation has answered. Gives up after kLease, or after twice this time if the
  // simulation has taken the request.
  exchange::CycleState Await();
  // Reads the answer from the slot. Returns false if it is invalid.
  bool Read(Answer& answer);

  const std::unique_ptr<exchange::Mapping> bell_memory_, slot_memory_;
  exchange::Bell& bell_;       // wakes the simulation
  exchange::CycleSlot& slot_;  // the memory of this clock
};

}  // namespace gsv::sdk
