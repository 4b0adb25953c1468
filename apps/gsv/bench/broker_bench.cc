// `gsv bench broker`: speed of a broker with many offers, in this process and over TCP.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <functional>
#include <iostream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <malloc.h>
#include <time.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/gsv/bench/bench.h"
#include "apps/gsv/machine/child_process.h"
#include "apps/gsv/machine/installation.h"
#include "apps/gsv/process/exit_code.h"
#include "apps/gsv/process/option_values.h"
#include "gsv/base/check.h"
#include "gsv/base/sorting.h"
#include "gsv/base/temporary_folder.h"
#include "gsv/broker/client/broker_client.h"
#include "gsv/broker/storage/offer_file.h"
#include "gsv/broker/trader/trader.h"
#include "gsv/orb/corba_access.h"

namespace gsv::app {
namespace {

using Clock = std::chrono::steady_clock;
using broker::Property;
using broker::Value;
using nlohmann::ordered_json;

constexpr int kClients = 64;
constexpr const char* kType = "BenchRobot";
constexpr const char* kScan = "floor > 2 and battery >= 0.25 and speed < 4.5";
constexpr std::size_t kMaxFound = 10;  // maximum number of offers in the result of a query

// Returns the ten properties of offer `n`, which depend on `n` only.
std::vector<Property> PropertiesOf(std::uint32_t n) {
  const double unit = static_cast<double>(n * 2654435761u) / 4294967296.0;
  return {{"battery", Value::Float(static_cast<float>(unit))},
          {"colour", Value::String(n % 3 == 0   ? "red"
                                   : n % 3 == 1 ? "green"
                                                : "blue")},
          {"floor", Value::Short(static_cast<std::int16_t>(n % 7))},
          {"model", Value::String("pioneer 3-DX")},
          {"name", Value::String("robot " + std::to_string(n))},
          {"online", Value::Boolean(n % 5 != 0)},
          {"serial", Value::ULong(n)},
          {"speed", Value::Double(5 * unit)},
          {"x", Value::Double(100 * unit)},
          {"y", Value::Double(-100 * unit)}};
}

std::string Serial(std::uint32_t n) { return "serial == " + std::to_string(n); }

// The broker calls that are measured. Any number of threads may make them at once.
struct BenchTarget {
  std::function<base::Status(int client, std::uint32_t number)> export_one;
  std::function<base::Status(int client, const std::string& constraint,
                             const std::string& preference)>
      query;
};

// Calls `work` for 0 … count-1 from `clients` threads and returns the duration. Stops at the first
// error.
base::Result<Clock::duration> CallFromThreads(
    int clients, std::uint32_t count,
    const std::function<base::Status(int client, std::uint32_t n)>& work) {
  std::atomic<std::uint32_t> next = 0;
  std::vector<base::Status> ends(static_cast<std::size_t>(clients));
  const auto start = Clock::now();
  {
    std::vector<std::jthread> threads;
    threads.reserve(ends.size());
    for (int client = 0; client < clients; ++client) {
      threads.emplace_back([&, client] {
        base::Status& end = ends[static_cast<std::size_t>(client)];
        for (std::uint32_t n = next++; n < count && end; n = next++) end = work(client, n);
      });
    }
  }
  for (const base::Status& end : ends) {
    if (!end) return base::Fail(end.error());
  }
  return Clock::now() - start;
}

// Returns the `q`-quantile of the durations in ms (nearest rank), such as the median for 0.5.
double Quantile(std::vector<Clock::duration> durations, double q) {
  base::Sort(durations);
  const auto rank = static_cast<std::size_t>(q * static_cast<double>(durations.size()));
  return 1e3 * Seconds(durations[std::min(rank, durations.size() - 1)]);
}

base::Result<std::vector<Clock::duration>> Time(
    int clients, std::uint32_t count,
    const std::function<base::Status(int client, std::uint32_t n)>& work) {
  std::vector<Clock::duration> durations(count);
  const auto duration = CallFromThreads(clients, count, [&](int client, std::uint32_t n) {
    const auto start = Clock::now();
    auto done = work(client, n);
    durations[n] = Clock::now() - start;
    return done;
  });
  if (!duration) return base::Fail(duration.error());
  return durations;
}

// Reads the memory and the processor time of the process that runs the broker.
struct BrokerProcess {
  std::function<double()> bytes_used;
  std::function<double()> processor_time;  // processor time of all its threads, s

