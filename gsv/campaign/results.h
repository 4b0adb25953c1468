// The results of a campaign's runs: one SQLite file.
//
// Format   tables `campaign` (key, value), `runs` (run, parameters, status, message, state_hash,
//          sim_time_s, wall_s, recording, metrics; parameters and metrics are JSON objects) and
//          `attempts` (the fields of Attempt), in WAL mode: added rows survive the end of the
//          process at any time. A run has at most one row.
// Threads  one at a time. Only one process at a time may write; others are refused.
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

struct RunResult {
  std::int64_t run = 0;
  std::string status;   // "passed", "failed", "error"
  std::string message;  // why it did not pass
  std::string state_hash;
  double sim_time = 0, wall_time = 0;  // s
  std::string recording;               // a file; empty: none
  nlohmann::ordered_json parameters = nlohmann::ordered_json::object();
  nlohmann::ordered_json metrics = nlohmann::ordered_json::object();  // numbers by name
};

// One process that executed a share of the runs on one machine.
struct Attempt {
  std::string journal;  // its file
  std::string share;    // its share; other attempts may have the same
  std::string job;      // the queue's name of the job; empty without a queue
  std::string node;     // the machine
  int at_once = 1;      // runs
  double submitted = 0, started = 0, ended = 0;  // s since 1970; ended: as far as is known
  std::size_t runs = 0;                          // executed runs
  double run_seconds = 0;                        // sum of their wall-clock times

  friend bool operator==(const Attempt&, const Attempt&) = default;
};

class Results {
 public:
  // For a driver: creates the file if it does not exist. Fails for a file of another campaign, a
  // file that does not hold results, and one that another process still writes after `timeout`
  // (kNotRunning). A process that only collects results ends soon.
  static base::Result<std::unique_ptr<Results>> OpenToAdd(
      const std::string& file, const Campaign& campaign,
      std::chrono::milliseconds timeout = std::chrono::milliseconds(0));
  // Opens the file for reading; kNotFound if it does not exist.
  static base::Result<std::unique_ptr<Results>> Open(const std::string& file);
  ~Results();

  // Adds all of them or none. A run that has a result keeps it; an attempt of the same journal is
  // replaced.
  base::Status Add(const std::vector<RunResult>& results,
                   const std::vector<Attempt>& attempts = {});

  base::Result<std::set<std::int64_t>> DoneRuns();
  base::Result<std::size_t> NotPassed();
  base::Result<std::vector<RunResult>> All();     // by number
  base::Result<std::vector<Attempt>> Attempts();  // by the instant at which they started
  base::Result<std::int64_t> PlannedRuns();
  // The paths of the varied parameters, in order.
  base::Result<std::vector<std::string>> Parameters();

 private:
  Results(broker::Database database, std::string file)
      : database_(std::move(database)), file_(std::move(file)) {}
  base::Status Begin(const Campaign& campaign);
  // SQLite's error, with the file and what to do.
  tl::unexpected<base::Error> Refused(const base::Error& error) const;
  base::Status Insert(const std::vector<RunResult>& results);
  base::Status Insert(const std::vector<Attempt>& attempts);

  broker::Database database_;
  const std::string file_;
  int lock_ = -1;
};

}  // namespace gsv::campaign
