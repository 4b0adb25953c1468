#include "gsv/gateway/api/answers.h"

namespace gsv::gateway {

Response ModelAnswer(const Request& request, const std::string& id,
                     const base::Result<SharedBytes>& glb) {
  if (!glb) return ErrorResponse(glb.error());
  Response response;
  response.content_type = "model/gltf-binary";
  response.etag = '"' + id + '"';
  response.cache_control = "public, max-age=31536000, immutable";
  if (Matches(request.if_none_match, response.etag)) {
    response.status = 304;
  } else {
    response.body = *glb;
  }
  return response;
}

}  // namespace gsv::gateway
