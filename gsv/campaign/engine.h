// The engines that execute the runs of a campaign, and their registry. To add an engine, write one
// source file that defines an EngineType, and add a line to engine.cc.
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
  CommandRunner& commands;  // runs the programs of the queue, such as sbatch
  std::string program;      // the path of gsv on other machines
  std::function<void(const std::string& sentence)> say;  // prints a sentence for the user
  // Returns the present time; tests replace it.
  std::function<std::chrono::steady_clock::time_point()> now = &std::chrono::steady_clock::now;
};
// Makes the queue of an engine, with the settings that were read from the campaign's file.
using MakeQueue = std::function<std::unique_ptr<JobQueue>(const QueueContext&)>;

// An option of `gsv campaign run` that sets a key of the engine in the campaign file.
struct EngineOption {
  std::string flag;      // "--partition"
  std::string key;       // the engine's key in the campaign file
  std::string help;      // the option's text in --help
  bool is_list = false;  // whether values are appended to the list under the key
};

// A kind of engine, such as Slurm.
struct EngineType {
  // the engine's name in `engine: NAME` and --engine NAME; also the key of the engine's mapping
  std::string name;
  std::string title;  // the name in sentences, such as "Slurm"
  std::string help;   // the engine's text in --help
  std::vector<EngineOption> options;
  std::chrono::milliseconds poll_period{10'000};  // time between queries of the queue
  // whether tasks continue if the driver ends, the process of `gsv campaign run` (queue_driver.h)
  bool outlives_driver = true;
  std::string after_interrupt;  // a clause that says what happens to the tasks after an interrupt
  // Reads the engine's mapping and reports its errors, without contacting the queue. If the
  // function is empty, this process executes the runs itself, and there is no mapping.
  std::function<MakeQueue(scenario::YamlMapping& mapping)> read;
};

// Returns all engines. The first one is the default.
const std::vector<EngineType>& EngineTypes();

// The options of the command line that concern the engine. They override the campaign's file.
struct EngineRequest {
  std::string name;               // empty for the engine in the file
  std::size_t runs_per_task = 0;  // 0 for the number in the file
  // values of the engine's options, by the flag of the option
  std::map<std::string, std::vector<std::string>> options;
};

// The engine that a campaign uses.
struct Engine {
  const EngineType* type = nullptr;
  std::size_t runs_per_task = 0;  // 0 if the driver (queue_driver.h) chooses the number
  MakeQueue make_queue;           // empty if this process executes the runs
};

// Reads the keys of a campaign's file that choose where its runs are executed: `engine`, and the
// mapping of each engine that has one.
Engine ReadEngine(scenario::YamlMapping& campaign, const EngineRequest& request);

}  // namespace gsv::campaign
