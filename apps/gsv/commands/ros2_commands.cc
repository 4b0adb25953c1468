#include <algorithm>
#include <chrono>
#include <cstdio>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/gsv/commands/commands.h"
#include "apps/gsv/process/exit_code.h"
#include "apps/gsv/process/option_values.h"
#include "apps/gsv/serving/ros2_access.h"
#include "gsv/base/mutex.h"
#include "gsv/base/spelling.h"
#include "gsv/messages/all.h"
#include "gsv/messages/definition.h"
#include "gsv/ros2/graph.h"
#include "gsv/ros2/names.h"
#include "gsv/ros2/topic_problems.h"

namespace gsv::app {
namespace {

using ros2::dds::Endpoint;
using ros2::dds::Participant;
using SteadyClock = std::chrono::steady_clock;

struct Ros2CommandArguments {
  std::string range, topic;
  double seconds = 3;  // wall-clock time, s
  long count = 0;      // number of messages; 0: no limit
};

base::Result<ros2::dds::ParticipantOptions> Reach(const Ros2CommandArguments& arguments) {
  ros2::Options options;
  if (!arguments.range.empty()) {
    const auto range = ros2::ParseRange(arguments.range);
    if (!range) {
      return base::Fail(base::ErrorCode::kInvalidArgument, range.error().message, "--ros2-range");
    }
    options.range = *range;
  }
  auto reach = ros2::ParticipantFor(options, ros2::ProcessEnvironment);
  if (!reach) return base::Fail(reach.error());
  reach->watches_endpoints = true;
  return reach;
}

base::Result<std::unique_ptr<Participant>> Join(const Ros2CommandArguments& arguments) {
  const auto reach = Reach(arguments);
  if (!reach) return base::Fail(reach.error());
  return MakeParticipant(*reach);
}

// Waits for the duration of the observation. Returns false if a signal ended the wait.
bool Look(const Ros2CommandArguments& arguments, Signals& signals) {
  return signals.WaitFor(static_cast<int>(arguments.seconds * 1000)) == 0;
}

void PrintNothingFound(const char* what, const Ros2CommandArguments& arguments) {
  const auto reach = Reach(arguments);
  std::printf("no ROS 2 %s was found in %g s (%s)\n", what, arguments.seconds,
              reach ? DescribeReach(*reach).c_str() : "");
}

int Topics(const Ros2CommandArguments& arguments, Signals& signals) {
  const auto participant = Join(arguments);
  if (!participant) return PrintError(participant.error());
  if (!Look(arguments, signals)) return kInterrupted;
  struct Ends {
    int writers = 0, readers = 0;
  };
  std::map<std::pair<std::string, std::string>, Ends> topics;
  for (const Endpoint& endpoint : (*participant)->endpoints()) {
    const std::string name = ros2::RosTopicName(endpoint.topic.name);
    if (name.empty()) continue;
    Ends& ends = topics[{name, ros2::RosTypeName(endpoint.topic.type)}];
    ++(endpoint.is_writer ? ends.writers : ends.readers);
  }
  for (const auto& [topic, ends] : topics) {
    std::printf("%s [%s] publishers: %d, subscriptions: %d\n", topic.first.c_str(),
                topic.second.c_str(), ends.writers, ends.readers);
  }
  if (topics.empty()) PrintNothingFound("topic", arguments);
  return kOk;
}

int Nodes(const Ros2CommandArguments& arguments, Signals& signals) {
  const auto participant = Join(arguments);
  if (!participant) return PrintError(participant.error());
  base::Mutex mutex;
  std::map<std::string, std::pair<std::size_t, std::size_t>> nodes;  // writers, readers
  const auto reader = (*participant)
                          ->MakeReader({"ros_discovery_info",
                                        "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_",
                                        {.is_transient_local = true, .depth = 100},
                                        {}},
                                       [&](std::span<const std::byte> sample) {
                                         const auto found = ros2::DecodeGraph(sample);
                                         if (!found) return;
                                         const base::MutexLock lock(mutex);
                                         for (const ros2::NodeInfo& node : *found) {
                                           nodes[ros2::InNamespace(node.name_space, node.name)] = {
                                               node.writers.size(), node.readers.size()};
                                         }
                                       });
  if (!reader) return PrintError(reader.error());
  if (!Look(arguments, signals)) return kInterrupted;
  const base::MutexLock lock(mutex);
  for (const auto& [name, ends] : nodes) {
    std::printf("%s publishers: %zu, subscriptions: %zu\n", name.c_str(), ends.first, ends.second);
  }
  if (nodes.empty()) PrintNothingFound("node", arguments);
  return kOk;
}

// Finds the topic. Returns it with the strictest QoS that all its publishers offer.
base::Result<ros2::dds::Topic> Find(const Participant& participant,
                                    const Ros2CommandArguments& arguments, Signals& signals) {
  const std::string name = ros2::DdsTopicName(arguments.topic);
  const auto give_up = SteadyClock::now() + std::chrono::duration<double>(arguments.seconds);
  do {
    std::optional<ros2::dds::Topic> topic;
    for (const Endpoint& endpoint : participant.endpoints()) {
      if (!endpoint.is_writer || endpoint.topic.name != name) continue;
      if (!topic) topic = endpoint.topic;
      topic->qos.is_reliable = topic->qos.is_reliable && endpoint.topic.qos.is_reliable;
      topic->qos.is_transient_local =
          topic->qos.is_transient_local && endpoint.topic.qos.is_transient_local;
    }
    if (topic) {
      topic->user_data.clear();
      return *topic;
    }
    if (signals.WaitFor(50) != 0) {
      return base::Fail(base::ErrorCode::kEnded, "interrupted", arguments.topic);
    }
  } while (SteadyClock::now() < give_up);
  std::vector<std::string> published;
  for (const Endpoint& endpoint : participant.endpoints()) {
    if (endpoint.is_writer) published.push_back(ros2::RosTopicName(endpoint.topic.name));
  }
  return base::Fail(base::ErrorCode::kNotFound,
                    "nobody publishes this topic; `gsv ros2 topics` lists the topics" +
                        base::DidYouMean(arguments.topic, published),
                    arguments.topic);
}

base::Result<messages::Definition> DefinitionOf(const std::string& type) {
  for (const messages::Schema& schema : messages::AllSchemas()) {
    if (schema.name == type) return messages::Definition::Parse(schema.name, schema.text);
  }
  return base::Fail(base::ErrorCode::kNotFound, "gsv does not support this message type", type);
}

// A queue of the messages that have arrived on a topic.
class Inbox {
 public:
  static constexpr std::size_t kMaxWaiting = 1000;

