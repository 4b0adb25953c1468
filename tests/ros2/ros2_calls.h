// Calls services as rmw_cyclonedds does, and uses an action.
#pragma once

#include <istream>

#include "tests/ros2/ros2_participant.h"

namespace gsv::ros2_peer {

// Reads calls, one per line. For each call, prints the response as JSON on one line. A line
// contains the name of a service of /gsv and its arguments:
//
//   get_simulator_features     get_entities [FILTER]      get_entities_states [FILTER]
//   get_entity_info ENTITY get_entity_state ENTITY    get_entity_bounds ENTITY   set_entity_state
//   ENTITY X Y Z [SPEED] spawn_entity URI NAME NAMESPACE X Y Z                 delete_entity ENTITY
//   get_spawnables get_current_world          get_available_worlds       load_world URI [-|strict
//   [TEXT]] unload_world               get_named_poses            set_entity_info ENTITY
//   get_named_pose_bounds NAME get_simulation_state       set_simulation_state STATE
//   reset_simulation SCOPE     step_simulation STEPS      list_parameters
//   get_parameters NAME send_goal ID STEPS         get_result ID              cancel_goal ID
//   feedback COUNT
//
// "-" stands for an empty text. ID is a number from 1 to 255. `feedback` prints the next messages
// of the action's topic. Returns an exit code.
int CallAll(Participant& participant, std::istream& lines);

// Sends `count` calls of get_entity_state, with at most `window` calls in progress at a time, and
// prints the number of replies that match their requests.
int CallMany(Participant& participant, const std::string& entity, int count, int window);

}  // namespace gsv::ros2_peer
