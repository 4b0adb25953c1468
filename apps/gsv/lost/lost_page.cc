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
    return gateway::ErrorResponse(404, "no crash report has this number; /api/lost lists them");
  }
  return gateway::JsonResponse(200, "{}");
}

gateway::Response List(const LostSimulations& lost) {
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

}  // namespace

std::vector<gateway::Route> LostRoutes(LostSimulations& lost) {
  using enum gateway::Permission;
  using enum gateway::Pool;
  return {
      {"GET", "/api/lost", kWatch, false, kReaders,
       [&lost](const gateway::Request&) { return List(lost); },
       "List the simulations of servers that were killed"},
      {"DELETE", "/api/lost/{number}", kControl, false, kCommanders,
       [&lost](const gateway::Request& request) {
         return Dismiss(lost, request.Parameter("number"));
       },
       "Dismiss a crash report"},
  };
}

}  // namespace gsv::app
