// The simulations that earlier servers lost. A server that was killed left a note of its
// simulations (server_note.h), which the next server with the same folder of recordings takes over.
// This class also keeps the note of this server.
//
// Threads  any. One thread writes the note after changes, at most twice a second; another reads the
//          recordings, which may take long.
// Bounded  keeps the newest kMaxKept.
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

  // Takes over the notes, and logs each simulation. If the state folder cannot be used, logs that a
  // crash of this server would not be reported. `host` and `recordings` must outlive this.
  LostSimulations(const Server& server, services::SimulationHost& host,
                  gateway::RecordingSwitch& recordings);
  // A regular end: nothing was lost, and the crash reports end as well.
  ~LostSimulations();

  // By number; the numbers stay for the lifetime of this server.
  std::map<int, LostSimulation> List() const;
  // The name of its recording, if that is in this server's folder; else empty.
  std::string NameInFolder(const LostSimulation& lost) const;
  // Dismisses one. False if there is none of that number.
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
  std::filesystem::path file_;  // this server's note; empty: it cannot be written
  ServerNote note_;             // as it was written last; used by the watching thread
  bool could_write_ = true;
  mutable base::Mutex mutex_;  // guards lost_ and next_
  std::condition_variable_any changed_;
  std::map<int, LostSimulation> lost_ GSV_GUARDED_BY(mutex_);
  int next_ GSV_GUARDED_BY(mutex_) = 1;
  std::jthread examiner_, watcher_;  // the last members: they use all others
};

}  // namespace gsv::app
