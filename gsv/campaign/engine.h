// The engines that execute the runs of a campaign, and their registry. Another engine is one source
// file that defines an EngineType, and a line in engine.cc.
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "gsv/campaign/commands.h"
#include "gsv/campaign/job_queue.h"

namespace gsv::scenario {
class YamlMapping;
}

namespace gsv::campaign {

// The arguments of a queue's constructor. `commands` must outlive the queue.
struct QueueContext {
  CommandRunner& commands;
  std::string program;                                   // the path of gsv on other machines
  std::function<void(const std::string& sentence)> say;  // prints for the user
  std::function<std::chrono::steady_clock::time_point()> now = &std::chrono::steady_clock::now;
};
using MakeQueue = std::function<std::unique_ptr<JobQueue>(const QueueContext&)>;

// An option of `gsv campaign run` that sets a text in the engine's mapping.
struct EngineOption {
  std::string flag;  // "--partition"
  std::string key;   // in the mapping
  std::string help;
  bool is_list = false;  // appended to the list under the key instead of replacing it
};

struct EngineType {
  std::string name;   // as in `engine: NAME` and --engine NAME; the key of the engine's mapping
  std::string title;  // in sentences: "Slurm"
  std::string help;
  std::vector<EngineOption> options;
  std::chrono::milliseconds poll_period{10'000};  // between queries of the queue
  bool outlives_driver = true;                    // whether tasks continue without the driver
  std::string after_interrupt;                    // a clause about the tasks after an interrupt
  // Reads the engine's mapping and reports its errors; it does not contact the queue. Empty: this
  // process executes the runs itself, and there is no mapping.
  std::function<MakeQueue(scenario::YamlMapping& mapping)> read;
};

// The first is the default.
const std::vector<EngineType>& EngineTypes();

// The engine options of the command line. They take precedence over the campaign's file.
struct EngineRequest {
  std::string name;                                         // empty: as in the file
  std::size_t runs_per_task = 0;                            // 0: as in the file
  std::map<std::string, std::vector<std::string>> options;  // values by the option's flag
};

// The engine of one campaign.
struct Engine {
  const EngineType* type = nullptr;
  std::size_t runs_per_task = 0;  // 0: the driver chooses
  MakeQueue make_queue;           // empty: this process executes the runs
};

// Reads the keys of a campaign's file that choose where its runs are executed: `engine`, and a
// mapping for each engine that has one.
Engine ReadEngine(scenario::YamlMapping& campaign, const EngineRequest& request);

}  // namespace gsv::campaign
