#include "apps/gsv/servers/scenario_service.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <optional>

#include <fmt/format.h>

#include "apps/gsv/trials/test_cases.h"
#include "gsv/base/log.h"
#include "gsv/base/temporary_folder.h"
#include "gsv/orb/errors.h"
#include "gsv/scenario/scenario_file.h"
#include "gsv/services/conversions.h"

namespace gsv::app {
namespace {

using RunClock = std::chrono::steady_clock;
using RunSeconds = std::chrono::duration<double>;

constexpr std::chrono::milliseconds kRunLease{2000};
constexpr double kDefaultTimeout = 300, kDefaultAbandoned = 60;  // wall-clock time, s
// maximum number of stored runs, including those whose outcome no client has fetched
constexpr std::size_t kMaxKept = 1000;

// Checks that a server can run the scenario. Otherwise throws Refused with the reason.
void RefuseUnlessRunnable(const std::string& text) {
  base::Problems problems;
  const auto scenario = orb::ValueOrThrow(scenario::ParseScenario(text, "scenario", problems),
                                          orb::kRefused | orb::kFailed);
  for (const base::Problem& problem : problems) {
    if (problem.severity == base::Problem::Severity::kError)
      throw sba::Refused(problem.Sentence().c_str());
  }
  if (scenario.duration.value_or(0) <= 0)
    throw sba::Refused("the scenario needs an end: set duration, in simulated seconds");
  if (!scenario.record.empty())
    throw sba::Refused("a server does not record scenarios of campaigns; remove record");
}

double SecondsOption(const model::Parameters& options, const char* name, double otherwise) {
  const auto found = options.find(name);
  if (found == options.end()) return otherwise;
  const double* value = std::get_if<double>(&found->second);
  if (value != nullptr && *value >= 1 && *value <= 1e6) return *value;
  throw sba::Refused(fmt::format("{} must be a number from 1 to 1e6", name).c_str());
}

const char* StatusText(TestResult::Status status) {
  switch (status) {
    case TestResult::Status::kPassed:
      return "passed";
    case TestResult::Status::kFailed:
      return "failed";
    default:
      return "error";
  }
}

}  // namespace

class ScenarioRunServant final : public POA_sba::ScenarioRun {
 public:
  ScenarioRunServant(ScenarioServiceServant& service, std::string scenario, double timeout,
                     double abandoned_after)
      : service_(service),
        scenario_(std::move(scenario)),
        timeout_(timeout),
        abandoned_after_(abandoned_after),
        thread_([this] { Work(); }) {}
  ~ScenarioRunServant() override { Cancel(); }

  CORBA::Boolean await_end() override {
    NoteCall();
    base::MutexLock lock(mutex_);
    const bool is_over = ended_.wait_for(
        lock, kRunLease, [this]() GSV_REQUIRES(mutex_) { return result_.has_value(); });
    if (is_over) ThrowIfAborted();
    return is_over;
  }

  sba::ScenarioOutcome* outcome() override {
    NoteCall();
    const base::MutexLock lock(mutex_);
    if (!result_) throw sba::NotRunning("the scenario is still running");
    ThrowIfAborted();
    auto* outcome = new sba::ScenarioOutcome;
    outcome->status = StatusText(result_->status);
    outcome->message = result_->message.c_str();
    outcome->report =
        result_->report.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace)
            .c_str();
    outcome->wall_s = result_->wall_seconds;
    return outcome;
  }

  void destroy() override {
    Cancel();
    is_destroyed_ = true;
    service_.Forget(this);
  }

  void Cancel() { is_cancelled_ = true; }
  bool is_running() const {
    const base::MutexLock lock(mutex_);
    return !result_;
  }
  bool IsAbandoned() const {
    return RunClock::now().time_since_epoch() - last_call_.load() > RunSeconds(abandoned_after_);
  }

 private:
  // Throws sba::Ended if the server has aborted the run, because the run then has no outcome.
  void ThrowIfAborted() const GSV_REQUIRES(mutex_) {
    if (result_->status == TestResult::Status::kInterrupted)
      throw sba::Ended("the server aborted the scenario");
  }
  // Stores the time of a call. Throws if destroy() was called, because the object adapter still
  // delivers calls until destroy() has returned.
  void NoteCall() {
    if (is_destroyed_) throw CORBA::OBJECT_NOT_EXIST();
    last_call_ = RunClock::now().time_since_epoch();
  }

