#include "apps/gsv/servers/scenario_servers.h"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>

#include "gsv/broker/client/corbaloc.h"
#include "gsv/broker/client/gsv_service_types.h"
#include "gsv/orb/errors.h"
#include "gsv/orb/orb.h"

namespace gsv::app {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr std::size_t kMaxScenarioServers = 1000;
// Maximum number of servers that may be lost during one run. The run is repeated on another server
// after each loss.
constexpr int kMaxLostServers = 5;
constexpr seconds kRefreshPeriod{1}, kSilence{10}, kAvoidLost{30}, kWithoutServers{60};
// Longer than the call that waits for the end of a run: the server answers it within two seconds.
constexpr milliseconds kServerCallTimeout{5000};

base::Error NoServers(const std::string& broker, const std::string& constraint) {
  return {base::ErrorCode::kUnavailable,
          "no server is available at the broker that accepts scenarios" +
              (constraint.empty() ? "" : " and matches the constraint: " + constraint) +
              "; start one with gsv serve --scenarios 2 --broker " + broker,
          broker};
}

// Decides from the errors of calls to a server whether the server is lost: ended, or unreachable.
class LostServerCheck {
 public:
  bool IsLostAfter(const base::Error& error) {
    ++failures_;
    // the server was restarted, or dropped the run
    if (error.code == base::ErrorCode::kEnded) return true;
    // A single failed call may mean only that a connection broke. If the next call fails as well,
    // for another reason than a timeout, the server counts as ended.
    if (error.code != base::ErrorCode::kTimeout && failures_ > 1) return true;
    return Clock::now() - heard_ >= kSilence;
  }
  void RecordAnswer() {
    failures_ = 0;
    heard_ = Clock::now();
  }

 private:
  using Clock = std::chrono::steady_clock;
  int failures_ = 0;
  Clock::time_point heard_ = Clock::now();
};

TestResult ResultFrom(const sba::ScenarioOutcome& outcome) {
  TestResult result;
  const std::string status(outcome.status);
  if (status == "passed") result.status = TestResult::Status::kPassed;
  if (status == "failed") result.status = TestResult::Status::kFailed;
  result.message = outcome.message;
  result.wall_seconds = outcome.wall_s;
  result.report = nlohmann::ordered_json::parse(outcome.report.in(), nullptr, false);
  if (!result.report.is_object()) result.report = nlohmann::ordered_json::object();
  result.hashes.push_back(result.report.value("state_hash", ""));
  return result;
}

}  // namespace

base::Result<std::unique_ptr<ScenarioServers>> ScenarioServers::Find(
    const std::string& broker, const std::string& constraint) {
  auto reference = broker::NormaliseReference(broker);
  if (!reference) return base::Fail(reference.error());
  auto orb = orb::StartOrb({});
  if (!orb) return base::Fail(orb.error());
  auto client = broker::BrokerClient::Connect(*orb, *reference);
  if (!client) return base::Fail(client.error());
  std::unique_ptr<ScenarioServers> servers(
      new ScenarioServers(*orb, *std::move(client), constraint));
  if (auto ok = servers->Refresh(); !ok) return base::Fail(ok.error());
  const base::MutexLock lock(servers->mutex_);
  if (servers->servers_.empty()) return base::Fail(NoServers(*reference, constraint));
  return servers;
}

ScenarioServers::~ScenarioServers() {
  servers_.clear();
  orb_->destroy();
}

base::Status ScenarioServers::Refresh() {
  auto offers = broker_.Query(broker::ScenarioServiceType().name, constraint_, "min load",
                              kMaxScenarioServers);
  // kNotFound means that the broker does not know the service type, because no such server has ever
  // registered with it. So there are no offers.
  if (!offers && offers.error().code == base::ErrorCode::kNotFound)
    offers = std::vector<broker::FoundOffer>();
  const base::MutexLock lock(mutex_);
  is_refreshing_ = false;
  refreshed_ = Clock::now();
  if (!offers) return base::Fail(offers.error());
  Merge(*offers);
  return {};
}

void ScenarioServers::Merge(const std::vector<broker::FoundOffer>& offers) {
  std::vector<std::shared_ptr<Server>> known;
  for (const broker::FoundOffer& offer : offers) {
    const CORBA::String_var key = orb_->object_to_string(offer.object);
    const auto found = std::find_if(servers_.begin(), servers_.end(),
                                    [&](const auto& server) { return server->key == key.in(); });
    if (found != servers_.end()) {
      known.push_back(*found);
      continue;
    }
    const auto described = broker::ScenarioServiceOfferFrom(offer.properties);
    auto server = std::make_shared<Server>();
    server->key = key;
    server->name = fmt::format("{} ({}:{})", described.name, described.host, described.pid);
    server->slots = described.slots;
    server->service = sba::ScenarioService::_unchecked_narrow(offer.object);
    orb::LimitCalls(server->service, kServerCallTimeout);
    known.push_back(std::move(server));
  }
  servers_ = std::move(known);
}

