#include "gsv/gateway/uploads/uploads_api.h"

#include <nlohmann/json.hpp>

namespace gsv::gateway::uploads {

bool IsUpload(const Target& target) {
  const std::vector<std::string>& path = target.segments;
  return path.size() > 3 && path[0] == "api" && path[1] == "uploads";
}

Response UploadsApi::Handle(const Request& request) {
  const std::vector<std::string>& path = request.target.segments;
  const auto answer = [](const char* name, const std::string& value) {
    const nlohmann::json json{{name, value}};
    return JsonResponse(201, json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
  };
  if (path.size() == 2) {
    if (request.method != "POST") return MethodNotAllowed("POST");
    const auto set = folder_.Begin();
    return set ? answer("upload", *set) : ErrorResponse(set.error());
  }
  if (!IsUpload(request.target)) {
    return ErrorResponse(404,
                         "there is nothing at this address; docs/api.yaml lists what there is");
  }
  if (request.method != "PUT") return MethodNotAllowed("PUT");
  const auto file = folder_.Put(path[2], {path.begin() + 3, path.end()}, request.body);
  return file ? answer("path", file->string()) : ErrorResponse(file.error());
}

}  // namespace gsv::gateway::uploads
