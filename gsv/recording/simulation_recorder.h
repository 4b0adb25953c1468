// Records one simulation to an MCAP file while it runs (docs/formats/recording.md).
//
// The stepping thread passes its snapshots on. One thread of the recorder samples sensors and
// encodes messages, and another one writes the file. Recording does not change the simulation.
//
// One run     a reset of the simulation ends the recording.
// Errors      a failing disk ends the recording, never the simulation; Stop() returns the error.
// Threads     any; Stop() waits for the disk.
// Determinism two recordings of equal runs have equal content hashes, if the runs are in lockstep
//             and are recorded from their start.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "gsv/base/mutex.h"
#include "gsv/recording/attachments/scenario_attachment.h"
#include "gsv/recording/attachments/scene_attachments.h"
#include "gsv/recording/attachments/source_attachments.h"
#include "gsv/recording/topics/health_topic.h"
#include "gsv/recording/topics/sensor_recorder.h"
#include "gsv/recording/topics/simulation_feed.h"
#include "gsv/recording/topics/state_topics.h"

namespace gsv::recording {

// The options of a recording.
struct RecorderOptions {
  WriteGlb write_glb;               // required: writes a model as GLB
  double poses_rate = 50;           // in Hz of simulated time, > 0
  SensorRates sensors;              // maximum rates of the topics of sensors
  std::vector<std::string> topics;  // see Selection; empty for all topics
  WritePng write_png;               // encodes images; if empty, they are recorded as JPEG
  bool replace = false;             // whether to replace an existing file
  // The scenario to attach (default: ScenarioOf() of the simulation).
  std::optional<scenario::Scenario> scenario{};
  // Values that are added to the metadata record "gsv.simulation".
  StringMap metadata;
};

class SimulationRecorder {
 public:
  // Creates the file with the present scene and models, and begins to record. The past is
  // not recorded, except for edits before the start of the simulation, which resimulation
  // needs.
  [[nodiscard]] static base::Result<std::unique_ptr<SimulationRecorder>> Start(
      const std::shared_ptr<simulation::Simulation>& simulation, const std::string& path,
      RecorderOptions options);
  // Stops recording. Logs an error unless Stop() has returned it.
  ~SimulationRecorder();

  // Ends the recording, and writes the queue and the end of the file. Later calls do nothing.
  // Returns the error that ended the recording early, if there was one.
  base::Status Stop();

  // Whether the recording continues. A recording ends at Stop(), when the simulation is reset or
  // destroyed, and when the disk fails.
  bool is_recording() const;
  McapWriter::Progress progress() const { return writer_->progress(); }

 private:
  SimulationRecorder(const std::shared_ptr<simulation::Simulation>& simulation,
                     std::unique_ptr<McapWriter> writer, RecorderOptions options);

  // Records the present state, and the edits before the start.
  void RecordFirst(const simulation::Simulation& simulation);
  // The function of thread_: records everything that the feed delivers.
  void Run();
  void Record(const Occurrence& occurrence);
  void Record(const Observation& observation);
  // Records status, expectations and health, if the observation has a status.
  void RecordStatusOf(const Observation& observation);
  // Records the latest state and the result, and closes the file.
  void WriteEnd();

  const std::weak_ptr<simulation::Simulation> simulation_;
  const std::unique_ptr<McapWriter> writer_;
  const std::shared_ptr<const sensing::SensorRegistry> types_;
  // The parts of the recording: topics of the simulation, topics of sensors, health, and
  // attachments.
  StateTopics states_;
  SensorRecorder sensors_;
  HealthTopic health_;
  SceneAttachments scene_;
  SourceAttachments sources_;
  std::shared_ptr<SimulationFeed> feed_;           // snapshots and events to record
  std::shared_ptr<const world::Snapshot> latest_;  // the last recorded snapshot
  std::atomic<bool> has_ended_ = false;            // whether the recording has ended

  base::Mutex stopping_;  // locked while the recording is stopped
  bool is_stopped_ GSV_GUARDED_BY(stopping_) = false;
  StringMap result_;    // set before the feed is closed, and read after the feed's end
  std::thread thread_;  // executes Run()
};

}  // namespace gsv::recording
