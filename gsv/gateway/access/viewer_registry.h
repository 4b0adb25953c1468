// A ViewerRegistry stores the viewers, their names, and which viewer holds control of each
// simulation.
//
// Each viewer selects one simulation or none. While no viewer holds control of a simulation, all
// viewers may command it. A viewer that requests control gets it at once if no viewer holds it.
// Otherwise the holder is asked, and grants or refuses. Control passes automatically if the holder
// does not answer in time, leaves, or selects another simulation. A viewer expires when it stops
// polling.
//
// Threads  any; nothing blocks.
// Bounded  kMaxViewers.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/base/mutex.h"

namespace gsv::gateway::access {

// Time limits after which a viewer loses its registration, or the control of a simulation.
struct ControlLimits {
  std::chrono::milliseconds absence{8'000};  // a viewer that is silent for this long expires
  std::chrono::milliseconds answer{20'000};  // time limit for the answer to a request for control
};

// The viewers of a server, and which of them hold control.
class ViewerRegistry {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::size_t kMaxViewers = 1000;  // maximum number of viewers

  // A viewer as other viewers see it.
  struct ViewerState {
    std::uint64_t number = 0;  // the number of the viewer, which is never used again
    std::string name;
    std::string simulation;  // the selected simulation; empty: none is selected
    bool holds = false;      // whether the viewer has control of this simulation
    std::size_t asks = 0;    // position in the queue for control, from 1; 0: not waiting
    // For the first viewer in the queue: time until it gets control if the holder does not answer.
    std::chrono::milliseconds left{};
  };
  // The answer to List().
  struct ViewerList {
    std::vector<ViewerState> viewers;  // by number
    std::uint64_t you = 0;             // number of the calling viewer; 0 if it is not a viewer
  };
  // The answer to Enter(). The viewer identifies itself by the key.
  struct Admission {
    std::uint64_t number = 0;
    std::string key;  // secret key of this viewer
  };

  explicit ViewerRegistry(const ControlLimits& limits = {}) : limits_(limits) {}

  // Adds a viewer. An empty `name` becomes "viewer NUMBER". Fails with kUnavailable if there are
  // too many viewers.
  base::Result<Admission> Enter(const std::string& name, const std::string& simulation, Time now);
  // Renames a viewer. Rename() and the functions up to Answer() fail with kNotFound if no viewer
  // has this key.
  base::Status Rename(const std::string& key, const std::string& name, Time now);
  // Selects a simulation; empty: none.
  base::Status SelectSimulation(const std::string& key, const std::string& simulation, Time now);
  // Removes a viewer.
  base::Status Leave(const std::string& key, Time now);
  // Requests control. kNotRunning: the viewer has selected no simulation.
  base::Status RequestControl(const std::string& key, Time now);
  // Releases control, or withdraws the request for it.
  base::Status Release(const std::string& key, Time now);
  // Grants or refuses the first request in the queue. kNotRunning: the viewer does not hold
  // control, or there is no request.
  base::Status Answer(const std::string& key, bool grants, Time now);

  // Returns the list of viewers, and notes that the viewer with this key is still connected.
  ViewerList List(const std::string& key, Time now);
  // Returns a number that changes whenever the viewers or the control change.
  std::uint64_t Version(Time now);
  // Fails with kNotRunning if another viewer holds control of the simulation. The message of the
  // error names this viewer.
  base::Status CheckControl(const std::string& key, const std::string& simulation, Time now);

 private:
  // A registered viewer.
  struct Viewer {
    ViewerState person;  // all members except those that List() computes
    Time seen;           // time of the viewer's last request
  };
  // A request for control.
  struct Question {
    std::string key;  // the key of the viewer that requests control
    Time asked;       // time at which the holder was asked; only valid for the first request
  };
  // The viewer that holds control of one simulation, and the queue of requests for it.
  struct Control {
    std::string holder;  // key of the viewer that has control; empty: none
    std::deque<Question> questions;
  };

  // Removes expired viewers, and passes control if a holder has not answered in time.
  void Expire(Time now) GSV_REQUIRES(mutex_);
  // Removes a viewer, and its control or request for control.
  void Forget(const std::string& key) GSV_REQUIRES(mutex_);
  // Releases the control that this viewer holds.
  void ReleaseControl(const std::string& key) GSV_REQUIRES(mutex_);
  // Gives control to the first viewer in the queue.
  static void PassControl(Control& control, Time now);
  // Returns the viewer with this key, and notes that it is still connected.
  base::Result<Viewer*> Find(const std::string& key, Time now) GSV_REQUIRES(mutex_);
  // Returns the control of the simulation that the viewer has selected.
  Control& ControlOf(const Viewer& viewer) GSV_REQUIRES(mutex_) {
    return controls_[viewer.person.simulation];
  }

  const ControlLimits limits_;
  base::Mutex mutex_;
  std::map<std::string, Viewer> viewers_ GSV_GUARDED_BY(mutex_);    // by key
  std::map<std::string, Control> controls_ GSV_GUARDED_BY(mutex_);  // by simulation
  std::uint64_t next_ GSV_GUARDED_BY(mutex_) = 1;                   // number of the next viewer
  std::uint64_t version_ GSV_GUARDED_BY(mutex_) = 1;                // see Version()
};

}  // namespace gsv::gateway::access
