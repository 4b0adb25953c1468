// Changes a broker's links, service types and offers, and lists its links. It serves `gsv links`,
// `gsv types` and `gsv offers`. All calls use the process's ORB, and start one if there is none.
// Errors  see BrokerClient; kUnavailable if the broker does not support links.
#pragma once

#include <chrono>
#include <iosfwd>
#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/broker/language/property.h"
#include "gsv/broker/offers/import_policies.h"
#include "gsv/broker/offers/service_type.h"

namespace gsv::broker {

struct LinkDescription {
  std::string name;
  // "host:port" of the other trader; empty if its reference has no TCP address
  std::string address;
  // The link's two follow rules, see TraderLink: the rule that is passed on with a query if the
  // importer sets none, and the most permissive rule that the link allows.
  FollowOption def_pass_on = FollowOption::kAlways;
  FollowOption limiting = FollowOption::kAlways;
  bool answers = false;  // whether the other trader answered a call within a second
};

// Returns "local_only", "if_no_local" or "always".
std::string_view Spelling(FollowOption option);

class BrokerAdministration {
 public:
  explicit BrokerAdministration(std::string broker,
                                std::chrono::milliseconds timeout = std::chrono::seconds(5))
      : broker_(std::move(broker)), timeout_(timeout) {}

  // Lists the links by name. This process, and not the broker, calls each target.
  [[nodiscard]] base::Result<std::vector<LinkDescription>> ListLinks() const;
  // Adds a link. `target` is the address of another broker, which must be running.
  [[nodiscard]] base::Status AddLink(const std::string& name, const std::string& target,
                                     FollowOption def_pass_on, FollowOption limiting) const;
  [[nodiscard]] base::Status RemoveLink(const std::string& name) const;

  [[nodiscard]] base::Status AddServiceType(const ServiceType& type) const;
  [[nodiscard]] base::Status RemoveServiceType(const std::string& name) const;

  // Adds an offer and returns its id. `properties` are "name=value". The value is JSON, and is read
  // as the type that the service type declares. Texts need no quotes.
  [[nodiscard]] base::Result<std::string> AddOffer(
      const std::string& type, const std::string& reference,
      const std::vector<std::string>& properties) const;
  [[nodiscard]] base::Status RemoveOffer(const std::string& id) const;

 private:
  const std::string broker_;                 // the broker's address
  const std::chrono::milliseconds timeout_;  // time limit of each call
};

void PrintLinks(const std::vector<LinkDescription>& links, std::ostream& out);
// Prints one line per link: {"name":…, "address":…, "def_pass_on_follow_rule":…,
// "limiting_follow_rule":…, "answers":…}.
void PrintLinksJson(const std::vector<LinkDescription>& links, std::ostream& out);

// Parses a text such as "mandatory readonly sequence<string> name", which PrintServiceTypes()
// writes.
// Errors  kInvalidArgument.
[[nodiscard]] base::Result<PropertyDefinition> ParsePropertyDefinition(const std::string& text);

// Parses "name=value", see AddOffer(). A property that `type` does not declare gets the type of the
// JSON value: boolean, long, double, string, or a sequence of these.
// Errors  kInvalidArgument.
[[nodiscard]] base::Result<Property> ParseProperty(const std::string& text,
                                                   const ServiceType& type);

}  // namespace gsv::broker
