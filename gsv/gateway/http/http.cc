#include "gsv/gateway/http/http.h"

#include <nlohmann/json.hpp>

#include "gsv/base/check.h"

namespace gsv::gateway {
namespace {

int StatusOf(base::ErrorCode code) {
  switch (code) {
    case base::ErrorCode::kInvalidArgument:
    case base::ErrorCode::kCorrupt:
      return 400;
    case base::ErrorCode::kNotFound:
      return 404;
    case base::ErrorCode::kNotRunning:
    case base::ErrorCode::kEnded:
      return 409;
    case base::ErrorCode::kUnavailable:
      return 503;
    case base::ErrorCode::kTimeout:
      return 504;
    case base::ErrorCode::kBadModel:
    case base::ErrorCode::kBehaviour:
      return 500;
  }
  return 500;
}

}  // namespace

const std::string& Request::Parameter(std::string_view name) const {
  const auto found = parameters.find(name);
  GSV_CHECK(found != parameters.end());
  return found->second;
}

Response JsonResponse(int status, std::string json) {
  Response response;
  response.status = status;
  response.content_type = "application/json";
  response.body = SharedBytes(std::move(json));
  return response;
}

Response ErrorResponse(int status, std::string_view sentence) {
  const nlohmann::json json{{"error", sentence}};
  return JsonResponse(status, json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
}

Response ErrorResponse(const base::Error& error) {
  return ErrorResponse(StatusOf(error.code), error.Sentence());
}

Response MethodNotAllowed(std::string allow) {
  Response response = ErrorResponse(405, "this address accepts only the methods " + allow);
  response.allow = std::move(allow);
  return response;
}

bool Matches(std::string_view if_none_match, std::string_view etag) {
  if (etag.empty()) return false;
  return if_none_match == "*" || if_none_match.find(etag) != std::string_view::npos;
}

}  // namespace gsv::gateway
