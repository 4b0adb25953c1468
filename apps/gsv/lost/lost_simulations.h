// Crash reports: the simulations that ran on servers that were killed. Each server has a file with
// a note of its simulations (server_note.h), which remains after a kill. The next server with the
// same folder of recordings takes over the note. This class also writes the note of this server.
//
// Threads  any. One thread writes the note twice a second. Another thread reads the recordings,
//          which may take long.
// Bounded  to the newest kMaxKept reports.
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

  // The properties of this server that its note contains.
  struct Server {
    std::string name;                  // the name in the server's offer
    std::string broker;                // the reference of the server's broker
    std::filesystem::path recordings;  // folder of this server's recordings
  };

  // Takes over the notes of ended servers, and logs each lost simulation. If the state folder
  // cannot be used, it logs that a crash of this server would not be reported. `host` and
  // `recordings` must outlive this object.
  LostSimulations(const Server& server, services::SimulationHost& host,
                  gateway::RecordingSwitch& recordings);
  // Removes the note of this server, because no simulation is lost at a regular end.
  ~LostSimulations();

  // Returns the lost simulations by number. The numbers do not change during the lifetime of this
  // server.
  std::map<int, LostSimulation> List() const;
  // Returns the file name of the simulation's recording. Returns an empty text if the recording is
  // not in this server's folder of recordings.
  std::string NameInFolder(const LostSimulation& lost) const;
  // Deletes a report. Returns false if there is none with that number.
  bool Dismiss(int number);

 private:
  // Adds the simulations in notes of ended servers, and removes these notes.
  void TakeOver(const std::filesystem::path& folder);
  // Numbers the newest kMaxKept simulations, and adds them to lost_.
  void Keep(std::vector<LostSimulation> lost);
  // The function of examiner_: reads the recordings of the lost simulations, and logs each.
  void Examine(const std::stop_token& stop);
  // The function of watcher_: writes the note of this server twice a second.
  void WatchOver(const std::stop_token& stop);
  // Writes the note of this server.
  void Write();
  // Returns the simulations that this server runs now, in the form for its note.
  std::vector<LostSimulation> Running() const;

  services::SimulationHost& host_;
  gateway::RecordingSwitch& recordings_;
  std::filesystem::path file_;  // path of this server's note; empty if it cannot be written
  ServerNote note_;             // the note without its simulations; does not change
  bool could_write_ = true;     // false after a failed write, so that the failure is logged once
  mutable base::Mutex mutex_;   // guards lost_ and next_
  // never notified; the threads wait on it until they are stopped
  std::condition_variable_any changed_;
  std::map<int, LostSimulation> lost_ GSV_GUARDED_BY(mutex_);  // by number of the report
  int next_ GSV_GUARDED_BY(mutex_) = 1;                        // number of the next report
  // Destroyed before all other members, because the threads use these.
  std::jthread examiner_, watcher_;
};

}  // namespace gsv::app
