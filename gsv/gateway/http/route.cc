#include "gsv/gateway/http/route.h"

#include <iterator>
#include <utility>

namespace gsv::gateway {

Route SocketRoute(std::string pattern, bool needs_control, Route::FindHub find_hub,
                  std::string summary) {
  Route route{"GET", std::move(pattern), Permission::kWatch, needs_control, Pool::kReaders};
  route.handler = [](const Request&) {
    return ErrorResponse(
        426, "this address accepts only WebSockets with the sub-protocol foxglove.sdk.v1");
  };
  route.summary = std::move(summary);
  route.find_hub = std::move(find_hub);
  return route;
}

void Append(std::vector<Route>& routes, std::vector<Route> more) {
  routes.insert(routes.end(), std::make_move_iterator(more.begin()),
                std::make_move_iterator(more.end()));
}

}  // namespace gsv::gateway
