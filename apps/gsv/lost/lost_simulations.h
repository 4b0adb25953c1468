// What servers before this one have lost: a server that was killed left a note of what it ran
// (server_note.h), which the next one with the same folder of recordings takes over. Keeps the note
// of this server, too.
//
// Threads  any. A thread of its own writes the note when what is run has changed, up to twice a
//          second; another looks into the recordings, which may take long.
// Bounded  kMaxKept, the newest.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "apps/gsv/lost/server_note.h"
#include "gsv/base/mutex.h"
#include "gsv/gateway/program/ports.h"
#include "gsv/services/simulation_host.h"

namespace gsv::app {

class LostSimulations {
 public:
  static constexpr std::size_t kMaxKept = 100;

  struct Server {
    std::string name;    // in its offer
    std::string broker;  // its reference
    std::filesystem::path recordings;
  };

  // Takes over, and tells the log of each. Where the state folder cannot be used, it says so and
  // what runs here would not be missed. `host` and `recordings` outlive it.
  LostSimulations(const Server& server, services::SimulationHost& host,
                  gateway::RecordingSwitch& recordings);
  // A clean end: nothing was lost, and what was told of has been told.
  ~LostSimulations();

  // By their numbers, which stay as long as this server.
  std::map<int, LostSimulation> List() const;
  // Of its recording, if that lies in this server's folder; else empty.
  std::string NameInFolder(const LostSimulation& lost) const;
  // Forgets one. False: there is none of that number.
  bool Dismiss(int number);

 private:
  void TakeOver(const std::filesystem::path& folder);
  void Keep(std::vector<LostSimulation> lost);
  void Examine(const std::stop_token& stop);
  void WatchOver(const std::stop_token& stop);
  void Write();
  std::vector<LostSimulation> Running() const;

  services::SimulationHost& host_;
  gateway::RecordingSwitch& recordings_;
  std::filesystem::path file_;  // this server's note; empty: it cannot be kept
  ServerNote note_;             // as it was written last; the watching thread's
  bool could_write_ = true;
  mutable base::Mutex mutex_;  // guards lost_ and next_
  std::condition_variable_any changed_;
  std::map<int, LostSimulation> lost_ GSV_GUARDED_BY(mutex_);
  int next_ GSV_GUARDED_BY(mutex_) = 1;
  std::jthread examiner_, watcher_;  // the last members: they use all others
};

}  // namespace gsv::app
