// A WorldState reads the <state> of a world: the poses of models and lights at the time when Gazebo
// Classic saved the world.
//
// This follows the rules of Gazebo Classic. Poses of models, links and lights are in the world
// frame. The poses of links take precedence: joints start at the positions that follow from them.
// Saved joint positions are used only if the poses of links are missing. Velocities are not read.
#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>

#include <tinyxml2.h>

#include "gsv/formats/sdf/reading_context.h"
#include "gsv/model/world_description.h"

namespace gsv::formats {

// Whether a <state> is one of this <world>, and not of a world with another name.
bool IsStateOf(const tinyxml2::XMLElement& world, const tinyxml2::XMLElement& state);
// Moves the models and lights that a <state> inserts to the end of the <world>.
void TakeInsertions(tinyxml2::XMLElement& state, tinyxml2::XMLElement& world);
// Adds the names of the models and lights that a <state> deletes.
void AddDeletions(const tinyxml2::XMLElement& state, std::set<std::string>& names);

// The <state> of a world, as Gazebo Classic saves it.
class WorldState {
 public:
  // Reads the <state> elements of a <world>, and removes them. Models that a state inserts become a
  // part of the world. A state of another world is left out with a warning.
  void Read(tinyxml2::XMLElement& world, const ReadingContext& context);

  // Whether the state deletes this model or light.
  bool IsDeleted(const std::string& name) const { return deleted_.count(name) != 0; }

  // Sets the pose and the joint positions of a model from the state. Warns of a loop of joints that
  // is open at these positions.
  void Apply(model::PlacedModel& placed, const ReadingContext& context) const;
  // Returns the pose of a light in the state; nullopt if it has none.
  std::optional<geometry::Pose> LightPose(const std::string& name) const;

  // Warns of each model, link, joint and light in the states that the complete `world` does not
  // have.
  void ReportMissing(const model::WorldDescription& world, const ReadingContext& context) const;

 private:
  // The saved state of a model.
  struct ModelState {
    std::string place;                            // "file:line"
    std::optional<geometry::Pose> pose;           // pose of the model in the world
    std::map<std::string, geometry::Pose> links;  // "inner::link"
    std::map<std::string, double> joints;         // saved joint positions, by "inner::joint"
  };

  // The saved state of a light.
  struct LightState {
    geometry::Pose pose;  // in the world
    std::string place;    // place of the element in the file, for messages
  };

  // Reads one <state> element.
  void ReadState(tinyxml2::XMLElement& state, tinyxml2::XMLElement& world,
                 const ReadingContext& context);
  // Reads the poses and joint positions of a model. `scope` is the prefix of its links.
  void ReadModel(const tinyxml2::XMLElement& element, const std::string& scope, int levels_left,
                 const ReadingContext& context, ModelState& state);
  // Returns the joint positions that follow from the saved poses of the links, or else the saved
  // positions. Returns an empty list if all positions are zero.
  static std::vector<double> PositionsOf(const model::Model& model, const ModelState& state,
                                         const geometry::Pose& world_from_model);

  std::map<std::string, ModelState> models_;  // by the model's name
  std::map<std::string, LightState> lights_;  // by the light's name
  std::set<std::string> deleted_;             // names of the deleted models and lights
};

}  // namespace gsv::formats
