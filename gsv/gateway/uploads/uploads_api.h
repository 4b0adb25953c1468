// The part of the HTTP API that takes files, see docs/api.yaml:
//   POST /api/uploads             begin a set of files that belong together
//   PUT  /api/uploads/SET/PATH    one of them; gives the path that a scenario names as its world
//
// Threads  any.
#pragma once

#include "gsv/gateway/http/http.h"
#include "gsv/gateway/uploads/upload_folder.h"

namespace gsv::gateway::uploads {

bool IsUpload(const Target& target);

class UploadsApi {
 public:
  explicit UploadsApi(const UploadLimits& limits = {}) : folder_(limits) {}

  // `request.target` begins with "api", "uploads".
  Response Handle(const Request& request);

 private:
  UploadFolder folder_;
};

}  // namespace gsv::gateway::uploads