  // Returns the mean processor time per call, in ms, of the `count` calls that were made since the
  // processor time was `start` (s).
  double ForEachCall(double start, std::uint32_t count) const {
    return 1e3 * (processor_time() - start) / count;
  }
};

// Measures exports to a broker with a data file, which answers a call only when the offer is on the
// disk.
base::Status MeasureDurable(const BenchTarget& target, std::uint32_t offers,
                            const BrokerProcess& process, ordered_json& figures) {
  const double start = process.processor_time();
  const auto exported = CallFromThreads(kClients, offers, target.export_one);
  if (!exported) return base::Fail(exported.error());
  figures["exports_durable_per_s"] = offers / Seconds(*exported);
  figures["export_durable_cpu_ms"] = process.ForEachCall(start, offers);
  return {};
}

// Measures exports to a broker without a data file, and then queries for these offers.
base::Status Measure(const BenchTarget& target, std::uint32_t offers, const BrokerProcess& process,
                     ordered_json& figures) {
  const double before = process.bytes_used();
  const double export_start = process.processor_time();
  const auto exported = CallFromThreads(kClients, offers, target.export_one);
  if (!exported) return base::Fail(exported.error());
  figures["bytes_per_offer"] = (process.bytes_used() - before) / offers;
  figures["exports_per_s"] = offers / Seconds(*exported);
  figures["export_cpu_ms"] = process.ForEachCall(export_start, offers);

  const auto equal = [&](int client, std::uint32_t n) {
    return target.query(client, Serial((n * 7919) % offers), "");
  };
  if (auto indexed = equal(0, 0); !indexed) return indexed;  // the first query builds the index
  constexpr std::uint32_t kIndexed = 2000, kScans = 40;
  const double indexed_start = process.processor_time();
  const auto alone = Time(1, kIndexed, equal);
  if (!alone) return base::Fail(alone.error());
  figures["query_indexed_p50_ms"] = Quantile(*alone, 0.50);
  figures["query_indexed_p99_ms"] = Quantile(*alone, 0.99);
  figures["query_indexed_cpu_ms"] = process.ForEachCall(indexed_start, kIndexed);
  const double scan_start = process.processor_time();
  const auto scanned = Time(
      1, kScans, [&](int client, std::uint32_t) { return target.query(client, kScan, "min x"); });
  if (!scanned) return base::Fail(scanned.error());
  figures["query_scan_p50_ms"] = Quantile(*scanned, 0.50);
  figures["query_scan_cpu_ms"] = process.ForEachCall(scan_start, kScans);

  const auto start = Clock::now();
  const auto together = Time(kClients, 20'000, equal);
  if (!together) return base::Fail(together.error());
  figures["clients"] = kClients;
  figures["clients_queries_per_s"] = 20'000 / Seconds(Clock::now() - start);
  figures["clients_query_indexed_p99_ms"] = Quantile(*together, 0.99);
  return {};
}

base::Status ToStatus(const broker::TradingError& error) {
  return base::Fail(base::ErrorCode::kInvalidArgument,
                    "the trader refused the call: " + error.detail);
}

BenchTarget TargetOf(broker::Trader& trader, const std::string& reference) {
  return {.export_one = [&trader, reference](int, std::uint32_t n) -> base::Status {
            const auto id = trader.Export(kType, reference, PropertiesOf(n));
            return id ? base::Status() : ToStatus(id.error());
          },
          .query = [&trader](int, const std::string& constraint,
                             const std::string& preference) -> base::Status {
            const auto found =
                trader.Find({.type = kType, .constraint = constraint, .preference = preference});
            return found ? base::Status() : ToStatus(found.error());
          }};
}

std::string ReferenceText(CORBA::ORB_ptr orb) {
  const CORBA::Object_var object = orb->string_to_object("corbaloc::1.2@127.0.0.1:1/BenchRobot");
  const CORBA::String_var text = orb->object_to_string(object);
  return text.in();
}

base::Status MeasureInProcess(CORBA::ORB_ptr orb, std::uint32_t offers, const std::string& folder,
                              ordered_json& figures) {
  const std::string reference = ReferenceText(orb);
  const BrokerProcess process{[] { return static_cast<double>(mallinfo2().uordblks); },
                              [] { return ProcessorTime(); }};
  {
    broker::Trader trader(broker::TraderLimits{}, 1, 1);
    if (auto added = trader.AddType({.name = kType}); !added) return ToStatus(added.error());
    if (auto ok = Measure(TargetOf(trader, reference), offers, process, figures); !ok) return ok;
    figures["bytes_per_offer"] =
        figures["bytes_per_offer"].get<double>() - static_cast<double>(reference.size());
  }
  broker::Trader durable(broker::TraderLimits{}, 1, 1);
  auto file = broker::OfferFile::Open(folder + "/in_process.db", 1);
  if (!file) return base::Fail(file.error());
  auto state = (*file)->Load();
  if (!state) return base::Fail(state.error());
  if (auto ok = durable.Restore(std::move(*state), std::move(*file)); !ok) return ok;
  if (auto added = durable.AddType({.name = kType}); !added) return ToStatus(added.error());
  return MeasureDurable(TargetOf(durable, reference), offers / 5, process, figures);
}

double ResidentBytes(pid_t pid) {
  std::ifstream statm("/proc/" + std::to_string(pid) + "/statm");
  double size = 0;
  double resident = 0;
  statm >> size >> resident;
  return resident * 4096;
}

BrokerProcess ProcessOf(pid_t pid) {
  clockid_t clock{};
  GSV_CHECK(clock_getcpuclockid(pid, &clock) == 0);
  return {[pid] { return ResidentBytes(pid); }, [clock] { return ProcessorTime(clock); }};
}

// A broker in its own process, with one client per thread.
struct Remote {
  std::unique_ptr<ChildProcess> process{};
  std::vector<broker::BrokerClient> clients{};
  CORBA::Object_var service{};

  BenchTarget target() {
    return {.export_one = [this](int client, std::uint32_t n) -> base::Status {
              const auto id =
                  clients[static_cast<std::size_t>(client)].Export(kType, service, PropertiesOf(n));
              return id ? base::Status() : base::Fail(id.error());
            },
            .query = [this](int client, const std::string& constraint,
                            const std::string& preference) -> base::Status {
              const auto found = clients[static_cast<std::size_t>(client)].Query(
                  kType, constraint, preference, kMaxFound);
              return found ? base::Status() : base::Fail(found.error());
            }};
  }
};

base::Result<Remote> StartRemote(CORBA::ORB_ptr orb, const std::vector<std::string>& where) {
  std::vector<std::string> words = {ProgramPath(),       "broker", "--port", "0",
                                    "--liveness-period", "0"};
  words.insert(words.end(), where.begin(), where.end());
  auto process = ChildProcess::Start(words, false);
  if (!process) return base::Fail(process.error());
  Remote remote{.process = std::move(*process)};
  const auto reference = remote.process->ReadLine(std::chrono::seconds(10));
  if (!reference) return base::Fail(base::ErrorCode::kUnavailable, "the broker did not start");
  for (int i = 0; i < kClients; ++i) {
    auto client = broker::BrokerClient::Connect(orb, *reference, std::chrono::seconds(30));
    if (!client) return base::Fail(client.error());
    remote.clients.push_back(std::move(*client));
  }
  if (auto ok = remote.clients[0].EnsureServiceType({.name = kType}); !ok) {
    return base::Fail(ok.error());
  }
  remote.service = orb->string_to_object("corbaloc::1.2@127.0.0.1:1/BenchRobot");
  return remote;
}

base::Status MeasureOverTcp(CORBA::ORB_ptr orb, std::uint32_t offers, const std::string& folder,
                            ordered_json& figures) {
  {
    auto remote = StartRemote(orb, {"--memory"});
    if (!remote) return base::Fail(remote.error());
    const pid_t pid = remote->process->pid();
    if (auto ok = Measure(remote->target(), offers, ProcessOf(pid), figures); !ok) return ok;
    figures["bytes_per_offer"] =
        figures["bytes_per_offer"].get<double>() - static_cast<double>(ReferenceText(orb).size());
    figures["resident_mib"] = ResidentBytes(pid) / (1 << 20);
  }
  auto durable = StartRemote(orb, {"--data", folder + "/tcp.db"});
  if (!durable) return base::Fail(durable.error());
  return MeasureDurable(durable->target(), offers / 5, ProcessOf(durable->process->pid()), figures);
}

base::Status RunBench(std::uint32_t offers, bool json) {
  const auto access = orb::PrepareAccess("127.0.0.1", 0);
  if (!access) return base::Fail(access.error());
  const char* settings[][2] = {{"clientTransportRule", access->client_rules[0]},
                               {"clientTransportRule", access->client_rules[1]},
                               {"maxGIOPConnectionPerServer", "64"},
                               {"traceLevel", "0"},
                               {nullptr, nullptr}};
  int no_arguments = 0;
  const CORBA::ORB_var orb = CORBA::ORB_init(no_arguments, nullptr, "omniORB4", settings);
  const auto folder = base::TemporaryFolder::Make("gsv-bench");
  if (!folder) return base::Fail(folder.error());
  base::Status end;
  for (const bool tcp : {false, true}) {
    ordered_json figures = {{"bench", "broker"},
                            {"where", tcp ? "tcp" : "in_process"},
                            {"offers", offers},
                            {"properties", PropertiesOf(0).size()}};
    end = (tcp ? MeasureOverTcp : MeasureInProcess)(orb, offers, folder->path(), figures);
    if (!end) break;
    std::cout << (json ? figures.dump() : figures.dump(2)) << std::endl;
  }
  return end;
}

}  // namespace

void AddBrokerBench(const CommandLine& bench) {
  struct Arguments {
    std::uint32_t offers = 100'000;
    bool json = false;
  };
  CLI::App* command = bench.app.add_subcommand(
      "broker", "Measure the speed and memory of a broker with many offers");
  auto arguments = std::make_shared<Arguments>();
  command->add_option("--offers", arguments->offers, "number of offers")
      ->type_name("N")
      ->check(Between(1000, 200'000))
      ->capture_default_str();
  command->add_flag("--json", arguments->json, "print one JSON object per line");
  command->callback([arguments, bench] {
    if (const auto end = RunBench(arguments->offers, arguments->json); !end) {
      bench.exit_code = PrintError(end.error());
    }
  });
}

}  // namespace gsv::app