  void Work() {
    TestResult result;
    if (const auto folder = base::TemporaryFolder::Make("gsv-served"); !folder) {
      result.message = folder.error().Sentence();
    } else {
      const std::filesystem::path file = folder->path() / "scenario.yaml";
      TestOptions options;
      options.timeout = timeout_;
      options.record = false;
      options.threads = 1;
      if (std::ofstream out(file); out << scenario_ << std::flush) {
        result = RunTestCase({file, "scenario"}, options, is_cancelled_);
      } else {
        result.message = "cannot write the scenario to " + file.string();
      }
    }
    const base::MutexLock lock(mutex_);
    result_ = std::move(result);
    ended_.notify_all();
  }

  ScenarioServiceServant& service_;
  const std::string scenario_;
  const double timeout_, abandoned_after_;
  std::atomic<RunClock::duration> last_call_{RunClock::now().time_since_epoch()};
  std::atomic<bool> is_cancelled_{false};
  std::atomic<bool> is_destroyed_{false};
  mutable base::Mutex mutex_;
  base::ConditionVariable ended_;
  std::optional<TestResult> result_ GSV_GUARDED_BY(mutex_);
  std::jthread thread_;  // destroyed before all other members, because the thread uses these
};

namespace {

using HeldRun = PortableServer::Servant_var<ScenarioRunServant>;

HeldRun Hold(ScenarioRunServant* run) {
  run->_add_ref();
  return HeldRun(run);
}

}  // namespace

ScenarioServiceServant::ScenarioServiceServant(PortableServer::POA_ptr poa, int capacity)
    : poa_(PortableServer::POA::_duplicate(poa)),
      capacity_(capacity),
      janitor_([this] { EndAbandoned(); }) {}

ScenarioServiceServant::~ScenarioServiceServant() { Close(); }

sba::ScenarioRun_ptr ScenarioServiceServant::run(const char* scenario,
                                                 const sba::NameValues& options) {
  const model::Parameters values = services::FromIdl(options);
  services::RefuseUnknown(values, {"abandoned_after_s", "timeout_s"});
  const double timeout = SecondsOption(values, "timeout_s", kDefaultTimeout);
  const double abandoned = SecondsOption(values, "abandoned_after_s", kDefaultAbandoned);
  RefuseUnlessRunnable(scenario);
  const base::MutexLock lock(mutex_);
  if (closing_) throw sba::Failed("the server is shutting down");
  const auto busy =
      std::count_if(runs_.begin(), runs_.end(), [](const auto* run) { return run->is_running(); });
  if (busy >= capacity_ || runs_.size() >= kMaxKept) return sba::ScenarioRun::_nil();
  auto* run = new ScenarioRunServant(*this, scenario, timeout, abandoned);
  const PortableServer::ServantBase_var owned(run);
  const PortableServer::ObjectId_var id = poa_->activate_object(run);
  runs_.insert(run);
  return run->_this();
}

int ScenarioServiceServant::running() const {
  const base::MutexLock lock(mutex_);
  return static_cast<int>(
      std::count_if(runs_.begin(), runs_.end(), [](const auto* run) { return run->is_running(); }));
}

void ScenarioServiceServant::Forget(ScenarioRunServant* run) {
  {
    const base::MutexLock lock(mutex_);
    if (runs_.erase(run) == 0) return;  // another thread has removed it
  }
  const PortableServer::ObjectId_var id = poa_->servant_to_id(run);
  poa_->deactivate_object(id);
}

void ScenarioServiceServant::EndAbandoned() {
  base::MutexLock lock(mutex_);
  while (!closing_) {
    closing_changed_.wait_for(lock, std::chrono::seconds(1),
                              [this]() GSV_REQUIRES(mutex_) { return closing_; });
    std::vector<HeldRun> abandoned;
    for (ScenarioRunServant* run : runs_) {
      if (run->IsAbandoned()) abandoned.push_back(Hold(run));
    }
    lock.unlock();
    for (HeldRun& run : abandoned) {
      spdlog::warn("aborted a scenario: its campaign has not called for too long");
      run->Cancel();
      Forget(run.in());
    }
    abandoned.clear();  // the destructors wait for the end of the runs
    lock.lock();
  }
}

void ScenarioServiceServant::Close() {
  std::vector<HeldRun> runs;
  {
    const base::MutexLock lock(mutex_);
    closing_ = true;
    for (ScenarioRunServant* run : runs_) {
      run->Cancel();
      runs.push_back(Hold(run));
    }
  }
  closing_changed_.notify_all();
  for (HeldRun& run : runs) Forget(run.in());
}

}  // namespace gsv::app