std::shared_ptr<ScenarioServers::Server> ScenarioServers::ServerWithMostFreeSlots() {
  const auto now = Clock::now();
  std::shared_ptr<Server> best;
  for (const auto& server : servers_) {
    if (server->given >= server->slots || now < server->avoided_until) continue;
    if (best == nullptr || server->given * best->slots < best->given * server->slots) best = server;
  }
  return best;
}

std::shared_ptr<ScenarioServers::Server> ScenarioServers::Acquire(
    const std::atomic<bool>& is_cancelled) {
  base::MutexLock lock(mutex_);
  if (served_ == Clock::time_point{}) served_ = Clock::now();
  while (!is_cancelled && failure_.empty()) {
    if (!is_refreshing_ && Clock::now() - refreshed_ >= kRefreshPeriod) {
      is_refreshing_ = true;
      lock.unlock();
      (void)Refresh();  // if the broker does not answer, the known servers are used
      lock.lock();
    }
    if (auto server = ServerWithMostFreeSlots()) {
      ++server->given;
      served_ = Clock::now();
      return server;
    }
    const bool is_anybody_there =
        std::any_of(servers_.begin(), servers_.end(), [](const auto& server) {
          return server->given > 0 || Clock::now() >= server->avoided_until;
        });
    if (is_anybody_there) served_ = Clock::now();
    if (Clock::now() - served_ > kWithoutServers) {
      failure_ = NoServers(broker_.reference(), constraint_).Sentence();
    }
    room_.wait_for(lock, milliseconds(500));
  }
  return nullptr;
}

void ScenarioServers::Release(Server& server, Ending ending) {
  const base::MutexLock lock(mutex_);
  --server.given;
  served_ = Clock::now();
  if (ending == Ending::kNoFreeSlot) server.avoided_until = Clock::now() + kRefreshPeriod;
  if (ending == Ending::kLost) {
    if (Clock::now() >= server.avoided_until) {
      std::fprintf(stderr,
                   "gsv: warning: lost the connection to %s; other servers execute its runs\n",
                   server.name.c_str());
    }
    server.avoided_until = Clock::now() + kAvoidLost;
  }
  room_.notify_one();
}

TestResult ScenarioServers::Run(const std::string& scenario, double timeout,
                                const std::atomic<bool>& is_cancelled) {
  TestResult result;
  for (int lost = 0; lost < kMaxLostServers;) {
    const auto server = Acquire(is_cancelled);
    if (server == nullptr) {
      result.status = TestResult::Status::kInterrupted;
      return result;
    }
    const Ending ending = RunAt(*server, scenario, timeout, is_cancelled, result);
    Release(*server, ending);
    if (ending == Ending::kDone) return result;
    lost += ending == Ending::kLost;
  }
  result.message = fmt::format(
      "{} servers ended, one after the other, during this run; the run may be the cause",
      kMaxLostServers);
  return result;
}

ScenarioServers::Ending ScenarioServers::RunAt(Server& server, const std::string& scenario,
                                               double timeout,
                                               const std::atomic<bool>& is_cancelled,
                                               TestResult& result) {
  sba::NameValues options;
  options.length(1);
  options[0].name = "timeout_s";
  options[0].value = fmt::format("{}", timeout).c_str();
  const auto started = orb::Call(server.name, [&] {
    return sba::ScenarioRun_var(server.service->run(scenario.c_str(), options));
  });
  if (!started && started.error().code == base::ErrorCode::kInvalidArgument) {
    result.message = started.error().Sentence();  // another server would refuse it, too
    return Ending::kDone;
  }
  if (!started) return Ending::kLost;
  const sba::ScenarioRun_var& run = *started;
  if (CORBA::is_nil(run)) return Ending::kNoFreeSlot;
  orb::LimitCalls(run, kServerCallTimeout);
  LostServerCheck lost_check;
  while (!is_cancelled) {
    const auto outcome = orb::Call(server.name, [&]() -> std::unique_ptr<TestResult> {
      if (!run->await_end()) return nullptr;
      const sba::ScenarioOutcome_var ended = run->outcome();
      return std::make_unique<TestResult>(ResultFrom(ended));
    });
    if (!outcome) {
      if (lost_check.IsLostAfter(outcome.error())) return Ending::kLost;
      continue;
    }
    lost_check.RecordAnswer();
    if (*outcome == nullptr) continue;
    result = std::move(**outcome);
    // if this fails, the server drops the run after a time
    (void)orb::Call(server.name, [&] { run->destroy(); });
    return Ending::kDone;
  }
  (void)orb::Call(server.name, [&] { run->destroy(); });
  result.status = TestResult::Status::kInterrupted;
  return Ending::kDone;
}

std::string ScenarioServers::failure() const {
  const base::MutexLock lock(mutex_);
  return failure_;
}

}  // namespace gsv::app
