// Stores the results of a campaign's runs in one SQLite file.
//
// Format   tables `campaign` (key, value), `runs` (run, parameters, status, message, state_hash,
//          sim_time_s, wall_s, recording, metrics; parameters and metrics are JSON objects) and
//          `attempts` (the fields of Attempt), in WAL mode. Rows that were added survive the end of
//          the process at any time. A run has at most one row.
// Threads  one at a time. Only one process at a time may write; others get an error.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "gsv/base/error.h"
#include "gsv/broker/storage/database.h"
#include "gsv/campaign/campaign.h"

namespace gsv::campaign {

// The result of one run.
struct RunResult {
  std::int64_t run = 0;                // number of the run in the campaign
  std::string status;                  // "passed", "failed" or "error"
  std::string message;                 // the reason why the run did not pass
  std::string state_hash;              // hash of the world's state at the end of the run
  double sim_time = 0, wall_time = 0;  // in s
  std::string recording;               // path of the recording; empty if there is none
  // values of the varied parameters, by the parameter's path
  nlohmann::ordered_json parameters = nlohmann::ordered_json::object();
  // values of metrics, as JSON numbers by the metric's name
  nlohmann::ordered_json metrics = nlohmann::ordered_json::object();
};

// An attempt: one process that executed a share of the runs on one machine.
struct Attempt {
  std::string journal;  // file name of the attempt's journal
  std::string share;    // name of the share; several attempts may have the same share
  std::string job;      // the queue's id of the job; empty if there is no queue
  std::string node;     // the name of the machine
  int at_once = 1;      // maximum number of runs at the same time
  // In s since 1970. `ended` is the time of the last line of the journal, so the process ended at
  // this time or later.
  double submitted = 0, started = 0, ended = 0;
  std::size_t runs = 0;    // number of executed runs
  double run_seconds = 0;  // sum of the runs' wall-clock times, s

  friend bool operator==(const Attempt&, const Attempt&) = default;
};

// An open results file.
class Results {
 public:
  // Opens the file for a driver, and creates it if it does not exist. Fails for a file of another
  // campaign, and for a file that is not an SQLite database. If another process writes the file,
  // waits up to `timeout`, then fails with kNotRunning. The wait is useful if the other process
  // only collects results, because it needs the file for a short time only.
  static base::Result<std::unique_ptr<Results>> OpenToAdd(
      const std::string& file, const Campaign& campaign,
      std::chrono::milliseconds timeout = std::chrono::milliseconds(0));
  // Opens the file for reading. Returns kNotFound if it does not exist.
  static base::Result<std::unique_ptr<Results>> Open(const std::string& file);
  ~Results();

  // Adds all results or, in case of an error, none. A run that already has a result keeps this
  // first result. An attempt replaces an earlier attempt with the same journal.
  base::Status Add(const std::vector<RunResult>& results,
                   const std::vector<Attempt>& attempts = {});

  // Returns the numbers of the runs that have a result.
  base::Result<std::set<std::int64_t>> DoneRuns();
  // Returns the number of results that are not "passed".
  base::Result<std::size_t> NotPassed();
  base::Result<std::vector<RunResult>> All();  // Returns all results, ordered by run number.
  // Returns all attempts, ordered by the instant at which they started.
  base::Result<std::vector<Attempt>> Attempts();
  // Returns the number of runs of the whole campaign.
  base::Result<std::int64_t> PlannedRuns();
  // Returns the paths of the varied parameters, in order.
  base::Result<std::vector<std::string>> Parameters();

 private:
  Results(broker::Database database, std::string file)
      : database_(std::move(database)), file_(std::move(file)) {}
  // Creates the tables for a campaign, or checks that they belong to it.
  base::Status Begin(const Campaign& campaign);
  // Returns SQLite's error with the name of the file and what to do.
  base::Failure<base::Error> Refused(const base::Error& error) const;
  base::Status Insert(const std::vector<RunResult>& results);
  base::Status Insert(const std::vector<Attempt>& attempts);

  broker::Database database_;
  const std::string file_;
  // Descriptor of the file whose lock excludes other writers; -1 if the file is only read.
  int lock_ = -1;
};

}  // namespace gsv::campaign
