// The recordings under way in this process, one a simulation at most.
//
// Threads  any; starting writes the models, stopping waits for the disk. Whoever asks how a
//          recording stands waits for neither.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/base/mutex.h"
#include "gsv/gateway/program/ports.h"
#include "gsv/scenario/scenario.h"

namespace gsv::recording {
class SimulationRecorder;
}

namespace gsv::app {

// Keys of the metadata record "gsv.simulation": how the recording program was called, as a JSON
// array of its arguments, and in which folder.
inline constexpr std::string_view kArgumentsKey = "arguments";
inline constexpr std::string_view kFolderKey = "folder";

// What is recorded, and how; rates in Hz of simulated time.
struct RecordingChoice {
  std::vector<std::string> topics;  // empty: all; one that ends in "/" stands for all below it
  double poses_rate = 50, readings_rate = 20, pictures_rate = 1, beams_rate = 10;
  bool png = false;  // pictures, else JPEG
  // What is attached as the scenario; without it what can be seen of the simulation.
  std::optional<scenario::Scenario> scenario{};
};

// A command line as it may be told to others: without tokens.
std::vector<std::string> WithoutSecrets(std::vector<std::string> arguments);

// Of a choice of topics that some would stand for none of `topics`: a sentence for each such one,
// with what there is instead.
std::vector<std::string> ComplaintsAbout(const RecordingChoice& choice,
                                         const std::vector<std::string>& topics);

// Sets one rate, from "KIND=HZ" with poses, readings, pictures or beams.
base::Status SetRate(const std::string& text, RecordingChoice& choice);

// The folder that is meant, whole; empty: the current one. kInvalidArgument: it is none.
base::Result<std::filesystem::path> RecordingsFolder(const std::filesystem::path& folder);

class Recordings final : public gateway::RecordingSwitch {
 public:
  // `folder`: where recordings go that are switched on in the viewer.
  explicit Recordings(std::filesystem::path folder);
  ~Recordings() override;

  // Only recordings of this simulation contain the arguments of this process: those of its `gsv
  // run`, with which the recording can be simulated again.
  void SetSimulationOfCommand(const std::shared_ptr<simulation::Simulation>& simulation);

  // `path` ends in ".mcap": a bare file; else a folder that rosbag2 opens. kInvalidArgument when
  // the simulation is being recorded, or something of that name is there already.
  base::Status Start(std::shared_ptr<simulation::Simulation> simulation, const std::string& path,
                     const RecordingChoice& choice = {});
  const std::filesystem::path& folder() const { return folder_; }

  // To NAME-TIME.mcap in that folder, with what is recorded if nothing else is said.
  base::Status Record(const std::shared_ptr<simulation::Simulation>& simulation) override;
  base::Status StopRecording(const std::string& simulation) override { return Stop(simulation); }
  State RecordingOf(const std::string& simulation) override;
  Totals totals() override;
  // kNotFound when that simulation is not recorded. Another error is why the recording ended early.
  base::Status Stop(const std::string& simulation);
  // The first error, if there is one; the others are logged.
  base::Status StopAll();

 private:
  struct Recording {
    std::weak_ptr<simulation::Simulation> simulation;
    std::string path;
    std::string bag;  // the file in a rosbag2 folder; empty: a bare file
    std::unique_ptr<recording::SimulationRecorder> recorder;
  };
  // Makes room for a new one. kInvalidArgument when the simulation is being recorded.
  base::Status FinishThatWhichIsOver(const std::shared_ptr<simulation::Simulation>& simulation);
  static base::Status Finish(Recording& recording);
  static State StateOf(const Recording& recording);
  static void Add(const State& state, Totals& totals);
  void CountEnded(const Recording& recording);

  const std::filesystem::path folder_;
  base::Mutex starting_;  // one at a time; taken before mutex_
  base::Mutex mutex_;     // never held while the disk is waited for
  std::map<std::string, Recording> recordings_ GSV_GUARDED_BY(mutex_);  // by the simulation's name
  std::map<std::string, State> last_
      GSV_GUARDED_BY(mutex_);            // that ended, by the simulation's name
  Totals ended_ GSV_GUARDED_BY(mutex_);  // of those that ended
  Totals told_ GSV_GUARDED_BY(mutex_);   // last
  std::weak_ptr<simulation::Simulation> of_command_ GSV_GUARDED_BY(mutex_);
};

}  // namespace gsv::app
