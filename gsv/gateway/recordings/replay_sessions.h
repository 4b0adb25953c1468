// ReplaySessions stores the open replays of recordings. Each replay has its own player, so that
// viewers control their replays independently.
//
// Opening a replay, or a request to one, ends the sessions that no viewer has used for half a
// minute.
//
// Threads  any; opening a recording reads its index.
// Bounded  see SessionLimits.
#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "gsv/base/mutex.h"
#include "gsv/gateway/api/replay_api.h"
#include "gsv/gateway/drawing/view_routes.h"
#include "gsv/gateway/replay/replay_player.h"

namespace gsv::gateway::recordings {

// The maximum number of open replays, and the time after which a replay without viewers ends.
struct SessionLimits {
  std::size_t sessions = 32;                    // maximum number of open replays
  std::chrono::milliseconds unwatched{30'000};  // time after which a replay without viewers ends
};

// The open replays of recordings.
class ReplaySessions {
 public:
  explicit ReplaySessions(const SessionLimits& limits = {}) : limits_(limits) {}
  ~ReplaySessions() { Stop(); }

  // Opens the recording at `path`. `recording` is its name for viewers. Returns the name of the
  // session. kUnavailable: too many sessions.
  base::Result<std::string> Open(const std::string& path, const std::string& recording);

  // Adds a session for a player. `recording` is the name under which viewers can open the recording
  // after the session has ended. It is empty if they cannot open it again: this is so for the
  // history of a simulation.
  base::Result<std::string> Add(std::unique_ptr<ReplayPlayer> player, const std::string& recording);

  // Returns the routes below /replays/{session}/: the API of a replay, and its live stream at ws,
  // with views that `drawer` draws. All routes need only the permission to watch. The handlers are
  // valid during the lifetime of this object and of the drawer.
  std::vector<Route> Routes(drawing::ViewDrawer& drawer);
  // Returns the hub of a session. The session exists at least as long as the hub is used.
  base::Result<std::shared_ptr<Hub>> FindHub(const std::string& name);
  // Returns the world that the images of a session show.
  base::Result<drawing::ViewedWorld> FindViewed(const std::string& name);

  // Ends all sessions and refuses to open further sessions.
  void Stop();

 private:
  // An open replay.
  struct Entry {
    Replay replay;
    std::chrono::steady_clock::time_point used;  // last time at which viewers used it
  };

  // Returns the replay of a session. Fails with kNotFound if it does not exist.
  base::Result<Replay> Find(const std::string& name);
  // Removes the sessions without viewers and returns them. A session ends when its entry is
  // destroyed.
  std::map<std::string, Entry> TakeUnwatched();

  const SessionLimits limits_;
  base::Mutex mutex_;
  std::map<std::string, Entry> sessions_ GSV_GUARDED_BY(mutex_);  // by name
  std::uint64_t next_ GSV_GUARDED_BY(mutex_) = 1;                 // the next session's name
  bool is_stopped_ GSV_GUARDED_BY(mutex_) = false;
};

}  // namespace gsv::gateway::recordings
