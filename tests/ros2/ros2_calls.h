// Calls services as rmw_cyclonedds does, and uses an action.
#pragma once

#include <istream>

#include "tests/ros2/ros2_participant.h"

namespace gsv::ros2_peer {

// Reads calls, one per line. For each call, prints the response as JSON on one line. A line
// contains the name of a service of /gsv and its arguments:
//
//   cancel_goal ID
//   delete_entity ENTITY
//   feedback COUNT
//   get_available_worlds
//   get_current_world
//   get_entities [FILTER]
//   get_entities_states [FILTER]
//   get_entity_bounds ENTITY
//   get_entity_info ENTITY
//   get_entity_state ENTITY
//   get_named_pose_bounds NAME
//   get_named_poses
//   get_parameters NAME
//   get_result ID
//   get_simulation_state
//   get_simulator_features
//   get_spawnables
//   list_parameters
//   load_world URI [-|strict [TEXT]]
//   reset_simulation SCOPE
//   send_goal ID STEPS
//   set_entity_info ENTITY
//   set_entity_state ENTITY X Y Z [SPEED]
//   set_simulation_state STATE
//   spawn_entity URI NAME NAMESPACE X Y Z
//   step_simulation STEPS
//   unload_world
//
// "-" stands for an empty text. ID is a number from 1 to 255. `feedback` prints the next messages
// of the action's topic. Returns an exit code.
int CallAll(Participant& participant, std::istream& lines);

// Sends `count` calls of get_entity_state, with at most `window` calls in progress at a time, and
// prints the number of replies that match their requests.
int CallMany(Participant& participant, const std::string& entity, int count, int window);

}  // namespace gsv::ros2_peer
