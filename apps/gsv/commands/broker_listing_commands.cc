#include "apps/gsv/commands/broker_listing_commands.h"

#include <algorithm>
#include <functional>
#include <iostream>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/gsv/process/exit_code.h"
#include "gsv/broker/client/broker_administration.h"
#include "gsv/broker/client/offer_listing.h"

namespace gsv::app {
namespace {

// A command that lists without a word more; `list`, `add` and `remove` are its subcommands.
struct Listing {
  CLI::App* list = nullptr;
  CLI::App* add = nullptr;
  CLI::App* remove = nullptr;
  std::string broker;
  bool json = false;
  std::string name;  // of what is added or removed
};

struct Actions {
  std::function<base::Status()> list;
  std::function<base::Status()> add;
  std::function<base::Status()> remove;
};

template <typename Arguments>
std::shared_ptr<Arguments> AddListing(const CommandLine& line, const char* name,
                                      const char* description, const char* one,
                                      Actions (*actions_of)(const Arguments&)) {
  CLI::App* command = line.app.add_subcommand(name, description);
  auto arguments = std::make_shared<Arguments>();
  command
      ->add_option("--broker", arguments->broker,
                   "the broker, corbaloc::1.2@HOST:PORT/TradingService")
      ->envname("GSV_BROKER")
      ->required();
  command->add_flag("--json", arguments->json, "one JSON object a line");
  const std::string which(one);
  arguments->list = command->add_subcommand("list", "List them; so does no subcommand");
  arguments->add = command->add_subcommand("add", "Add " + which);
  arguments->remove = command->add_subcommand("remove", "Remove " + which);
  for (CLI::App* sub : {arguments->list, arguments->add, arguments->remove}) sub->fallthrough();
  command->require_subcommand(0, 1);
  command->callback([arguments, line, actions_of] {
    const Actions actions = actions_of(*arguments);
    const auto& action = arguments->add->parsed()      ? actions.add
                         : arguments->remove->parsed() ? actions.remove
                                                       : actions.list;
    if (const auto done = action(); !done) line.exit_code = Complain(done.error());
  });
  return arguments;
}

// `print` and `print_json` write what was listed.
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

struct LinkArguments : Listing {
  std::string target;
  broker::FollowOption pass_on = broker::FollowOption::kAlways;
  broker::FollowOption limit = broker::FollowOption::kAlways;
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
            return administration.AddLink(arguments.name, arguments.target,
                                          std::min(arguments.pass_on, arguments.limit),
                                          arguments.limit);
          },
      .remove = [&arguments, administration] { return administration.RemoveLink(arguments.name); }};
}

}  // namespace

void AddOffersCommand(const CommandLine& line) {
  const auto arguments = AddListing<OfferArguments>(
      line, "offers", "What is offered at a broker: list, add, remove", "an offer", &OfferActions);
  arguments->add->add_option("TYPE", arguments->type, "its service type")->required();
  arguments->add->add_option("REFERENCE", arguments->reference, "the service, IOR:… or corbaloc:…")
      ->required();
  arguments->add
      ->add_option("--property", arguments->properties,
                   "a property, with the value as JSON; text needs no quotes")
      ->type_name("NAME=VALUE");
  arguments->remove->add_option("ID", arguments->name, "the offer's id")->required();
}

void AddTypesCommand(const CommandLine& line) {
  const auto arguments =
      AddListing<TypeArguments>(line, "types", "The service types of a broker: list, add, remove",
                                "a service type", &TypeActions);
  arguments->add->add_option("NAME", arguments->name, "its name")->required();
  arguments->add
      ->add_option("--interface", arguments->interface_name,
                   "the interface that offered services must have, IDL:…")
      ->type_name("ID");
  arguments->add->add_option("--super", arguments->super_types, "a super type")->type_name("NAME");
  arguments->add
      ->add_option("--property", arguments->properties,
                   "a property as `gsv types` shows it: [mandatory] [readonly] TYPE NAME")
      ->type_name("PROPERTY");
  arguments->remove->add_option("NAME", arguments->name, "its name")->required();
}

void AddLinksCommand(const CommandLine& line) {
  const auto arguments = AddListing<LinkArguments>(
      line, "links", "A broker's links to others: list, add, remove", "a link", &LinkActions);
  const std::map<std::string, broker::FollowOption> rules = {
      {"local_only", broker::FollowOption::kLocalOnly},
      {"if_no_local", broker::FollowOption::kIfNoLocal},
      {"always", broker::FollowOption::kAlways}};
  arguments->add->add_option("NAME", arguments->name, "its name")->required();
  arguments->add
      ->add_option("TARGET", arguments->target,
                   "the other broker, corbaloc::1.2@HOST:PORT/TradingService")
      ->required();
  arguments->add
      ->add_option("--pass-on", arguments->pass_on,
                   "what the other broker does with its links when the importer says nothing: "
                   "local_only, if_no_local, or always")
      ->transform(CLI::CheckedTransformer(rules));
  arguments->add
      ->add_option("--limit", arguments->limit,
                   "the most that is done with this link: local_only, if_no_local, or always")
      ->transform(CLI::CheckedTransformer(rules));
  arguments->remove->add_option("NAME", arguments->name, "its name")->required();
}

}  // namespace gsv::app
