// The folder in which machines with a shared file system store the results of a campaign's tasks:
// NAME.runs beside the results.
//
// Format   plan.json            the campaign at the time of the first submission
//          batch-0001.json      a submitted batch: its runs, and the number of runs per task
//          journals/*.journal   the journals of attempts, one file each (journal.h)
//          logs/                the output of tasks
//          Files other than journals are written atomically by renaming. Only one machine ever
//          writes a file, so that no lock is needed. A run may be in several journals.
// Threads  one at a time.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "gsv/campaign/journal.h"

namespace gsv::campaign {

// Runs that were submitted together: tasks numbered from 0, each with the same number of runs.
struct Batch {
  int number = 1;
  std::string name;      // the unique name of the queue's job
  std::string job;       // the queue's number; empty: unknown
  double submitted = 0;  // s since 1970
  std::size_t runs_per_task = 1;
  std::vector<std::int64_t> runs;
  double timeout = 300;  // time limit of a run, s of wall-clock time
  std::string failures;  // a folder for the files of failed runs; empty: none are kept

  std::size_t tasks() const { return (runs.size() + runs_per_task - 1) / runs_per_task; }
  std::vector<std::int64_t> RunsOf(std::size_t task) const;
  // The name of a task's share, in journals.
  std::string ShareOf(std::size_t task) const;
};

base::Result<Batch> ReadBatch(const std::filesystem::path& file);

// The share I of N of runs that were not submitted by a queue of GSV.
std::string ShardName(std::size_t index, std::size_t count);

class Spool {
 public:
  // Creates the folder if it does not exist. Fails for a folder of another campaign.
  static base::Result<Spool> Make(const std::filesystem::path& folder, const Campaign& campaign);
  // Opens the folder; kNotFound if it does not exist.
  static base::Result<Spool> Open(const std::filesystem::path& folder);

  const Campaign& campaign() const { return campaign_; }
  std::filesystem::path journals() const { return folder_ / "journals"; }
  std::filesystem::path logs() const { return folder_ / "logs"; }
  std::filesystem::path FileOf(const Batch& batch) const;
  // The file of a task's output. `task`: its number, or the placeholder of the queue.
  std::filesystem::path LogOf(const Batch& batch, const std::string& task) const;

  base::Result<std::vector<Batch>> Batches() const;  // by number
  base::Status Put(const Batch& batch) const;
  void Remove(const Batch& batch) const;

  // The results since the last call, of all attempts or of those at one share.
  base::Result<std::vector<RunResult>> Collect(const std::string& share = "");
  const std::map<std::string, JournalReader>& read() const { return readers_; }  // by file name
  std::vector<Attempt> Attempts() const;

 private:
  Spool(std::filesystem::path folder, Campaign campaign)
      : folder_(std::move(folder)), campaign_(std::move(campaign)) {}

  std::filesystem::path folder_;
  Campaign campaign_;
  std::map<std::string, JournalReader> readers_;
};

// Adds new entries of the spool's journals to the results. Returns the number of runs.
base::Result<std::size_t> Gather(Spool& spool, Results& results);

}  // namespace gsv::campaign
