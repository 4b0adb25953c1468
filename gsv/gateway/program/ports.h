// Interfaces that the program that contains the gateway implements.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "gsv/simulation/simulation.h"

namespace gsv::gateway {

// The directory of simulations.
//
// Threads  any; both functions return at once.
class SimulationDirectory {
 public:
  virtual ~SimulationDirectory() = default;

  // Returns the simulations in the order in which viewers list them. A viewer opens the first one
  // by default.
  virtual std::vector<std::shared_ptr<simulation::Simulation>> List() = 0;
  // Returns null if the name is unknown.
  virtual std::shared_ptr<simulation::Simulation> Find(const std::string& name) = 0;
};

// Starts and stops recordings.
//
// Threads  any; starting writes models, stopping waits for the disk.
class RecordingSwitch {
 public:
  // The state of the recording of one simulation.
  struct State {
    bool is_recording = false;
    std::string path;            // path of the current or the last recording
    std::uint64_t messages = 0;  // recorded messages so far
    std::uint64_t dropped = 0;   // messages dropped because the disk was too slow
    std::uint64_t bytes = 0;     // bytes written so far
  };

  virtual ~RecordingSwitch() = default;
  // Starts to record to a new file, whose name the program chooses.
  virtual base::Status Record(const std::shared_ptr<simulation::Simulation>& simulation) = 0;
  // Ends the recording of the simulation with this name.
  virtual base::Status StopRecording(const std::string& simulation) = 0;
  // Returns the state of the simulation's recording.
  virtual State RecordingOf(const std::string& simulation) = 0;

  // Totals of all recordings since this process started.
  struct Totals {
    // Numbers of current recordings, of recorded and dropped messages, and of written bytes.
    std::uint64_t under_way = 0, messages = 0, dropped = 0, bytes = 0;
  };
  virtual Totals totals() = 0;
};

}  // namespace gsv::gateway
