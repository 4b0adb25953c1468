#include "tests/support/slurm_cluster.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <pwd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

namespace gsv::testing {
namespace {

namespace fs = std::filesystem;

constexpr const char* kPrograms[]{"/usr/sbin/munged", "/usr/sbin/slurmctld", "/usr/sbin/slurmd",
                                  "/usr/bin/sbatch", "/usr/bin/squeue"};

// Finds ports on which no process listens. All ports stay bound until the function returns, so that
// they differ.
std::vector<int> FreePorts(int count) {
  std::vector<int> sockets, ports;
  for (int i = 0; i < count; ++i) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    sockets.push_back(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
    bind(sockets.back(), reinterpret_cast<sockaddr*>(&address), sizeof address);
    getsockname(sockets.back(), reinterpret_cast<sockaddr*>(&address), &size);
    ports.push_back(ntohs(address.sin_port));
  }
  for (const int socket : sockets) close(socket);
  return ports;
}

std::string BytesOf(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

std::string NodeName(int node) { return "n" + std::to_string(node + 1); }

}  // namespace

std::string SlurmCluster::Missing() {
  for (const char* program : kPrograms) {
    if (access(program, X_OK) != 0)
      return std::string(program) + " does not exist; install slurm-wlm (tools/setup does)";
  }
  return {};
}

SlurmCluster::SlurmCluster(const Options& options) {
  WriteConfiguration(options);
  setenv("SLURM_CONF", configuration_.c_str(), 1);
  const fs::path munge = folder_.path() / "munge";
  fs::create_directory(munge);
  std::ifstream random("/dev/urandom", std::ios::binary);
  std::string key(1024, '\0');
  random.read(key.data(), static_cast<std::streamsize>(key.size()));
  std::ofstream(munge / "key", std::ios::binary) << key;
  fs::permissions(munge / "key", fs::perms::owner_read | fs::perms::owner_write);
  munged_ = std::make_unique<Running>(
      "/usr/sbin/munged",
      std::vector<std::string>{
          "--foreground", "--force", "--key-file=" + (munge / "key").string(),
          "--socket=" + (munge / "socket").string(), "--pid-file=" + (munge / "pid").string(),
          "--log-file=" + (munge / "log").string(), "--seed-file=" + (munge / "seed").string()});
  controller_ = std::make_unique<Running>("/usr/sbin/slurmctld",
                                          std::vector<std::string>{"-D", "-f", configuration_});
  nodes_.resize(static_cast<std::size_t>(options.nodes));
  for (int node = 0; node < options.nodes; ++node) StartSlurmd(node);
  AwaitNodes();
}

SlurmCluster::~SlurmCluster() {
  controller_.reset();
  for (auto& node : nodes_) node.reset();
  // Tasks and their supervisors are separate processes that may still run, so all processes of this
  // cluster are killed.
  for (std::vector<pid_t> left;
       !(left = ProcessesWith("SLURM_CONF=" + configuration_, "")).empty();) {
    left.erase(std::remove(left.begin(), left.end(), munged_->process().pid()), left.end());
    if (left.empty()) break;
    for (const pid_t process : left) kill(process, SIGKILL);
  }
  munged_.reset();
  unsetenv("SLURM_CONF");
}

void SlurmCluster::WriteConfiguration(const Options& options) const {
  char host[256] = "";
  gethostname(host, sizeof host - 1);
  const std::string folder = folder_.path();
  const std::string user = getpwuid(getuid())->pw_name;
  const std::vector<int> ports = FreePorts(options.nodes + 1);
  fs::create_directory(folder_.path() / "state");
  std::ofstream file(configuration_);
  // A requeued task starts only after its credentials have expired. So their lifetime (cred_expire)
  // is short.
  file << "ClusterName=test\nSlurmctldHost=" << host << "(127.0.0.1)\n"
       << "SlurmctldPort=" << ports[0] << "\n"
       << "AuthType=auth/munge\nCredType=cred/munge\nAuthInfo=socket=" << folder
       << "/munge/socket,cred_expire=5\n"
       << "SlurmUser=" << user << "\nSlurmdUser=" << user << "\n"
       << "StateSaveLocation=" << folder << "/state\nSlurmdSpoolDir=" << folder << "/spool.%n\n"
       << "SlurmctldPidFile=" << folder << "/slurmctld.pid\n"
       << "SlurmdPidFile=" << folder << "/slurmd.%n.pid\n"
       << "SlurmctldLogFile=" << folder << "/slurmctld.log\n"
       << "SlurmdLogFile=" << folder << "/slurmd.%n.log\n"
       << "ProctrackType=proctrack/linuxproc\nTaskPlugin=task/none\nMpiDefault=none\n"
       << "SwitchType=switch/none\nJobAcctGatherType=jobacct_gather/none\n"
       << "AccountingStorageType=accounting_storage/none\n"
       << "SelectType=select/cons_tres\nSelectTypeParameters=CR_CPU\n"
       << "SchedulerParameters=batch_sched_delay=0\n"
       << "ReturnToService=2\nSlurmdTimeout=5\nKillWait=2\nJobRequeue=1\n"
       << options.more << "\n";
  std::string names;
  for (int node = 0; node < options.nodes; ++node) {
    file << "NodeName=" << NodeName(node) << " NodeHostname=" << host
         << " NodeAddr=127.0.0.1 Port=" << ports[static_cast<std::size_t>(node) + 1]
         << " CPUs=" << options.processors << " State=UNKNOWN\n";
    names += (names.empty() ? "" : ",") + NodeName(node);
  }
  file << "PartitionName=all Nodes=" << names << " Default=YES MaxTime=INFINITE State=UP\n";
}

void SlurmCluster::AwaitNodes() const {
  const auto give_up = std::chrono::steady_clock::now() + kProgramTimeout;
  std::string states;
  for (std::size_t idle = 0; idle < nodes_.size();) {
    ASSERT_LT(std::chrono::steady_clock::now(), give_up)
        << "the nodes are " << states << "\n"
        << BytesOf(folder_.path() / "slurmctld.log") << BytesOf(folder_.path() / "munge/log");
    states = Ask({"sinfo", "--noheader", "--Node", "--format=%T"});
    std::istringstream lines(states);
    idle = 0;
    for (std::string state; std::getline(lines, state);) idle += state == "idle";
  }
}

void SlurmCluster::StartSlurmd(int node) {
  nodes_[static_cast<std::size_t>(node)] = std::make_unique<Running>(
      "/usr/sbin/slurmd",
      std::vector<std::string>{"-D", "-N", NodeName(node), "-f", configuration_},
      std::vector<std::string>{"/usr/bin/env", "GSV_TEST_NODE=" + NodeName(node)});
}

void SlurmCluster::KillSlurmd(int node) {
  auto& slurmd = nodes_[static_cast<std::size_t>(node)];
  slurmd->process().Signal(SIGKILL);
  slurmd->AwaitEnd();
}

void SlurmCluster::LoseNode(int node) {
  KillSlurmd(node);
  // The processes of a node are found by their environment: slurmstepd has the environment of its
  // slurmd, and a task has that of its job.
  for (const std::string& variable :
       {"GSV_TEST_NODE=" + NodeName(node), "SLURMD_NODENAME=" + NodeName(node)}) {
    for (const pid_t process : ProcessesWith(variable, "")) kill(process, SIGKILL);
  }
}

void SlurmCluster::KillController() {
  controller_->process().Signal(SIGKILL);
  controller_->AwaitEnd();
}

bool SlurmCluster::Runs(const std::string& text) const {
  return !ProcessesWith("SLURM_CONF=" + configuration_, text).empty();
}

int SlurmCluster::KillProcesses(const std::string& text) const {
  int killed = 0;
  for (const pid_t process : ProcessesWith("SLURM_CONF=" + configuration_, text))
    killed += kill(process, SIGKILL) == 0;
  return killed;
}

std::vector<pid_t> SlurmCluster::ProcessesWith(const std::string& variable,
                                               const std::string& text) const {
  std::vector<pid_t> processes;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator("/proc", ignored)) {
    const pid_t process = std::atoi(entry.path().filename().c_str());
    if (process <= 0 || process == getpid()) continue;
    std::string environment = std::string(1, '\0') + BytesOf(entry.path() / "environ");
    const std::string ours = "SLURM_CONF=" + configuration_;
    if (environment.find('\0' + ours + '\0') == std::string::npos ||
        environment.find('\0' + variable + '\0') == std::string::npos)
      continue;
    std::string line = BytesOf(entry.path() / "cmdline");
    std::replace(line.begin(), line.end(), '\0', ' ');
    if (line.find(text) != std::string::npos) processes.push_back(process);
  }
  return processes;
}

std::string SlurmCluster::Ask(std::vector<std::string> command) {
  const std::string program = "/usr/bin/" + command.front();
  command.erase(command.begin());
  return RunProgram(program, std::move(command)).out;
}

}  // namespace gsv::testing
