#include "gsv/gateway/uploads/uploads_api.h"

#include <nlohmann/json.hpp>

namespace gsv::gateway::uploads {

namespace {

Response Created(const char* name, const std::string& value) {
  const nlohmann::json json{{name, value}};
  return JsonResponse(201, json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

}  // namespace

std::vector<Route> UploadsApi::Routes() {
  using enum Permission;
  using enum Pool;
  const auto begin = [this](const Request&) {
    const auto set = folder_.Begin();
    return set ? Created("upload", *set) : ErrorResponse(set.error());
  };
  const auto put = [this](const Request& request) {
    const std::vector<std::string>& path = request.target.segments;
    const auto file =
        folder_.Put(request.Parameter("upload"), {path.begin() + 3, path.end()}, request.body);
    return file ? Created("path", file->string()) : ErrorResponse(file.error());
  };
  return {
      {"POST", "/api/uploads", kControl, false, kCommanders, begin,
       "Create an upload, for files that belong together"},
      {"PUT", "/api/uploads/{upload}/{path...}", kControl, false, kCommanders, put, "Upload a file",
       true},
  };
}

}  // namespace gsv::gateway::uploads
