// The part of the HTTP API that tells of recordings and opens them, see docs/api.yaml:
//   GET  /api/recordings               what there is
//   POST /api/recordings/NAME/replay   a replay of one's own, below /replays/…/
//
// Threads  any.
#pragma once

#include "gsv/gateway/http/http.h"
#include "gsv/gateway/recordings/recording_folder.h"
#include "gsv/gateway/recordings/replay_sessions.h"

namespace gsv::gateway::recordings {

class RecordingsApi {
 public:
  explicit RecordingsApi(std::filesystem::path folder, std::string only = {},
                         const SessionLimits& limits = {})
      : folder_(std::move(folder), std::move(only)), sessions_(limits) {}

  // `request.target` begins with "api", "recordings".
  Response Handle(const Request& request);

  ReplaySessions& sessions() { return sessions_; }
  const RecordingFolder& folder() const { return folder_; }

 private:
  Response List();
  Response Open(const std::string& name);

  RecordingFolder folder_;
  ReplaySessions sessions_;
};

}  // namespace gsv::gateway::recordings
