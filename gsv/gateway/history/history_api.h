// HistoryApi is the part of the HTTP API about the past of running simulations. It serves the time
// range of the history, its replay, the events so far, and the notes of viewers.
//
// Threads  any.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "gsv/gateway/api/model_store.h"
#include "gsv/gateway/history/histories.h"
#include "gsv/gateway/http/route.h"
#include "gsv/gateway/recordings/replay_sessions.h"

namespace gsv::gateway::history {

// The part of the HTTP API about the past of running simulations.
class HistoryApi {
 public:
  // If no history is kept, `histories` is null and `sessions` may be null. Then only the events and
  // notes are served. All arguments must outlive this object.
  HistoryApi(std::shared_ptr<SimulationDirectory> directory, Histories* histories,
             recordings::ReplaySessions* sessions, ModelStore& models)
      : directory_(std::move(directory)),
        histories_(histories),
        sessions_(sessions),
        models_(models) {}

  // The handlers are valid during the lifetime of this object.
  std::vector<Route> Routes();

 private:
  using SimulationPointer = Histories::SimulationPointer;

  // Responds with the time range and the size of the history.
  Response Extent(const SimulationPointer& simulation);
  // Opens a replay of the past.
  Response Open(const SimulationPointer& simulation);
  // Responds with the events so far.
  Response Events(const SimulationPointer& simulation, const Request& request);
  // Adds a note of a viewer.
  Response AddNote(const SimulationPointer& simulation, const std::string& body);

  const std::shared_ptr<SimulationDirectory> directory_;
  Histories* const histories_;
  recordings::ReplaySessions* const sessions_;
  ModelStore& models_;
};

}  // namespace gsv::gateway::history
