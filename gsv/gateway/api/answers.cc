#include "gsv/gateway/api/answers.h"

#include <string_view>
#include <vector>

namespace gsv::gateway {

Response NoSuchAddress() {
  return ErrorResponse(404, "there is nothing at this address; docs/api.yaml lists what there is");
}

Response ModelAnswer(const Request& request,
                     const std::function<base::Result<SharedBytes>(const std::string& id)>& glb) {
  const std::vector<std::string>& path = request.target.segments;
  static constexpr std::string_view kEnding = ".glb";
  if (path.size() != 3 || !path[2].ends_with(kEnding)) return NoSuchAddress();
  if (request.method != "GET") return MethodNotAllowed("GET");
  const std::string id = path[2].substr(0, path[2].size() - kEnding.size());
  const base::Result<SharedBytes> bytes = glb(id);
  if (!bytes) return ErrorResponse(bytes.error());
  Response response;
  response.content_type = "model/gltf-binary";
  response.etag = '"' + id + '"';
  response.cache_control = "public, max-age=31536000, immutable";
  if (Matches(request.if_none_match, response.etag)) {
    response.status = 304;
  } else {
    response.body = *bytes;
  }
  return response;
}

}  // namespace gsv::gateway
