// A Slurm of the test's own on this machine: munged, slurmctld and a slurmd for each node, in a
// temporary folder, as the present user, at ports that the system chose. Nothing of it outlives the
// object.
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
    int processors = 2;  // of a node, whatever this machine has
    std::string more;    // lines for slurm.conf
  };

  // Why there can be none here; empty: there can.
  static std::string Missing();

  // Returns once all nodes are idle. Slurm's commands find it by $SLURM_CONF until it ends.
  explicit SlurmCluster(const Options& options);
  SlurmCluster() : SlurmCluster(Options()) {}
  ~SlurmCluster();
  SlurmCluster(const SlurmCluster&) = delete;
  SlurmCluster& operator=(const SlurmCluster&) = delete;

  // kill -9 of the node's slurmd alone: its tasks go on.
  void KillSlurmd(int node);
  void StartSlurmd(int node);
  // kill -9 of the node's slurmd, of its tasks and of all that these have started.
  void LoseNode(int node);
  void KillController();
  // Whether one of this cluster's processes has `text` in its command line.
  bool Runs(const std::string& text) const;
  // kill -9 of this cluster's processes whose command line contains `text`; how many there were.
  int KillProcesses(const std::string& text) const;

  // What one of Slurm's commands says.
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
