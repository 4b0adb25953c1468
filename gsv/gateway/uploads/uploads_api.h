// The part of the HTTP API that takes files, see docs/api.yaml:
//   POST /api/uploads             begin a set of files that belong together
//   PUT  /api/uploads/SET/PATH    one of them; gives the path that a scenario names as its world
//
// Threads  any.
#pragma once

#include "gsv/gateway/http.h"
#include "gsv/gateway/uploads/upload_folder.h"

namespace gsv::gateway::uploads {

// Of one file. The server refuses what is longer before it has read it.
inline constexpr std::uint64_t kLargestUpload = std::uint64_t{64} << 20;

bool IsUpload(const Target& target);

class UploadsApi {
 public:
  // `request.target` begins with "api", "uploads".
  Response Handle(const Request& request);

 private:
  UploadFolder folder_;
};

}  // namespace gsv::gateway::uploads
