// Changes a broker's links, service types and offers, and lists its links, for `gsv links`,
// `gsv types` and `gsv offers`.
// All calls use the process's ORB, and start one if there is none.
// Errors  see BrokerClient; kUnavailable when the broker has no links.
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
  std::string address;  // "host:port" of the other trader; empty when it has none on TCP
  FollowOption def_pass_on = FollowOption::kAlways;
  FollowOption limiting = FollowOption::kAlways;
  bool answers = false;  // it answered a call within a second
};

// "local_only", "if_no_local", "always".
std::string_view Spelling(FollowOption option);

class BrokerAdministration {
 public:
  explicit BrokerAdministration(std::string broker,
                                std::chrono::milliseconds timeout = std::chrono::seconds(5))
      : broker_(std::move(broker)), timeout_(timeout) {}

  // The links by name. This process calls each target; the broker does not.
  [[nodiscard]] base::Result<std::vector<LinkDescription>> ListLinks() const;
  // `target`: another broker's address. If it is an "IOR:…" with a type id, the other broker need
  // not answer.
  [[nodiscard]] base::Status AddLink(const std::string& name, const std::string& target,
                                     FollowOption def_pass_on, FollowOption limiting) const;
  [[nodiscard]] base::Status RemoveLink(const std::string& name) const;

  [[nodiscard]] base::Status AddServiceType(const ServiceType& type) const;
  [[nodiscard]] base::Status RemoveServiceType(const std::string& name) const;

  // `properties`: "name=value" with the value as JSON, read as the type that the service type
  // declares; text needs no quotes. Returns the offer's id.
  [[nodiscard]] base::Result<std::string> AddOffer(
      const std::string& type, const std::string& reference,
      const std::vector<std::string>& properties) const;
  [[nodiscard]] base::Status RemoveOffer(const std::string& id) const;

 private:
  const std::string broker_;
  const std::chrono::milliseconds timeout_;
};

void PrintLinks(const std::vector<LinkDescription>& links, std::ostream& out);
// {"name":…, "address":…, "def_pass_on_follow_rule":…, "limiting_follow_rule":…, "answers":…} a
// line.
void PrintLinksJson(const std::vector<LinkDescription>& links, std::ostream& out);

// "mandatory readonly sequence<string> name", as PrintServiceTypes writes it.
// Errors  kInvalidArgument.
[[nodiscard]] base::Result<PropertyDefinition> ParsePropertyDefinition(const std::string& text);

// "name=value", see AddOffer. A property that `type` does not declare has the type that JSON
// says: boolean, long, double, string, or a sequence of these.
// Errors  kInvalidArgument.
[[nodiscard]] base::Result<Property> ParseProperty(const std::string& text,
                                                   const ServiceType& type);

}  // namespace gsv::broker
