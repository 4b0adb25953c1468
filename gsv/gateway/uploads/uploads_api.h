// The part of the HTTP API that takes files: sets of them, which belong together. What is uploaded
// has a path on this machine, which a scenario can name as its world.
//
// Threads  any.
#pragma once

#include <vector>

#include "gsv/gateway/http/route.h"
#include "gsv/gateway/uploads/upload_folder.h"

namespace gsv::gateway::uploads {

class UploadsApi {
 public:
  explicit UploadsApi(const UploadLimits& limits = {}) : folder_(limits) {}

  // The handlers live as long as this.
  std::vector<Route> Routes();

 private:
  UploadFolder folder_;
};

}  // namespace gsv::gateway::uploads
