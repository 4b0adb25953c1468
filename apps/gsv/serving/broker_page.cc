#include "apps/gsv/serving/broker_page.h"

#include <algorithm>
#include <memory>
#include <sstream>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "gsv/broker/client/broker_administration.h"
#include "gsv/broker/client/broker_client.h"
#include "gsv/broker/client/offer_listing.h"
#include "gsv/broker/language/explanation.h"
#include "gsv/orb/orb.h"

namespace gsv::app {
namespace {

using gateway::ErrorResponse;
using gateway::Response;
using nlohmann::ordered_json;

constexpr std::chrono::seconds kTimeout{3};
constexpr std::size_t kShown = 200;  // maximum number of matching offers, and of other offers

// Returns the output of `print` as a list; each line is one JSON value.
template <typename Print>
ordered_json Values(const Print& print) {
  std::stringstream lines;
  print(lines);
  ordered_json values = ordered_json::array();
  for (std::string line; std::getline(lines, line);) values.push_back(ordered_json::parse(line));
  return values;
}

Response Answer(ordered_json json) { return gateway::JsonResponse(200, json.dump()); }

const char* Spelling(broker::TermOutcome::Result result) {
  switch (result) {
    case broker::TermOutcome::Result::kTrue:
      return "true";
    case broker::TermOutcome::Result::kFalse:
      return "false";
    default:
      return "no value";
  }
}

ordered_json ToJson(const std::string& type, const broker::FoundOffer& offer, bool matches,
                    const std::vector<broker::TermOutcome>& outcomes) {
  const std::vector<broker::OfferDescription> descriptions = {
      {.type = type, .address = orb::AddressOf(offer.object), .properties = offer.properties}};
  ordered_json json =
      Values([&](std::ostream& out) { PrintOffersJson(descriptions, out); }).front();
  json["matches"] = matches;
  json["terms"] = ordered_json::array();
  for (const broker::TermOutcome& outcome : outcomes) {
    json["terms"].push_back({{"term", outcome.term},
                             {"result", Spelling(outcome.result)},
                             {"missing", outcome.missing}});
  }
  return json;
}

bool AllTrue(const std::vector<broker::TermOutcome>& outcomes) {
  return std::all_of(outcomes.begin(), outcomes.end(), [](const broker::TermOutcome& outcome) {
    return outcome.result == broker::TermOutcome::Result::kTrue;
  });
}

std::string Argument(const gateway::Target& target, const std::string& name) {
  const auto found = target.query.find(name);
  return found != target.query.end() ? found->second : std::string();
}

class BrokerPage {
 public:
  BrokerPage(CORBA::ORB_ptr orb, std::string broker)
      : orb_(CORBA::ORB::_duplicate(orb)), broker_(std::move(broker)) {}

  Response Types() const;
  Response Offers(const gateway::Target& target) const;
  Response Links() const;

 private:
  const CORBA::ORB_var orb_;
  const std::string broker_;
};

Response BrokerPage::Types() const {
  const auto types = broker::ListServiceTypes(broker_, kTimeout);
  if (!types) return ErrorResponse(types.error());
  return Answer({{"broker", broker_}, {"types", Values([&](std::ostream& out) {
                                         PrintServiceTypesJson(*types, out);
                                       })}});
}

Response BrokerPage::Offers(const gateway::Target& target) const {
  const std::string type = Argument(target, "type");
  const std::string constraint = Argument(target, "constraint");
  auto client = broker::BrokerClient::Connect(orb_, broker_, kTimeout);
  if (!client) return ErrorResponse(client.error());
  const auto matching = client->Query(type, constraint, Argument(target, "preference"), kShown);
  if (!matching) return ErrorResponse(matching.error());
  const auto all = client->Query(type, "", "", kShown);
  if (!all) return ErrorResponse(all.error());
  const auto expression = broker::ParseConstraint(constraint, {});
  if (!expression) return ErrorResponse(expression.error());

  ordered_json offers = ordered_json::array();
  for (const broker::FoundOffer& offer : *matching) {
    offers.push_back(ToJson(type, offer, true, broker::Explain(*expression, offer.properties)));
  }
  for (const broker::FoundOffer& offer : *all) {
    const auto outcomes = broker::Explain(*expression, offer.properties);
    if (!AllTrue(outcomes)) offers.push_back(ToJson(type, offer, false, outcomes));
  }
  return Answer({{"matching", matching->size()},
                 {"cut", matching->size() == kShown || all->size() == kShown},
                 {"offers", std::move(offers)}});
}

Response BrokerPage::Links() const {
  const auto links = broker::BrokerAdministration(broker_, kTimeout).ListLinks();
  // The error may mean that the trader does not support links, so the list is empty.
  if (!links) return Answer({{"links", ordered_json::array()}});
  return Answer({{"links", Values([&](std::ostream& out) { PrintLinksJson(*links, out); })}});
}

}  // namespace

std::vector<gateway::Route> BrokerRoutes(CORBA::ORB_ptr orb, const std::string& broker) {
  using enum gateway::Permission;
  using enum gateway::Pool;
  const auto page = std::make_shared<const BrokerPage>(orb, broker);
  return {
      {"GET", "/api/broker/types", kWatch, false, kReaders,
       [page](const gateway::Request&) { return page->Types(); },
       "List the service types of the broker with their properties"},
      {"GET", "/api/broker/offers", kWatch, false, kReaders,
       [page](const gateway::Request& request) { return page->Offers(request.target); },
       "List the offers of a service type, and show which of them match a constraint"},
      {"GET", "/api/broker/links", kWatch, false, kReaders,
       [page](const gateway::Request&) { return page->Links(); },
       "List the links of the broker, and whether their targets respond"},
  };
}

}  // namespace gsv::app
