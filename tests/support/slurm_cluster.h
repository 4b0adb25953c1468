// For tests: a Slurm cluster on this machine with munged, slurmctld and a slurmd for each node. It
// runs in a temporary folder, as the present user, on ports that the system chose. The destructor
// removes everything.
#pragma once

#include <sys/types.h>

#include <memory>
#include <string>
#include <vector>

#include "tests/support/programs.h"

namespace gsv::testing {

class SlurmCluster {
 public:
  struct Options {
    int nodes = 2;
    int processors = 2;  // number of processors of a node, independent of this machine
    std::string more;    // additional lines for slurm.conf
  };

  // The reason why this machine cannot run a cluster; empty if it can.
  static std::string Missing();

  // Returns when all nodes are idle. Slurm's commands find the cluster by $SLURM_CONF during its
  // lifetime.
  explicit SlurmCluster(const Options& options);
  SlurmCluster() : SlurmCluster(Options()) {}
  ~SlurmCluster();
  SlurmCluster(const SlurmCluster&) = delete;
  SlurmCluster& operator=(const SlurmCluster&) = delete;

  // Kills only the node's slurmd (SIGKILL). Its tasks continue.
  void KillSlurmd(int node);
  void StartSlurmd(int node);
  // Kills the node's slurmd, its tasks and all processes that these have started (SIGKILL).
  void LoseNode(int node);
  void KillController();
  // Whether a process of this cluster has `text` in its command line.
  bool Runs(const std::string& text) const;
  // Kills this cluster's processes whose command line contains `text` (SIGKILL). Returns their
  // number.
  int KillProcesses(const std::string& text) const;

  // Returns the output of one of Slurm's commands.
  static std::string Ask(std::vector<std::string> command);

 private:
  void WriteConfiguration(const Options& options) const;
  void AwaitNodes() const;
  std::vector<pid_t> ProcessesWith(const std::string& variable, const std::string& text) const;

  const base::testing::TestFolder folder_{};
  const std::string configuration_ = folder_.path() / "slurm.conf";
  std::unique_ptr<Running> munged_, controller_;
  std::vector<std::unique_ptr<Running>> nodes_;
};

}  // namespace gsv::testing
