// What the gateway needs from the program around it.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "gsv/simulation/simulation.h"

namespace gsv::gateway {

// The simulations that can be watched.
//
// Threads  both may be called from any thread, and return at once.
class SimulationDirectory {
 public:
  virtual ~SimulationDirectory() = default;

  // In the order in which a person should see them; the first is what a viewer opens by default.
  virtual std::vector<std::shared_ptr<simulation::Simulation>> List() = 0;
  // Null if there is none of that name.
  virtual std::shared_ptr<simulation::Simulation> Find(const std::string& name) = 0;
};

// Switches recordings on and off.
//
// Threads  any; starting writes models, stopping waits for the disk.
class RecordingSwitch {
 public:
  struct State {
    bool is_recording = false;
    std::string path;            // of the recording under way, or of the last one
    std::uint64_t messages = 0;  // so far
    std::uint64_t dropped = 0;   // messages that the disk was too slow for
    std::uint64_t bytes = 0;     // written
  };

  virtual ~RecordingSwitch() = default;
  // To a new file, whose name the program chooses: who asks is a browser.
  virtual base::Status Record(const std::shared_ptr<simulation::Simulation>& simulation) = 0;
  virtual base::Status StopRecording(const std::string& simulation) = 0;
  virtual State RecordingOf(const std::string& simulation) = 0;

  // Of all recordings since this process started.
  struct Totals {
    std::uint64_t under_way = 0, messages = 0, dropped = 0, bytes = 0;
  };
  virtual Totals totals() = 0;
};

}  // namespace gsv::gateway
