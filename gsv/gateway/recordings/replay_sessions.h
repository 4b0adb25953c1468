// Recordings that are being replayed, each by a player of its own: what one viewer does with its
// replay moves nobody else's.
//
// A session lives as long as somebody watches it, and half a minute longer, for those who come
// back.
//
// Threads  any; opening a recording takes as long as its index does to be read.
// Bounded  as many sessions as SessionLimits says.
#pragma once

#include <chrono>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "gsv/base/mutex.h"
#include "gsv/gateway/api/replay_api.h"
#include "gsv/gateway/replay/replay_player.h"

namespace gsv::gateway::recordings {

struct SessionLimits {
  std::size_t sessions = 32;
  std::chrono::milliseconds unwatched{30'000};
};

class ReplaySessions {
 public:
  explicit ReplaySessions(const SessionLimits& limits = {}) : limits_(limits) {}
  ~ReplaySessions() { Stop(); }

  // Opens the recording at `path`, which viewers know as `recording`; gives the session's name.
  // kUnavailable: too many are watched.
  base::Result<std::string> Open(const std::string& path, const std::string& recording);

  // Below /replays/{session}/: a replay's API, and its live stream at ws. To watch is permission
  // enough for all of it. The handlers live as long as this.
  std::vector<Route> Routes();
  // The hub of a session. What holds it keeps the session.
  base::Result<std::shared_ptr<Hub>> FindHub(const std::string& name);

  // Ends all of them, and opens none any more.
  void Stop();

 private:
  struct Entry {
    Replay replay;
    std::chrono::steady_clock::time_point used;
  };

  base::Result<Replay> Find(const std::string& name);
  // Takes out those that nobody watches any more; they end when they are let go of.
  std::map<std::string, Entry> TakeUnwatched();

  const SessionLimits limits_;
  base::Mutex mutex_;
  std::map<std::string, Entry> sessions_ GSV_GUARDED_BY(mutex_);  // by name
  std::uint64_t next_ GSV_GUARDED_BY(mutex_) = 1;
  bool is_stopped_ GSV_GUARDED_BY(mutex_) = false;
};

}  // namespace gsv::gateway::recordings
