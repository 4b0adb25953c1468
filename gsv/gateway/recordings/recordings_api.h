// The part of the HTTP API that lists recordings and opens replays.
//
// Threads  any.
#pragma once

#include <vector>

#include "gsv/gateway/http/route.h"
#include "gsv/gateway/recordings/recording_folder.h"
#include "gsv/gateway/recordings/replay_sessions.h"

namespace gsv::gateway::recordings {

class RecordingsApi {
 public:
  explicit RecordingsApi(std::filesystem::path folder, std::string only = {},
                         const SessionLimits& limits = {})
      : folder_(std::move(folder), std::move(only)), sessions_(limits) {}

  // Includes the routes of the sessions, whose images `drawer` draws. The handlers are valid during
  // the lifetime of this object and of the drawer.
  std::vector<Route> Routes(drawing::ViewDrawer& drawer);

  ReplaySessions& sessions() { return sessions_; }
  const RecordingFolder& folder() const { return folder_; }

 private:
  Response List();
  Response Open(const std::string& name);

  RecordingFolder folder_;
  ReplaySessions sessions_;
};

}  // namespace gsv::gateway::recordings
