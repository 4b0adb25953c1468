#include "apps/gsv/lost/lost_page.h"

#include <charconv>

#include <nlohmann/json.hpp>

namespace gsv::app {
namespace {

gateway::Response Dismiss(LostSimulations& lost, const std::string& text) {
  int number = 0;
  const char* const end = text.data() + text.size();
  const auto [last, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc() || last != end || !lost.Dismiss(number)) {
    return gateway::ErrorResponse(404, "nothing that was lost has this number; see /api/lost");
  }
  return gateway::JsonResponse(200, "{}");
}

}  // namespace

gateway::Response AnswerOfLost(LostSimulations& lost, const gateway::Request& request) {
  const std::vector<std::string>& path = request.target.segments;
  if (path.size() == 3) {
    if (request.method != "DELETE") return gateway::MethodNotAllowed("DELETE");
    return Dismiss(lost, path[2]);
  }
  if (path.size() != 2) return gateway::ErrorResponse(404, "there is nothing there");
  if (request.method != "GET") return gateway::MethodNotAllowed("GET");
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const auto& [number, each] : lost.List()) {
    list.push_back({{"number", number}});
    list.back().update(Describe(each));
    list.back()["replay"] = lost.NameInFolder(each);
  }
  return gateway::JsonResponse(
      200, nlohmann::ordered_json{{"lost", std::move(list)}}.dump(
               -1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

}  // namespace gsv::app
