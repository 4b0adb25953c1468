// The folder in which machines that share a file system leave what they have done of a campaign:
// NAME.runs beside its results.
//
// Format   plan.json            the campaign, as it was when the first share was handed out
//          batch-0001.json      what was handed to a queue: which runs, how many a task
//          journals/*.journal   what came of attempts, a file for each (journal.h)
//          logs/                what tasks said
//          Files but journals are put in place whole, by renaming. Nothing in here is ever changed
//          by two machines, so that no lock is needed; a run may be found in several journals.
// Threads  one at a time.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "gsv/campaign/journal.h"

namespace gsv::campaign {

// Runs that were handed to a queue together: tasks from 0 on, each with so many of them.
struct Batch {
  int number = 1;
  std::string name;      // of the queue's job, unlike all others
  std::string job;       // the queue's number; empty: not known
  double submitted = 0;  // s since 1970
  std::size_t runs_per_task = 1;
  std::vector<std::int64_t> runs;
  double timeout = 300;  // wall seconds a run may take
  std::string failures;  // a folder for what failed runs leave; empty: nothing is kept

  std::size_t tasks() const { return (runs.size() + runs_per_task - 1) / runs_per_task; }
  std::vector<std::int64_t> RunsOf(std::size_t task) const;
  // The name of a task's share, in journals.
  std::string ShareOf(std::size_t task) const;
};

base::Result<Batch> ReadBatch(const std::filesystem::path& file);

// The share I of N that no queue of ours handed out.
std::string ShardName(std::size_t index, std::size_t count);

class Spool {
 public:
  // Makes it if there is none. Refuses that of another campaign.
  static base::Result<Spool> Make(const std::filesystem::path& folder, const Campaign& campaign);
  // kNotFound when there is none.
  static base::Result<Spool> Open(const std::filesystem::path& folder);

  const Campaign& campaign() const { return campaign_; }
  std::filesystem::path journals() const { return folder_ / "journals"; }
  std::filesystem::path logs() const { return folder_ / "logs"; }
  std::filesystem::path FileOf(const Batch& batch) const;
  // Of a task's output; `task`: its number, or what the queue puts in its place.
  std::filesystem::path LogOf(const Batch& batch, const std::string& task) const;

  base::Result<std::vector<Batch>> Batches() const;  // by number
  base::Status Put(const Batch& batch) const;
  void Remove(const Batch& batch) const;

  // What has come since the last time: of all attempts, or of those at one share.
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

// Puts what the spool's journals hold, and was not read yet, into the results. Gives how many runs
// that was.
base::Result<std::size_t> Gather(Spool& spool, Results& results);

}  // namespace gsv::campaign
