// The engine `ssh`. It has a list of hosts, each with a number of slots, and starts tasks on them
// with the program `ssh`. The hosts see the campaign's folder under the same path as this machine.
//
// The driver itself manages the queue and keeps the tasks that wait for a slot. A running task ends
// with its connection, because its stdin closes. A host counts as failed if it is unreachable, or
// if a task ends there before its journal exists. Then another host executes the task. The failed
// host gets no tasks for a while, and this pause gets longer after each failure. If a task with a
// journal ends without success, the queue drops the task, and the driver submits the rest of its
// runs again.
#include <algorithm>
#include <charconv>
#include <deque>
#include <fstream>
#include <list>

#include <fmt/format.h>

#include "gsv/campaign/engine.h"
#include "gsv/scenario/yaml_mapping.h"

namespace gsv::campaign {
namespace {

using SshClock = std::chrono::steady_clock;
using std::chrono::seconds;

constexpr int kMaxSlots = 256;
constexpr std::size_t kMaxHosts = 1000;
// number of tasks per slot: with many small tasks, all slots finish at about the same time
constexpr std::size_t kTasksPerSlot = 8;
// maximum number of connections being opened to a host; sshd drops more (MaxStartups 10)
constexpr std::size_t kMaxConnecting = 8;
// the queue gives up after this many consecutive failures of every host
constexpr int kMaxFailures = 3;
constexpr seconds kFirstRest{5}, kMaxRest{60};
constexpr seconds kStartTimeout{60};  // maximum time from the start of ssh to the start of the task
constexpr seconds kEndMargin{60};     // added to the time that the task's runs may take

struct SshOptions {
  struct Host {
    std::string name;  // as ssh accepts it: HOST, USER@HOST or an alias
    std::size_t slots = 1;
  };
  std::vector<Host> hosts;
  std::string ssh = "ssh";
  std::vector<std::string> options;
  std::string program;  // path of gsv on the hosts; empty for the path on this machine
};

class SshQueue final : public JobQueue {
 public:
  SshQueue(const SshOptions& options, const QueueContext& context)
      : options_(options), context_(context) {
    for (const SshOptions::Host& host : options_.hosts) hosts_.push_back({host});
    if (options_.program.empty()) options_.program = context.program;
  }

  base::Result<std::size_t> MaxTasks() override {
    std::size_t slots = 0;
    for (const Host& host : hosts_) slots += host.settings.slots;
    return slots * kTasksPerSlot;
  }

  base::Result<std::string> Submit(const Spool& spool, const Batch& batch) override {
    for (std::size_t task = 0; task < batch.tasks(); ++task) {
      const auto runs = static_cast<double>(batch.RunsOf(task).size());
      waiting_.push_back({batch.name, batch.ShareOf(task), std::to_string(task),
                          spool.FileOf(batch), spool.LogOf(batch, std::to_string(task)),
                          kEndMargin + std::chrono::ceil<seconds>(
                                           std::chrono::duration<double>(runs * batch.timeout))});
    }
    return batch.name;
  }

  base::Result<std::map<std::string, QueuedTask>> TasksOf(const std::vector<Batch>&) override {
    TakeEnded();
    StartWaiting();
    if (IsWithoutHost()) {
      std::string reasons;
      for (const Host& host : hosts_) {
        if (reasons.size() < 1000)
          reasons += fmt::format("; {}: {}", host.settings.name, host.reason);
      }
      return base::Fail(
          base::ErrorCode::kNotFound,
          "no host accepts a task" + reasons + "; run the same command again to continue", "ssh");
    }
    std::map<std::string, QueuedTask> tasks;
    for (const Running& running : running_) tasks[running.task.share] = {"RUNNING", ""};
    for (const Task& task : waiting_) tasks[task.share] = {"PENDING", "a slot of a host"};
    return tasks;
  }

 private:
  struct Host {
    SshOptions::Host settings;
    std::size_t running = 0,
                connecting = 0;  // started tasks, and those of them that have not begun on the host
    int failures = 0;            // consecutive failures
    SshClock::time_point rests_until{};
    std::string reason;
  };
  struct Task {
    std::string job, share, number;
    std::string batch_file, log;
    seconds time_limit;  // time limit of the task, from its start
  };
  struct Running {
    Task task;
    Host* host;
    std::unique_ptr<StartedProgram> program;
    SshClock::time_point give_up;
    bool has_begun = false;
  };

  void TakeEnded() {
    for (auto running = running_.begin(); running != running_.end();) {
      // Reads the output in every case, because a program would block if its output were not read.
      const std::string output = running->program->Output();
      if (!running->has_begun && output.find(kTaskBegins) != std::string::npos) Begin(*running);
      std::string ending = running->program->Ending();
      if (ending.empty() && context_.now() >= running->give_up) ending = "no response in time";
      if (ending.empty()) {
        ++running;
        continue;
      }
      End(*running, ending);
      running = running_.erase(running);
    }
  }

  void Begin(Running& running) {
    running.has_begun = true;
    running.give_up = context_.now() + running.task.time_limit;
    --running.host->connecting;
    running.host->failures = 0;
  }

  void End(Running& running, const std::string& ending) {
    const std::string output = running.program->Output();
    std::ofstream(running.task.log, std::ios::app) << output;
    if (!running.has_begun && output.find(kTaskBegins) != std::string::npos) Begin(running);
    Host& host = *running.host;
    --host.running;
    if (!running.has_begun) --host.connecting;
    if (ending == kSucceeded) {
      host.failures = 0;
      return;
    }
    const std::string last = LastLine(output);
    // ssh returns exit code 255 if it fails itself
    const bool is_lost = !running.has_begun || ending == "exit code 255";
    if (is_lost) Fail(host, last.empty() ? ending : last);
    if (!running.has_begun) waiting_.push_back(std::move(running.task));
  }

