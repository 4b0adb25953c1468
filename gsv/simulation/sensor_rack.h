// The sensors of one robot, and their newest readings.
//
// Threads  any. Sampling one sensor never holds up another.
#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "gsv/sensing/registry.h"
#include "gsv/simulation/snapshot_history.h"

namespace gsv::simulation {

// What readings of one simulation have in common.
struct SamplingSource {
  SnapshotHistory& history;
  sensing::RaySceneCache& rays;
  std::uint64_t seed;
};

class SensorRack {
 public:
  // The sensors of the robot's model are there from the start; a model's sensor of a type that is
  // not registered, or whose parameters are refused, is listed but fails when opened.
  SensorRack(std::string robot, const model::Model& model,
             std::shared_ptr<const sensing::SensorRegistry> types);
  ~SensorRack();

  std::vector<model::SensorDescription> Descriptions() const;
  std::vector<std::string> TypeNames() const { return types_->names(); }  // that can be created

  // Adds a sensor; it is open. `link_count` is that of the model.
  base::Status Create(model::SensorDescription description, int link_count);
  base::Status Open(const std::string& name);
  // A sensor that was created is gone with that; one of the model can be opened again.
  base::Status Close(const std::string& name);
  // Closes all, drops the created ones, forgets readings and counts.
  void Reset();

  // The newest sample: taken now if nobody has asked since its instant.
  base::Result<sensing::Reading> Read(const std::string& name, const SamplingSource& source);
  std::vector<std::string> OpenSensors() const;  // by name

  // Counts a reading handed to the behaviour.
  void CountReading(const std::string& name);
  std::map<std::string, std::uint64_t> readings_by_type() const;

 private:
  struct Slot;
  std::shared_ptr<Slot> Find(const std::string& name) const;
  base::Result<std::shared_ptr<Slot>> MakeSlot(model::SensorDescription description) const;

  const std::string robot_;
  const std::shared_ptr<const sensing::SensorRegistry> types_;
  mutable std::mutex mutex_;
  std::map<std::string, std::shared_ptr<Slot>> slots_;
  std::map<std::string, std::uint64_t> readings_by_type_;
};

}  // namespace gsv::simulation
