// Requests and responses, independent of an HTTP library.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/gateway/foxglove/shared_bytes.h"
#include "gsv/gateway/http/body_stream.h"
#include "gsv/gateway/http/target.h"

namespace gsv::gateway {

// An HTTP request with its complete body.
struct Request {
  // "GET", "POST", "PUT" or "DELETE". A HEAD request arrives as GET, and its response is sent
  // without the body.
  std::string method;
  std::string raw_target;  // unparsed: "/api/simulations?x=1"
  Target target;
  std::string body;
  std::string content_type;
  std::string if_none_match;  // value of the If-None-Match header, or empty
  std::string viewer;  // the viewer's key (Gsv-Viewer), or empty; see access/viewer_registry.h
  // parameters of the path by name, see Route
  std::map<std::string, std::string, std::less<>> parameters;

  // A parameter of the route's pattern. The pattern must have this parameter (GSV_CHECK).
  const std::string& Parameter(std::string_view name) const;
};

// An HTTP response: a body, or a stream.
struct Response {
  int status = 200;
  std::string content_type;
  SharedBytes body;
  std::string etag;  // the tag with its quotes; empty if there is none
  std::string cache_control = "no-store";
  std::string allow;  // for status 405: the allowed methods
  // Whether pages of this server may show the response in a frame. Other pages never may.
  bool allows_own_frames = false;
  // Whether pages of other sites may embed the response, as an image.
  bool allows_other_sites = false;
  std::vector<std::pair<std::string, std::string>> headers{};  // further headers
  // A stream that is sent instead of `body`. The connection is closed at the end of the stream. If
  // null, `body` is sent.
  std::shared_ptr<BodyStream> stream{};
};

// May be called from any thread, exactly once.
using Respond = std::function<void(Response)>;

Response JsonResponse(int status, std::string json);
// {"error": sentence}
Response ErrorResponse(int status, std::string_view sentence);
// Returns a response with the error's sentence. The status depends on the code of the error.
Response ErrorResponse(const base::Error& error);
Response MethodNotAllowed(std::string allow);

// Whether an If-None-Match header names this entity tag.
bool Matches(std::string_view if_none_match, std::string_view etag);

}  // namespace gsv::gateway