  // Marks a host as failed. If several tasks of a host fail at about the same time, they count as
  // one failure: a failure during the pause after another failure is not counted.
  void Fail(Host& host, const std::string& reason) {
    host.reason = reason;
    if (context_.now() < host.rests_until) return;
    const auto rest = std::min(kMaxRest, kFirstRest * (1 << std::min(host.failures, 5)));
    ++host.failures;
    host.rests_until = context_.now() + rest;
    context_.say(fmt::format("host {} failed: {}; it gets no tasks for {} s", host.settings.name,
                             reason, rest.count()));
  }

  void StartWaiting() {
    while (!waiting_.empty()) {
      const auto host = std::max_element(
          hosts_.begin(), hosts_.end(),
          [this](const Host& a, const Host& b) { return FreeSlots(a) < FreeSlots(b); });
      if (FreeSlots(*host) == 0) return;
      Start(std::move(waiting_.front()), *host);
    }
  }

  // Returns the number of tasks that the host can accept. After a failure, it gets only one task at
  // first.
  std::size_t FreeSlots(const Host& host) const {
    if (context_.now() < host.rests_until || host.connecting >= kMaxConnecting) return 0;
    const std::size_t slots = host.failures > 0 ? 1 : host.settings.slots;
    return slots - std::min(slots, host.running);
  }

  void Start(Task task, Host& host) {
    waiting_.pop_front();
    auto program = context_.commands.Start(CommandFor(task, host.settings.name));
    if (!program) {
      Fail(host, program.error().Sentence());
      waiting_.push_back(std::move(task));
      return;
    }
    ++host.running;
    ++host.connecting;
    running_.push_back(
        {std::move(task), &host, *std::move(program), context_.now() + kStartTimeout});
  }

  // ssh uses the first value that it finds for a setting, so the user's options come before these
  // defaults.
  std::vector<std::string> CommandFor(const Task& task, const std::string& host) const {
    std::vector<std::string> command{options_.ssh};
    command.insert(command.end(), options_.options.begin(), options_.options.end());
    for (const char* setting :
         {"BatchMode=yes", "ConnectTimeout=10", "ServerAliveInterval=15", "ServerAliveCountMax=3"})
      command.insert(command.end(), {"-o", setting});
    const TaskCommand remote{.program = options_.program,
                             .batch_file = task.batch_file,
                             .task = task.number,
                             .job = Quoted(task.job),
                             .node = Quoted(host.substr(host.find('@') + 1)),
                             .more = "--until-stdin-closes"};
    command.insert(command.end(), {"-T", host, remote.Text()});
    return command;
  }

  bool IsWithoutHost() const {
    return running_.empty() && std::all_of(hosts_.begin(), hosts_.end(), [](const Host& host) {
             return host.failures >= kMaxFailures;
           });
  }

  SshOptions options_;
  const QueueContext context_;
  std::vector<Host> hosts_;
  std::deque<Task> waiting_;
  std::list<Running> running_;
};

// Parses "HOST" or "HOST:SLOTS", the notation of mpirun.
std::optional<SshOptions::Host> HostIn(const std::string& text) {
  SshOptions::Host host;
  const std::size_t colon = text.find(':');
  host.name = text.substr(0, colon);
  if (host.name.empty() || host.name.front() == '-') return std::nullopt;
  for (const char c : host.name) {
    if (c <= ' ' || c == '/' || c == 0x7f) return std::nullopt;
  }
  if (colon == std::string::npos) return host;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(&text[colon] + 1, end, host.slots);
  if (error != std::errc() || stop != end || host.slots < 1 || host.slots > kMaxSlots)
    return std::nullopt;
  return host;
}

MakeQueue ReadSsh(scenario::YamlMapping& mapping) {
  SshOptions options;
  const std::vector<std::string> hosts = mapping.Texts("hosts");
  if (mapping.is_mapping() && (hosts.empty() || hosts.size() > kMaxHosts))
    mapping.AddProblem("hosts",
                       "hosts must be a list of 1 to 1,000 hosts, such as [n1, user@n2:8]");
  for (const std::string& text : hosts) {
    if (auto host = HostIn(text)) {
      options.hosts.push_back(*std::move(host));
    } else {
      mapping.AddProblem(
          "hosts", "a host must have the form HOST or HOST:SLOTS with 1 to 256 slots, found \"" +
                       text + "\"");
    }
  }
  options.ssh = mapping.Text("program").value_or(options.ssh);
  options.options = mapping.Texts("options");
  options.program = mapping.Text("gsv").value_or("");
  return [options](const QueueContext& context) {
    return std::make_unique<SshQueue>(options, context);
  };
}

}  // namespace

EngineType SshEngine() {
  EngineType type;
  type.name = "ssh";
  type.title = "ssh";
  type.help = "on a list of hosts, with ssh";
  type.options = {{"--host", "hosts", "further host, HOST or HOST:SLOTS (default: 1 slot)", true}};
  type.poll_period = std::chrono::milliseconds(500);
  type.outlives_driver = false;
  type.after_interrupt = "the tasks on the hosts end";
  type.read = &ReadSsh;
  return type;
}

}  // namespace gsv::campaign
