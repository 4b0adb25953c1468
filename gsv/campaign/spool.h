// The folder in which machines with a shared file system store the results of a campaign's tasks.
// The folder is NAME.runs beside the results.
//
// Format   plan.json            the campaign at the time of the first submission
//          batch-0001.json      a submitted batch: its runs, and the number of runs per task
//          journals/*.journal   the journals of attempts, one file each (journal.h)
//          logs/                the output of tasks
//          Files other than journals are written atomically by renaming. No lock is needed:
//          each file is written by one machine only, or has the same content from all
//          machines (plan.json). A run may be in several journals.
// Threads  one at a time.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "gsv/campaign/journal.h"

namespace gsv::campaign {

// Runs that were submitted together as tasks. The tasks are numbered from 0 and have the same
// number of runs each; the last task may have fewer.
struct Batch {
  int number = 1;        // number of the batch in the campaign, from 1
  std::string name;      // the unique name of the job in the queue
  std::string job;       // the number of the job in the queue; empty if it is unknown
  double submitted = 0;  // in s since 1970
  std::size_t runs_per_task = 1;
  std::vector<std::int64_t> runs;  // numbers of the campaign's runs, in the order of the tasks
  double timeout = 300;            // wall-clock time limit of a run, s
  std::string failures;            // folder for the files of failed runs; empty if there is none

  std::size_t tasks() const { return (runs.size() + runs_per_task - 1) / runs_per_task; }
  std::vector<std::int64_t> RunsOf(std::size_t task) const;  // the runs of a task
  // Returns the name of a task's share of the runs. The journals of the task contain this name.
  std::string ShareOf(std::size_t task) const;
};

base::Result<Batch> ReadBatch(const std::filesystem::path& file);

// Returns the name of share `index` of `count`, which `gsv campaign run --shard` executes.
std::string ShardName(std::size_t index, std::size_t count);

// Reads and writes the folder.
class Spool {
 public:
  // Opens the folder, and creates it if it does not exist. Fails for a folder of another campaign.
  static base::Result<Spool> Make(const std::filesystem::path& folder, const Campaign& campaign);
  // Opens the folder. Returns kNotFound if it does not exist.
  static base::Result<Spool> Open(const std::filesystem::path& folder);

  const Campaign& campaign() const { return campaign_; }
  std::filesystem::path journals() const { return folder_ / "journals"; }
  std::filesystem::path logs() const { return folder_ / "logs"; }
  // Returns the path of a batch's file.
  std::filesystem::path FileOf(const Batch& batch) const;
  // Returns the file of a task's output. `task` is the task's number, or the queue's placeholder
  // for it.
  std::filesystem::path LogOf(const Batch& batch, const std::string& task) const;

  base::Result<std::vector<Batch>> Batches() const;  // Returns the batches, ordered by number.
  // Writes the batch to its file, and overwrites an existing file.
  base::Status Put(const Batch& batch) const;
  // Removes a batch's file.
  void Remove(const Batch& batch) const;

  // Reads what was added to the journals since the last call, and returns these results. If `share`
  // is not empty, opens only the journals of the attempts that executed this share.
  base::Result<std::vector<RunResult>> Collect(const std::string& share = "");
  // Returns the readers of the journals that Collect() has opened, by file name.
  const std::map<std::string, JournalReader>& read() const { return readers_; }
  // Returns the attempts of all journals that Collect() has read.
  std::vector<Attempt> Attempts() const;

 private:
  Spool(std::filesystem::path folder, Campaign campaign)
      : folder_(std::move(folder)), campaign_(std::move(campaign)) {}

  std::filesystem::path folder_;
  Campaign campaign_;
  std::map<std::string, JournalReader> readers_;
};

// Copies new entries of the spool's journals to the results. Returns the number of copied runs,
// including runs that already had a result.
base::Result<std::size_t> Gather(Spool& spool, Results& results);

}  // namespace gsv::campaign
