// The simulation's side of a slot in shared memory (gsv/exchange/cycle_memory.h). Each slot belongs
// to one clock of a robot. In each control cycle, the behaviour that uses this clock writes a
// command and the next instant to the slot, and the simulation answers with the readings.
//
// Threads  Take(), SetDue() and Close() with the simulation's mutex held. Open() from any thread.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gsv/base/mutex.h"
#include "gsv/base/sim_time.h"
#include "gsv/exchange/content.h"
#include "gsv/exchange/cycle_memory.h"
#include "gsv/exchange/shared_file.h"
#include "gsv/simulation/agent.h"
#include "gsv/simulation/robots/wait_event.h"

namespace gsv::simulation {

class RobotAgent;

class CycleChannel final : public Wakeable {
 public:
  // A control cycle that the client has requested.
  struct Request {
    exchange::CycleRequest cycle;      // the command, and the instant to wait for
    std::vector<std::string> sensors;  // names, for a cycle of sleep_and_read()
  };
  // How a cycle is answered.
  enum class Readings {
    kWritten,
    kByCall,        // the client repeats this cycle by a call, which reports the error
    kAlwaysByCall,  // the client makes all cycles by calls
  };

  CycleChannel(std::unique_ptr<exchange::Mapping> memory, ClockId clock,
               std::weak_ptr<RobotAgent> agent);
  ~CycleChannel() override { Close(); }

  ClockId clock() const { return clock_; }
  // Whether a client has opened the slot.
  bool is_used() const { return exchange::StateOf(slot_.state) != exchange::CycleState::kNew; }
  bool is_closed() const { return exchange::StateOf(slot_.state) == exchange::CycleState::kClosed; }
  // Whether a client waits for the answer to a request that Take() has returned.
  bool is_waiting() const { return exchange::StateOf(slot_.state) == exchange::CycleState::kTaken; }

  // Returns and removes the client's request, if there is one. Then call Accept() or Refuse().
  std::optional<Request> Take();
  // Accepts the request. Call this when its command has been applied and its wait has begun.
  void Accept(Request request);
  // Refuses the request. The client then repeats the cycle by a call.
  void Refuse();
  // Reports that the wait of the request is over. The next Open() writes the answer.
  void SetDue(base::SimTime reached, bool holds_time);
  // Reads the sensors and answers the client.
  void Open() override;
  // Closes the channel. From now on, the client uses calls.
  void Close();

 private:
  // The answer to a request whose wait is over.
  struct Due {
    std::uint32_t state = 0;  // the slot's state at SetDue()
    exchange::CycleAnswer answer;
  };
  // Changes the state of the slot and wakes the client. If the client has already changed the
  // state, does nothing.
  void Change(std::uint32_t from, exchange::CycleState to);

  const std::unique_ptr<exchange::Mapping> memory_;  // the part of the file with the slot
  exchange::CycleSlot& slot_;                        // in memory_
  const ClockId clock_;
  const std::weak_ptr<RobotAgent> agent_;
  base::Mutex mutex_;
  Request request_ GSV_GUARDED_BY(mutex_);         // the accepted request
  std::optional<Due> due_ GSV_GUARDED_BY(mutex_);  // set from SetDue() to Open()
};

// All channels of a simulation, and their memory. The memory is created with the first channel.
//
// Threads  with the simulation's mutex held.
class CycleChannels {
 public:
  // A channel and the agent whose clock uses it.
  struct Channel {
    std::shared_ptr<CycleChannel> channel;
    RobotAgent* agent = nullptr;
  };

  // Creates the memory if it does not exist yet.
  base::Status Prepare();
  // The bell, by which the clients of all channels wake the stepping thread; null before Prepare().
  exchange::Bell* bell() const {
    return bell_ != nullptr ? static_cast<exchange::Bell*>(bell_->data()) : nullptr;
  }
  // A new channel, and where a client finds its memory.
  struct Added {
    std::shared_ptr<CycleChannel> channel;
    CycleMemory memory;
  };
  // Adds a channel for a clock of the agent.
  base::Result<Added> Add(RobotAgent& agent, std::weak_ptr<RobotAgent> shared, ClockId clock);
  // Closes the channel of a clock, if it has one.
  void Close(const RobotAgent& agent, ClockId clock);
  // Closes all channels of an agent.
  void Close(const RobotAgent& agent);
  void CloseAll();

  const std::vector<Channel>& all() const { return channels_; }
  bool empty() const { return channels_.empty(); }

 private:
  // Closes and removes the channels for which `predicate` is true.
  template <typename Predicate>
  void CloseIf(Predicate predicate);

  std::unique_ptr<exchange::SharedFile> file_;  // the memory of the bell and of all slots
  std::unique_ptr<exchange::Mapping> bell_;     // the part of the file with the bell
  std::uint64_t size_ = 0;  // size of the file in bytes; slots are not used twice
  std::vector<Channel> channels_;
};

}  // namespace gsv::simulation
