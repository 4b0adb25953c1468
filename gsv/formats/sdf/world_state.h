// The <state> of a world: where its models and lights were when Gazebo Classic saved it.
//
// The rules are Gazebo Classic's. Poses of models, links and lights are those in the world. Links
// have the last word: joints start where the poses of their links put them. Joint positions count
// where the links' poses are not written. Velocities are not read.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>

#include <tinyxml2.h>

#include "gsv/formats/sdf/reading_context.h"
#include "gsv/model/world_description.h"

namespace gsv::formats {

class WorldState {
 public:
  // Takes the states out of a <world>. What they insert becomes part of the world; a state of another
  // world's name is left out with a warning.
  void Read(tinyxml2::XMLElement& world, const ReadingContext& context);

  // Whether the state says that this model or light was deleted.
  bool IsDeleted(const std::string& name) const { return deleted_.count(name) != 0; }

  // Puts a model where the state has it, and its joints.
  void Apply(model::PlacedModel& placed) const;
  std::optional<geometry::Pose> LightPose(const std::string& name) const;

  // Warns of each model, link, joint and light of the states that `world`, once it is complete, does
  // not have.
  void ReportMissing(const model::WorldDescription& world, const ReadingContext& context) const;

 private:
  struct ModelState {
    std::string place;  // "file:line"
    std::optional<geometry::Pose> pose;
    std::map<std::string, geometry::Pose> links;  // "inner::link"
    std::map<std::string, double> joints;
  };

  struct LightState {
    geometry::Pose pose;
    std::string place;
  };

  void ReadState(tinyxml2::XMLElement& state, tinyxml2::XMLElement& world,
                 const ReadingContext& context);
  void ReadModel(const tinyxml2::XMLElement& element, const std::string& scope, int levels_left,
                 const ReadingContext& context, ModelState& state);
  static std::vector<double> PositionsOf(const model::Model& model, const ModelState& state,
                                         const geometry::Pose& world_from_model);

  std::map<std::string, ModelState> models_;
  std::map<std::string, LightState> lights_;
  std::set<std::string> deleted_;
};

}  // namespace gsv::formats
