// What came of a campaign's runs: one SQLite file.
//
// Format   tables `campaign` (key, value) and `runs` (run, parameters, status, message, state_hash,
//          sim_time_s, wall_s, recording, metrics; parameters and metrics are JSON objects), in WAL
//          mode: what was added survives the end of the process at any moment. A run is in it once,
//          or not yet.
// Threads  one at a time. One process at a time adds: the others are refused.
#pragma once

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

class Results {
 public:
  // For a driver: makes the file if there is none. Refuses one of another campaign, one that is no
  // results' file, and one that another driver adds to.
  static base::Result<std::unique_ptr<Results>> OpenToAdd(const std::string& file,
                                                          const Campaign& campaign);
  // To look at; kNotFound when there is none.
  static base::Result<std::unique_ptr<Results>> Open(const std::string& file);
  ~Results();

  // All of them, or none. A run that is there already stays as it was.
  base::Status Add(const std::vector<RunResult>& results);

  base::Result<std::set<std::int64_t>> DoneRuns();
  base::Result<std::vector<RunResult>> All();  // by number
  base::Result<std::int64_t> PlannedRuns();
  // The paths that are varied, in order.
  base::Result<std::vector<std::string>> Parameters();

 private:
  explicit Results(broker::Database database) : database_(std::move(database)) {}
  base::Status Begin(const Campaign& campaign, const std::string& file);

  broker::Database database_;
  int lock_ = -1;
};

}  // namespace gsv::campaign
