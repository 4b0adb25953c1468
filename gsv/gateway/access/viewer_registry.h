// Who is watching, under which names, and who of them holds control of what they watch.
//
// Each viewer looks at one simulation, or at none. While nobody holds control of a simulation, all
// may act on it. Who asks gets it at once if it is free; else the holder is told, and grants it or
// keeps it; it passes by itself when the holder does not answer in time, leaves, or looks at
// another simulation. Viewers are there as long as they keep asking how things stand.
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

struct ControlLimits {
  std::chrono::milliseconds absence{8'000};  // after which a viewer counts as gone
  std::chrono::milliseconds answer{20'000};  // to a question for control
};

class ViewerRegistry {
 public:
  using Time = std::chrono::steady_clock::time_point;
  static constexpr std::size_t kMaxViewers = 1000;

  struct ViewerState {
    std::uint64_t number = 0;  // never used again
    std::string name;
    std::string simulation;  // that they look at; empty: none
    bool holds = false;      // control of it
    std::size_t asks = 0;    // position in the queue for it, from 1; 0: does not wait
    std::chrono::milliseconds
        left{};  // of the first in the row: until it passes to them unanswered
  };
  struct ViewerList {
    std::vector<ViewerState> viewers;  // by number
    std::uint64_t you = 0;             // 0: you are none of them
  };
  struct Admission {
    std::uint64_t number = 0;
    std::string key;  // by which this viewer is known from now on; told to nobody else
  };

  explicit ViewerRegistry(const ControlLimits& limits = {}) : limits_(limits) {}

  // `name` empty: "viewer NUMBER". kUnavailable: too many are there.
  base::Result<Admission> Enter(const std::string& name, const std::string& simulation, Time now);
  // These fail with kNotFound when no viewer has this key, any more.
  base::Status Rename(const std::string& key, const std::string& name, Time now);
  // Looks at another simulation from now on; empty: at none.
  base::Status SelectSimulation(const std::string& key, const std::string& simulation, Time now);
  base::Status Leave(const std::string& key, Time now);
  // kNotRunning: who asks looks at no simulation.
  base::Status RequestControl(const std::string& key, Time now);
  // Lets go of control, or of the question for it.
  base::Status Release(const std::string& key, Time now);
  // To the first who asks. kNotRunning: who answers does not hold control, or nobody asks.
  base::Status Answer(const std::string& key, bool grants, Time now);

  // How things stand; whose key it is counts as there.
  ViewerList List(const std::string& key, Time now);
  // Another number whenever something is otherwise than before.
  std::uint64_t Version(Time now);
  // kNotRunning with a sentence: somebody else holds control of the simulation.
  base::Status CheckControl(const std::string& key, const std::string& simulation, Time now);

 private:
  struct Viewer {
    ViewerState person;
    Time seen;
  };
  struct Question {
    std::string key;
    Time asked;
  };
  // Of one simulation.
  struct Control {
    std::string holder;  // a key; empty: nobody
    std::deque<Question> questions;
  };

  void Expire(Time now)
      GSV_REQUIRES(mutex_);  // lets go of who is gone, and passes control on where it is due
  void Forget(const std::string& key) GSV_REQUIRES(mutex_);
  void ReleaseControl(const std::string& key) GSV_REQUIRES(mutex_);
  static void PassControl(Control& control, Time now);
  base::Result<Viewer*> Find(const std::string& key, Time now) GSV_REQUIRES(mutex_);
  Control& ControlOf(const Viewer& viewer) GSV_REQUIRES(mutex_) {
    return controls_[viewer.person.simulation];
  }

  const ControlLimits limits_;
  base::Mutex mutex_;
  std::map<std::string, Viewer> viewers_ GSV_GUARDED_BY(mutex_);    // by key
  std::map<std::string, Control> controls_ GSV_GUARDED_BY(mutex_);  // by simulation
  std::uint64_t next_ GSV_GUARDED_BY(mutex_) = 1;
  std::uint64_t version_ GSV_GUARDED_BY(mutex_) = 1;
};

}  // namespace gsv::gateway::access
