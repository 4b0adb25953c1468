// Fuzz test: takes the input as an HTTP method, a target and, after a newline, a body. Passes them
// to the API of a simulation and to the parsers of a replay's API.
#include <algorithm>
#include <cmath>
#include <cstdint>

#include <nlohmann/json.hpp>

#include "gsv/base/check.h"
#include "gsv/gateway/access/access_rule.h"
#include "gsv/gateway/api/api.h"
#include "gsv/gateway/api/replay_api.h"
#include "gsv/gateway/testing/answer.h"
#include "gsv/gateway/testing/scripted_simulation.h"
#include "gsv/gateway/testing/simulation_list.h"

using namespace gsv;
using namespace gsv::gateway;

namespace {

base::Result<std::vector<std::uint8_t>> NoModel(const model::Model&) {
  return std::vector<std::uint8_t>(4);
}

struct Served {
  Served() { directory->Add(simulation); }
  std::shared_ptr<gateway::testing::ScriptedSimulation> simulation =
      std::make_shared<gateway::testing::ScriptedSimulation>("arena", 1);
  std::shared_ptr<gateway::testing::SimulationList> directory =
      std::make_shared<gateway::testing::SimulationList>();
  Api api{directory, &NoModel};
  Router router{api.Routes()};
};

void Ask(const Request& request) {
  Served served;
  const Response response = gateway::testing::Answer(served.router, request);
  GSV_CHECK(response.status >= 200 && response.status < 600);
  if (response.content_type != "application/json") return;
  const auto json = nlohmann::json::parse(response.body.view(), nullptr, false);
  GSV_CHECK(!json.is_discarded());
  GSV_CHECK(response.status == 200 || json.contains("error"));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const std::size_t head_end = std::min(text.find('\n'), text.size());
  const std::string_view head = text.substr(0, head_end);
  const std::size_t blank = std::min(head.find(' '), head.size());
  Request request;
  request.method = head.substr(0, blank);
  request.raw_target = head.substr(std::min(blank + 1, head.size()));
  request.body = text.substr(std::min(head_end + 1, text.size()));
  if (const auto time = ParseSeekTime(request.body)) {
    GSV_CHECK(std::abs(base::ToSeconds(*time)) <= 9e9);
  }
  (void)ParseReplayChange(request.body);
  (void)AccessRule("127.0.0.1", 8080, {}, {}).Check(request.method, request.raw_target);
  const auto target = ParseTarget(request.raw_target);
  if (!target) return 0;
  for (const std::string& segment : target->segments) {
    // Escaping triples the length of some segments, so that the target could exceed its limit.
    if (segment.size() > 1000) continue;
    GSV_CHECK(ParseTarget("/" + Escape(segment))->segments ==
              (segment.empty() ? std::vector<std::string>{} : std::vector{segment}));
  }
  request.target = *target;
  if (!target->segments.empty() && target->segments[0] == "api") Ask(request);
  return 0;
}
