#include "gsv/gateway/history/history_api.h"

#include <algorithm>
#include <charconv>
#include <utility>

#include <nlohmann/json.hpp>

#include "gsv/base/sorting.h"
#include "gsv/gateway/api/simulation_routes.h"
#include "gsv/gateway/recorded/recorded_timeline.h"
#include "gsv/gateway/recordings/note_request.h"
#include "gsv/presentation/notes.h"

namespace gsv::gateway::history {
namespace {

using HistoryJson = nlohmann::ordered_json;

constexpr std::size_t kMaxPastEvents = 1000;

std::string Text(const HistoryJson& json) {
  return json.dump(-1, ' ', false, HistoryJson::error_handler_t::replace);
}

Response NoHistory() {
  return ErrorResponse(404, "this server keeps no past of its simulations (--history 0)");
}

// Returns the time of the query ?from_s=T; 0 if it is absent.
base::Result<base::SimTime> FromTime(const Request& request) {
  const auto from = request.target.query.find("from_s");
  if (from == request.target.query.end()) return base::SimTime(0);
  const std::string& text = from->second;
  double seconds = -1;
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), seconds);
  const bool is_number = parsed.ec == std::errc() && parsed.ptr == text.data() + text.size();
  if (is_number && seconds >= 0 && seconds < 9e9) return base::FromSeconds(seconds);
  return base::Fail(base::ErrorCode::kInvalidArgument,
                    "'from_s' must be a time in simulated seconds, from 0 on");
}

// Returns the newest events and notes, and the collisions of the history, ordered by time. Leaves
// out events and collisions before `from`, and notes that were made before `from`.
std::vector<RecordedEvent> EventsOf(const simulation::Simulation& simulation,
                                    const std::vector<recording::Collision>& collisions,
                                    base::SimTime from) {
  std::vector<RecordedEvent> events;
  for (const simulation::Event& event : simulation.events(0)) {
    if (event.kind == "reset") events.clear();  // earlier events belong to another run
    if (event.time < from) continue;
    if (presentation::IsNote(event)) {
      events.push_back({presentation::TimeOfNote(event), event.kind, event.robot,
                        presentation::NoteMessage(event).detail});
    } else {
      events.push_back({event.time, event.kind, event.robot, event.detail});
    }
  }
  if (events.size() > kMaxPastEvents) events.erase(events.begin(), events.end() - kMaxPastEvents);
  for (const recording::Collision& collision : collisions) {
    if (collision.time < from) continue;
    events.push_back(CollisionEvent(collision.time, collision.robot, collision.other));
  }
  base::Sort(events,
             [](const RecordedEvent& a, const RecordedEvent& b) { return a.time < b.time; });
  return events;
}

}  // namespace

std::vector<Route> HistoryApi::Routes() {
  using enum Permission;
  using enum Pool;
  const auto of = [this](SimulationHandler handler) {
    return OfSimulation(directory_, std::move(handler));
  };
  const std::string simulation = "/api/simulations/{name}";
  return {
      {"GET", simulation + "/history", kWatch, false, kReaders,
       of([this](const auto& of_name, const Request&) { return Extent(of_name); }),
       "Get the part of a simulation's past that the server stores"},
      {"POST", simulation + "/history", kWatch, false, kCommanders,
       of([this](const auto& of_name, const Request&) { return Open(of_name); }),
       "Open the stored past of a simulation as your own replay"},
      {"GET", simulation + "/events", kWatch, false, kReaders,
       of([this](const auto& of_name, const Request& request) { return Events(of_name, request); }),
       "List the events of a simulation or of a recording"},
      {"POST", simulation + "/notes", kControl, true, kReaders,
       of([this](const auto& of_name, const Request& request) {
         return AddNote(of_name, request.body);
       }),
       "Add a note to an instant of a running simulation"},
  };
}

Response HistoryApi::Extent(const SimulationPointer& simulation) {
  if (histories_ == nullptr) return NoHistory();
  const auto history = histories_->Of(simulation);
  const recording::ChunkRing::Extent extent = history->extent();
  return JsonResponse(200, Text({{"start_s", base::ToSeconds(extent.start)},
                                 {"end_s", base::ToSeconds(extent.end)},
                                 {"size_bytes", extent.bytes},
                                 {"capacity_bytes", history->capacity()}}));
}

Response HistoryApi::Open(const SimulationPointer& simulation) {
  if (histories_ == nullptr) return NoHistory();
  auto reader = histories_->Of(simulation)->Open();
  if (!reader) return ErrorResponse(reader.error());
  // The replay gets the models from the store. The store finds only models that it has identified,
  // so it must identify the simulation's models now.
  for (const world::Body& body : simulation->snapshot()->layout->bodies) {
    (void)models_.Identify(body.model);
    (void)models_.IdentifyCollisions(body.model);
  }
  auto player =
      ReplayPlayer::Open(*std::move(reader), simulation->specification().name, {},
                         [&models = models_](const std::string& id) { return models.Glb(id); });
  if (!player) return ErrorResponse(player.error());
  const auto session = sessions_->Add(*std::move(player), "");
  if (!session) return ErrorResponse(session.error());
  return JsonResponse(201, Text({{"base", "replays/" + *session + "/"}}));
}

Response HistoryApi::Events(const SimulationPointer& simulation, const Request& request) {
  const auto from = FromTime(request);
  if (!from) return ErrorResponse(from.error());
  const auto collisions = histories_ != nullptr ? histories_->Of(simulation)->collisions()
                                                : std::vector<recording::Collision>();
  HistoryJson list = HistoryJson::array();
  for (const RecordedEvent& event : EventsOf(*simulation, collisions, *from)) {
    list.push_back({{"time_s", base::ToSeconds(event.time)},
                    {"event", event.event},
                    {"robot", event.robot},
                    {"detail", event.detail}});
  }
  return JsonResponse(200, Text(list));
}

Response HistoryApi::AddNote(const SimulationPointer& simulation, const std::string& body) {
  const auto note = recordings::ParseNoteRequest(body);
  if (!note) return ErrorResponse(note.error());
  const base::SimTime now = simulation->snapshot()->state.time;
  const base::SimTime time = note->time_s ? std::min(base::FromSeconds(*note->time_s), now) : now;
  simulation->Emit(presentation::kNoteEvent, "", presentation::NoteDetail(time, note->text));
  return JsonResponse(201, Text({{"time_s", base::ToSeconds(time)}}));
}

}  // namespace gsv::gateway::history