  void Put(std::span<const std::byte> sample) {
    const base::MutexLock lock(mutex_);
    ++count_;
    if (waiting_.size() < kMaxWaiting) waiting_.emplace_back(sample.begin(), sample.end());
  }
  std::vector<messages::Bytes> Take() {
    const base::MutexLock lock(mutex_);
    return std::exchange(waiting_, {});
  }
  std::size_t count() {
    const base::MutexLock lock(mutex_);
    return count_;
  }

 private:
  base::Mutex mutex_;
  std::vector<messages::Bytes> waiting_ GSV_GUARDED_BY(mutex_);
  std::size_t count_ GSV_GUARDED_BY(mutex_) = 0;
};

int Echo(const Ros2CommandArguments& arguments, Signals& signals) {
  const auto participant = Join(arguments);
  if (!participant) return PrintError(participant.error());
  const auto topic = Find(**participant, arguments, signals);
  if (!topic) return PrintError(topic.error());
  const auto definition = DefinitionOf(ros2::RosTypeName(topic->type));
  if (!definition) return PrintError(definition.error());
  Inbox inbox;
  const auto reader = (*participant)->MakeReader(*topic, [&](auto sample) { inbox.Put(sample); });
  if (!reader) return PrintError(reader.error());
  long count = 0;
  while (arguments.count == 0 || count < arguments.count) {
    for (const messages::Bytes& bytes : inbox.Take()) {
      const auto message = definition->Decode(bytes);
      if (!message) return PrintError(message.error());
      std::puts(message->dump(-1, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
      if (++count == arguments.count) break;
    }
    std::fflush(stdout);
    if (signals.WaitFor(10) != 0) return kOk;
  }
  return kOk;
}

int Hz(const Ros2CommandArguments& arguments, Signals& signals) {
  const auto participant = Join(arguments);
  if (!participant) return PrintError(participant.error());
  const auto topic = Find(**participant, arguments, signals);
  if (!topic) return PrintError(topic.error());
  Inbox inbox;
  const auto reader = (*participant)->MakeReader(*topic, [&](auto sample) { inbox.Put(sample); });
  if (!reader) return PrintError(reader.error());
  while (inbox.count() == 0) {
    if (signals.WaitFor(10) != 0) return kInterrupted;
  }
  const std::size_t first = inbox.count();
  const auto begin = SteadyClock::now();
  if (!Look(arguments, signals)) return kInterrupted;
  const double passed = std::chrono::duration<double>(SteadyClock::now() - begin).count();
  std::printf("%.1f Hz over %.1f s of wall-clock time\n",
              static_cast<double>(inbox.count() - first) / passed, passed);
  return kOk;
}

// Prints the number of participants, topics and endpoints in the domain, and the reasons why
// publishers and subscriptions do not match.
int Examine(const Ros2CommandArguments& arguments, Signals& signals) {
  const auto reach = Reach(arguments);
  if (!reach) return PrintError(reach.error());
  const auto participant = MakeParticipant(*reach);
  if (!participant) return PrintError(participant.error());
  std::printf("%s\n", DescribeReach(*reach).c_str());
  std::fflush(stdout);
  if (!Look(arguments, signals)) return kInterrupted;
  const std::vector<Endpoint> endpoints = (*participant)->endpoints();
  std::set<std::string> participants, topics;
  for (const Endpoint& endpoint : endpoints) {
    participants.emplace(endpoint.guid.begin(), endpoint.guid.begin() + 12);
    topics.insert(endpoint.topic.name);
  }
  std::printf("participants: %zu, topics and services: %zu, publishers and subscriptions: %zu\n",
              participants.size(), topics.size(), endpoints.size());
  if (participants.empty()) {
    std::printf(
        "problem: no node was found in %g s. Compare ROS_DOMAIN_ID and the range of discovery "
        "with those of the other nodes\n",
        arguments.seconds);
    return kInfrastructure;
  }
  const std::vector<std::string> problems = ros2::FindTopicProblems(endpoints);
  for (const std::string& problem : problems) std::printf("problem: %s\n", problem.c_str());
  if (problems.empty()) std::printf("no problems found\n");
  return problems.empty() ? kOk : kInfrastructure;
}

using Ros2Command = int (*)(const Ros2CommandArguments&, Signals&);

CLI::App* AddOne(CLI::App& parent, const CommandLine& line,
                 const std::shared_ptr<Ros2CommandArguments>& arguments, const char* name,
                 const char* help, bool has_topic, Ros2Command run) {
  CLI::App* const command = parent.add_subcommand(name, help);
  command
      ->add_option("--ros2-range", arguments->range,
                   "range of discovery (default: localhost)\n"
                   "Without this option, ROS_LOCALHOST_ONLY, ROS_AUTOMATIC_DISCOVERY_RANGE and "
                   "ROS_STATIC_PEERS apply. With subnet, ROS_STATIC_PEERS applies too.")
      ->type_name("localhost|subnet");
  const bool echoes = std::string(name) == "echo";
  command
      ->add_option("--seconds", arguments->seconds,
                   echoes ? "wall-clock time limit for finding the topic"
                          : "wall-clock time of the observation")
      ->type_name("SECONDS")
      ->check(Between(0.1, 3600.0))
      ->capture_default_str();
  if (has_topic) {
    command->add_option("topic", arguments->topic, "topic, such as /pebble/odom")
        ->type_name("TOPIC")
        ->required();
  }
  command->callback([=] { line.exit_code = run(*arguments, line.signals); });
  return command;
}

}  // namespace

void AddRos2Commands(const CommandLine& line) {
  CLI::App* const ros2 =
      line.app.add_subcommand("ros2", "Inspect ROS 2 topics and nodes, without ROS");
  ros2->require_subcommand(1);
  const auto arguments = std::make_shared<Ros2CommandArguments>();
  AddOne(*ros2, line, arguments, "topics", "List topics, their types and endpoints", false,
         &Topics);
  AddOne(*ros2, line, arguments, "nodes", "List nodes", false, &Nodes);
  CLI::App* const echo =
      AddOne(*ros2, line, arguments, "echo", "Print the messages of a topic as JSON", true, &Echo);
  echo->get_option("--seconds")->description("maximum wall-clock time of the search for the topic");
  echo->add_option("--count", arguments->count,
                   "number of messages to print (default: print until Ctrl-C)")
      ->type_name("N")
      ->check(CLI::PositiveNumber);
  AddOne(*ros2, line, arguments, "hz", "Measure the rate of a topic", true, &Hz);
  AddOne(*ros2, line, arguments, "doctor",
         "Find types and QoS that prevent nodes from communicating", false, &Examine);
}

}  // namespace gsv::app
