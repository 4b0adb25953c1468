#include "gsv/gateway/access/need.h"

namespace gsv::gateway::access {

Need NeedOf(std::string_view method, const Target& target) {
  const std::vector<std::string>& path = target.segments;
  const std::string place = path.empty() ? "" : path[0];
  if (place == "ws" || place == "replays" || place == "metrics") return {Right::kWatch};
  if (place != "api") return {Right::kNone};
  if (method == "GET" || method == "HEAD") return {Right::kWatch};
  const std::string what = path.size() < 2 ? "" : path[1];
  if (what == "recordings") return {Right::kWatch};
  if (what == "viewers") return {path.size() > 3 ? Right::kControl : Right::kWatch};
  if (what == "simulations" && path.size() > 2) return {Right::kControl, path[2]};
  return {Right::kControl};
}

}  // namespace gsv::gateway::access
