// The engines that have a campaign's runs done, and their registry. Another engine is one source
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

// What a queue works with; `commands` outlives it.
struct QueueContext {
  CommandRunner& commands;
  std::string program;                                   // gsv, as other machines find it
  std::function<void(const std::string& sentence)> say;  // to whoever started the campaign
  std::function<std::chrono::steady_clock::time_point()> now = &std::chrono::steady_clock::now;
};
using MakeQueue = std::function<std::unique_ptr<JobQueue>(const QueueContext&)>;

// An option of `gsv campaign run` that sets a text in the engine's mapping.
struct EngineOption {
  std::string flag;  // "--partition"
  std::string key;   // in the mapping
  std::string help;
  bool is_list = false;  // added to the list under the key, rather than put in its place
};

struct EngineType {
  std::string name;   // as in `engine: NAME` and --engine NAME; the key of the engine's mapping
  std::string title;  // in sentences: "Slurm"
  std::string help;
  std::vector<EngineOption> options;
  std::chrono::milliseconds poll_period{10'000};  // between questions to the queue
  bool outlives_driver = true;                    // whether tasks go on without the driver
  std::string after_interrupt;                    // a clause: what becomes of the tasks then
  // Reads the engine's mapping and complains of it, but asks no queue anything. Empty: this process
  // does the runs itself, and there is no mapping.
  std::function<MakeQueue(scenario::YamlMapping& mapping)> read;
};

// The first is the default.
const std::vector<EngineType>& EngineTypes();

// What the command line says about the engine; it goes before the campaign's file.
struct EngineRequest {
  std::string name;                                         // empty: the file's
  std::size_t runs_per_task = 0;                            // 0: the file's
  std::map<std::string, std::vector<std::string>> options;  // values by the option's flag
};

// The engine of one campaign.
struct Engine {
  const EngineType* type = nullptr;
  std::size_t runs_per_task = 0;  // 0: the driver chooses
  MakeQueue make_queue;           // empty: this process does the runs itself
};

// Reads the keys of a campaign's file that say where its runs are done: `engine`, and a mapping for
// each engine that has one.
Engine ReadEngine(scenario::YamlMapping& campaign, const EngineRequest& request);

}  // namespace gsv::campaign
