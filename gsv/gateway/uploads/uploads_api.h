// UploadsApi is the part of the HTTP API for uploads of sets of files. An uploaded file gets a path
// on this machine, which a scenario can use as its world.
//
// Threads  any.
#pragma once

#include <vector>

#include "gsv/gateway/http/route.h"
#include "gsv/gateway/uploads/upload_folder.h"

namespace gsv::gateway::uploads {

// The part of the HTTP API for uploads.
class UploadsApi {
 public:
  explicit UploadsApi(const UploadLimits& limits = {}) : folder_(limits) {}

  // The handlers are valid during the lifetime of this object.
  std::vector<Route> Routes();

 private:
  UploadFolder folder_;
};

}  // namespace gsv::gateway::uploads
