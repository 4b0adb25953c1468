#include "apps/gsv/commands/broker_listing_commands.h"

#include <algorithm>
#include <functional>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/gsv/machine/running_instances.h"
#include "apps/gsv/process/exit_code.h"
#include "apps/gsv/process/option_values.h"
#include "gsv/base/named.h"
#include "gsv/broker/client/broker_administration.h"
#include "gsv/broker/client/offer_listing.h"

namespace gsv::app {
namespace {

// A command that lists by default, with the subcommands `list`, `add` and `remove`.
struct Listing {
  CLI::App* list = nullptr;
  CLI::App* add = nullptr;
  CLI::App* remove = nullptr;
  std::string broker;
  bool json = false;
  std::string name;  // name of the added or removed object
};

struct Actions {
  std::function<base::Status()> list;
  std::function<base::Status()> add;
  std::function<base::Status()> remove;
};

// If `broker` is empty, sets it to the broker of this user's newest instance of gsv.
base::Status FindBroker(std::string& broker) {
  if (!broker.empty()) return {};
  const std::vector<Instance> instances = RunningInstances();
  if (instances.empty()) {
    return base::Fail(base::ErrorCode::kUnavailable,
                      "no gsv of this user is running, so no broker is known; give the address "
                      "of a broker with --broker");
  }
  broker = instances.front().broker;
  return {};
}

template <typename Arguments>
std::shared_ptr<Arguments> AddListing(const CommandLine& line, const char* name,
                                      const char* description, const char* one,
                                      Actions (*actions_of)(const Arguments&)) {
  CLI::App* command = line.app.add_subcommand(name, description);
  auto arguments = std::make_shared<Arguments>();
  command
      ->add_option("--broker", arguments->broker,
                   "broker (default: that of your newest running gsv)\n"
                   "The address has the form corbaloc::1.2@HOST:PORT/TradingService.")
      ->type_name("ADDRESS")
      ->envname("GSV_BROKER");
  command->add_flag("--json", arguments->json, "print one JSON object per line");
  const std::string which(one);
  arguments->list = command->add_subcommand("list", "List all " + std::string(name) + " (default)");
  arguments->add = command->add_subcommand("add", "Add " + which);
  arguments->remove = command->add_subcommand("remove", "Remove " + which);
  for (CLI::App* sub : {arguments->list, arguments->add, arguments->remove}) sub->fallthrough();
  command->require_subcommand(0, 1);
  command->callback([arguments, line, actions_of] {
    if (auto found = FindBroker(arguments->broker); !found) {
      line.exit_code = PrintError(found.error());
      return;
    }
    const Actions actions = actions_of(*arguments);
    const auto& action = arguments->add->parsed()      ? actions.add
                         : arguments->remove->parsed() ? actions.remove
                                                       : actions.list;
    if (const auto done = action(); !done) line.exit_code = PrintError(done.error());
  });
  return arguments;
}

// `print` and `print_json` write the listed objects.
template <typename Listed, typename Print>
base::Status Show(const base::Result<Listed>& listed, bool json, const Print& print,
                  const Print& print_json) {
  if (!listed) return base::Fail(listed.error());
  (json ? print_json : print)(*listed, std::cout);
  return {};
}

struct OfferArguments : Listing {
  std::string type;
  std::string reference;
  std::vector<std::string> properties;
};

Actions OfferActions(const OfferArguments& arguments) {
  const broker::BrokerAdministration administration(arguments.broker);
  return {.list =
              [&arguments] {
                return Show(broker::ListOffers(arguments.broker), arguments.json,
                            &broker::PrintOffers, &broker::PrintOffersJson);
              },
          .add = [&arguments, administration]() -> base::Status {
            const auto id =
                administration.AddOffer(arguments.type, arguments.reference, arguments.properties);
            if (!id) return base::Fail(id.error());
            std::cout << (arguments.json ? nlohmann::json{{"id", *id}}.dump() : *id) << "\n";
            return {};
          },
          .remove = [&arguments,
                     administration] { return administration.RemoveOffer(arguments.name); }};
}

struct TypeArguments : Listing {
  std::string interface_name;
  std::vector<std::string> super_types;
  std::vector<std::string> properties;
};

base::Status AddType(const TypeArguments& arguments) {
  broker::ServiceType type{.name = arguments.name,
                           .interface_name = arguments.interface_name,
                           .super_types = arguments.super_types};
  for (const std::string& text : arguments.properties) {
    auto definition = broker::ParsePropertyDefinition(text);
    if (!definition) return base::Fail(definition.error());
    type.properties.push_back(std::move(*definition));
  }
  return broker::BrokerAdministration(arguments.broker).AddServiceType(type);
}

Actions TypeActions(const TypeArguments& arguments) {
  return {
      .list =
          [&arguments] {
            return Show(broker::ListServiceTypes(arguments.broker), arguments.json,
                        &broker::PrintServiceTypes, &broker::PrintServiceTypesJson);
          },
      .add = [&arguments] { return AddType(arguments); },
      .remove =
          [&arguments] {
            return broker::BrokerAdministration(arguments.broker).RemoveServiceType(arguments.name);
          }};
}

constexpr base::Named<broker::FollowOption> kFollowOptions[] = {
    {"local_only", broker::FollowOption::kLocalOnly},
    {"if_no_local", broker::FollowOption::kIfNoLocal},
    {"always", broker::FollowOption::kAlways}};

struct LinkArguments : Listing {
  std::string target;
  std::string pass_on = "always", limit = "always";
};

Actions LinkActions(const LinkArguments& arguments) {
  const broker::BrokerAdministration administration(arguments.broker);
  return {
      .list =
          [&arguments, administration] {
            return Show(administration.ListLinks(), arguments.json, &broker::PrintLinks,
                        &broker::PrintLinksJson);
          },
      .add =
          [&arguments, administration] {
            const auto pass_on = *base::FindNamed(kFollowOptions, arguments.pass_on);
            const auto limit = *base::FindNamed(kFollowOptions, arguments.limit);
            return administration.AddLink(arguments.name, arguments.target,
                                          std::min(pass_on, limit), limit);
          },
      .remove = [&arguments, administration] { return administration.RemoveLink(arguments.name); }};
}

}  // namespace

void AddOffersCommand(const CommandLine& line) {
  const auto arguments = AddListing<OfferArguments>(
      line, "offers", "List, add and remove offers of a broker", "an offer", &OfferActions);
  arguments->add->add_option("TYPE", arguments->type, "service type of the offer")->required();
  arguments->add
      ->add_option("REFERENCE", arguments->reference,
                   "object reference of the service, IOR:... or corbaloc:...")
      ->required();
  arguments->add
      ->add_option("--property", arguments->properties,
                   "property of the offer, with its value as JSON; text needs no quotes")
      ->type_name("NAME=VALUE");
  arguments->remove->add_option("ID", arguments->name, "id of the offer")->required();
}

void AddTypesCommand(const CommandLine& line) {
  const auto arguments =
      AddListing<TypeArguments>(line, "types", "List, add and remove service types of a broker",
                                "a service type", &TypeActions);
  arguments->add->add_option("NAME", arguments->name, "name of the service type")->required();
  arguments->add
      ->add_option("--interface", arguments->interface_name,
                   "interface that offered services must have, IDL:...")
      ->type_name("ID");
  arguments->add->add_option("--super", arguments->super_types, "super type of the service type")
      ->type_name("NAME");
  arguments->add
      ->add_option(
          "--property", arguments->properties,
          "property in the form [mandatory] [readonly] TYPE NAME, as `gsv types` prints it")
      ->type_name("PROPERTY");
  arguments->remove->add_option("NAME", arguments->name, "name of the service type")->required();
}

void AddLinksCommand(const CommandLine& line) {
  const auto arguments = AddListing<LinkArguments>(
      line, "links", "List, add and remove links of a broker to other brokers", "a link",
      &LinkActions);
  const CLI::Validator is_follow_option = OneOf({"local_only", "if_no_local", "always"});
  arguments->add->add_option("NAME", arguments->name, "name of the link")->required();
  arguments->add
      ->add_option("TARGET", arguments->target,
                   "other broker, corbaloc::1.2@HOST:PORT/TradingService")
      ->required();
  arguments->add
      ->add_option("--pass-on", arguments->pass_on,
                   "link policy that the other broker applies if the importer sets none")
      ->check(is_follow_option)
      ->type_name("local_only|if_no_local|always")
      ->default_str("always");
  arguments->add
      ->add_option("--limit", arguments->limit,
                   "strongest link policy that queries through this link may use")
      ->check(is_follow_option)
      ->type_name("local_only|if_no_local|always")
      ->default_str("always");
  arguments->remove->add_option("NAME", arguments->name, "name of the link")->required();
}

}  // namespace gsv::app
