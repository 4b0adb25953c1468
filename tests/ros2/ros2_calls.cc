#include "tests/ros2/ros2_calls.h"

#include <functional>
#include <map>
#include <memory>
#include <sstream>
#include <utility>

#include "ros2_types.h"

namespace gsv::ros2_peer {
namespace {

using Words = std::vector<std::string>;

char* Text(const std::string& text) { return const_cast<char*>(text.c_str()); }

char* Text(const char* text) { return const_cast<char*>(text); }

// Returns the argument, or an empty text if it is missing or "-".
std::string Word(const Words& words, std::size_t i) {
  return i >= words.size() || words[i] == "-" ? std::string() : words[i];
}
double Number(const Words& words, std::size_t i) { return std::atof(Word(words, i).c_str()); }

template <typename Id>
void SetId(Id& id, const Words& words) {
  id[15] = static_cast<std::uint8_t>(Number(words, 0));
}

// A client of one service of /gsv.
template <typename Request, typename Response>
class Client {
 public:
  Client(Participant& participant, const dds_topic_descriptor_t& request,
         const dds_topic_descriptor_t& response, const std::string& name)
      : participant_(participant),
        writer_(participant.Requester(request, name)),
        reader_(participant.ReplyReader(response, name)) {
    participant.Watch(reader_);
  }

  // Returns false if the server is not found within the time limit.
  bool Connect() {
    dds_publication_matched_status_t out{};
    dds_subscription_matched_status_t in{};
    for (;;) {
      dds_get_publication_matched_status(writer_, &out);
      dds_get_subscription_matched_status(reader_, &in);
      if (out.current_count > 0 && in.current_count > 0) return true;
      if (!participant_.Pause()) return false;
    }
  }
  void Send(Request& request) {
    dds_guid_t guid{};
    dds_get_guid(writer_, &guid);
    std::copy_n(guid.v, sizeof client_, reinterpret_cast<std::uint8_t*>(&client_));
    request.guid = client_;
    request.number = ++number_;
    if (dds_write(writer_, &request) < 0) Die("a request cannot be sent");
  }
  // Passes the received replies to this client's requests to `use`.
  template <typename Use>
  int Take(Use use) {
    int count = 0;
    while (TakeOne(reader_, [&](const void* sample) {
      const Response& response = *static_cast<const Response*>(sample);
      if (response.guid != client_) return;  // another client's
      ++count;
      use(response);
    })) {
    }
    return count;
  }
  bool Call(Request& request, const std::function<void(const Response&)>& use) {
    if (!Connect()) return false;
    Send(request);
    while (Take(use) == 0) {
      if (!participant_.WaitForData()) return false;
    }
    return true;
  }
  std::int64_t number() const { return number_; }

 private:
  Participant& participant_;
  const dds_entity_t writer_, reader_;
  decltype(Request::guid) client_ = 0;
  std::int64_t number_ = 0;
};

Json Of(const simulation_interfaces_msg_dds__Result_& result) {
  return {{"result", result.result}, {"error_message", result.error_message}};
}
Json Of(const geometry_msgs_msg_dds__Vector3_& v) { return Json::array({v.x, v.y, v.z}); }
Json Of(const simulation_interfaces_msg_dds__EntityState_& state) {
  const auto& p = state.pose.position;
  const auto& q = state.pose.orientation;
  return {{"frame_id", state.header.frame_id},
          {"position", {p.x, p.y, p.z}},
          {"orientation", {q.x, q.y, q.z, q.w}},
          {"linear", Of(state.twist.linear)},
          {"angular", Of(state.twist.angular)}};
}
Json Of(const simulation_interfaces_msg_dds__Bounds_& bounds) {
  Json points = Json::array();
  for (std::uint32_t i = 0; i < bounds.points._length; ++i) {
    points.push_back(Of(bounds.points._buffer[i]));
  }
  return {{"type", bounds.type}, {"points", std::move(points)}};
}
template <typename Sequence>
Json List(const Sequence& sequence) {
  Json list = Json::array();
  for (std::uint32_t i = 0; i < sequence._length; ++i) list.push_back(sequence._buffer[i]);
  return list;
}

// Calls one of GSV's services, with the words of an input line as arguments. Returns false if no
// response came.
using Call = std::function<bool(const Words& words)>;

class Calls {
 public:
  explicit Calls(Participant& participant) : participant_(participant) {
    AddQueries();
    AddChanges();
    AddRun();
    AddParameters();
    AddAction();
  }
  const Call* Find(const std::string& name) const {
    const auto found = calls_.find(name);
    return found == calls_.end() ? nullptr : &found->second;
  }

 private:
  // `fill` sets the request, and `json` reads the response.
  template <typename Request, typename Response, typename Fill, typename ToJsonOf>
  void Add(const std::string& name, const dds_topic_descriptor_t& request,
           const dds_topic_descriptor_t& response, Fill fill, ToJsonOf json) {
    const std::size_t slash = name.rfind('/');
    const std::string word = slash == std::string::npos ? name : name.substr(slash + 1);
    auto client = std::make_shared<std::unique_ptr<Client<Request, Response>>>();
    calls_[word] = [this, client, name, &request, &response, fill, json](const Words& words) {
      if (*client == nullptr) {
        *client = std::make_unique<Client<Request, Response>>(participant_, request, response,
                                                              "/gsv/" + name);
      }
      Request sent{};
      fill(sent, words);
      return (*client)->Call(sent, [&](const Response& reply) { Print(json(reply)); });
    };
  }
  void AddQueries();
  void AddChanges();
  void AddRun();
  void AddParameters();
  void AddAction();

  Participant& participant_;
  std::map<std::string, Call> calls_;
};

#define GSV_CALL(NAME, PACKAGE, TYPE)                                       \
  Add<PACKAGE##_dds__##TYPE##_Request_, PACKAGE##_dds__##TYPE##_Response_>( \
      NAME, PACKAGE##_dds__##TYPE##_Request__desc, PACKAGE##_dds__##TYPE##_Response__desc,
#define GSV_SIMULATION_CALL(NAME, TYPE) GSV_CALL(NAME, simulation_interfaces_srv, TYPE)

constexpr auto kNothing = [](auto&, const Words&) {};
constexpr auto kResult = [](const auto& reply) -> Json { return Of(reply.result); };
constexpr auto kEntity = [](auto& request, const Words& words) {
  static std::string entity;
  entity = Word(words, 0);
  request.entity = Text(entity);
};
// Sets the filter. Without an argument, sets an empty text, because the pointer must not be null.
constexpr auto kFilter = [](auto& request, const Words& words) {
  static std::string filter;
  filter = Word(words, 0);
  request.filters.filter = Text(filter);
};

void Calls::AddQueries() {
  GSV_SIMULATION_CALL("get_simulator_features", GetSimulatorFeatures)
  kNothing, [](const auto& reply) -> Json {
    return {{"features", List(reply.features.features)},
            {"spawn_formats", List(reply.features.spawn_formats)},
            {"custom_info", reply.features.custom_info}};
  });
  GSV_SIMULATION_CALL("get_entities", GetEntities)
  kFilter, [](const auto& reply) -> Json {
    return {{"result", Of(reply.result)}, {"entities", List(reply.entities)}};
  });
  GSV_SIMULATION_CALL("get_entities_states", GetEntitiesStates)
  kFilter, [](const auto& reply) -> Json {
    Json states = Json::array();
    for (std::uint32_t i = 0; i < reply.states._length; ++i) {
      states.push_back(Of(reply.states._buffer[i]));
    }
    return {{"result", Of(reply.result)}, {"entities", List(reply.entities)}, {"states", states}};
  });
  GSV_SIMULATION_CALL("get_entity_info", GetEntityInfo)
  kEntity, [](const auto& reply) -> Json {
    return {{"result", Of(reply.result)},
            {"category", reply.info.category.category},
            {"description", reply.info.description}};
  });
  GSV_SIMULATION_CALL("get_entity_state", GetEntityState)
  kEntity, [](const auto& reply) -> Json {
    return {{"result", Of(reply.result)}, {"state", Of(reply.state)}};
  });
  GSV_SIMULATION_CALL("get_entity_bounds", GetEntityBounds)
  kEntity, [](const auto& reply) -> Json {
    return {{"result", Of(reply.result)}, {"bounds", Of(reply.bounds)}};
  });
  GSV_SIMULATION_CALL("get_spawnables", GetSpawnables)
  kNothing, [](const auto& reply) -> Json {
    Json uris = Json::array();
    for (std::uint32_t i = 0; i < reply.spawnables._length; ++i) {
      uris.push_back(reply.spawnables._buffer[i].entity_resource.uri);
    }
    return {{"result", Of(reply.result)}, {"uris", uris}};
  });
  GSV_SIMULATION_CALL("get_current_world", GetCurrentWorld)
  kNothing, [](const auto& reply) -> Json {
    return {{"result", Of(reply.result)},
            {"name", reply.world.name},
            {"uri", reply.world.world_resource.uri}};
  });
  GSV_SIMULATION_CALL("get_available_worlds", GetAvailableWorlds)
  kNothing, [](const auto& reply) -> Json {
    Json names = Json::array();
    for (std::uint32_t i = 0; i < reply.worlds._length; ++i) {
      names.push_back(reply.worlds._buffer[i].name);
    }
    return {{"result", Of(reply.result)}, {"names", names}};
  });
  GSV_SIMULATION_CALL("get_named_poses", GetNamedPoses)
  kNothing, [](const auto& reply) -> Json {
    Json poses = Json::object();
    for (std::uint32_t i = 0; i < reply.poses._length; ++i) {
      const auto& each = reply.poses._buffer[i];
      const auto& p = each.pose.position;
      const auto& q = each.pose.orientation;
      poses[each.name] = {p.x, p.y, p.z, q.x, q.y, q.z, q.w};
    }
    return {{"result", Of(reply.result)}, {"poses", poses}};
  });
  GSV_SIMULATION_CALL("get_named_pose_bounds", GetNamedPoseBounds)
  [](auto& request, const Words&) {
    request.name = Text("any"); }, kResult);
}

void Calls::AddChanges() {
  GSV_SIMULATION_CALL("set_entity_state", SetEntityState)
  [](auto& request, const Words& words) {
    kEntity(request, words);
    request.state.header.frame_id = Text("world");
    request.state.pose.position = {Number(words, 1), Number(words, 2), Number(words, 3)};
    request.state.pose.orientation.w = 1;
    request.state.twist.linear.x = Number(words, 4);
  },
      kResult);
  GSV_SIMULATION_CALL("spawn_entity", SpawnEntity)
  [](auto& request, const Words& words) {
    static std::string uri, name, name_space;
    uri = Word(words, 0);
    name = Word(words, 1);
    name_space = Word(words, 2);
    request.entity_resource = {Text(uri), Text("")};
    request.name = Text(name);
    request.entity_namespace = Text(name_space);
    request.initial_pose.header.frame_id = Text("");
    request.initial_pose.pose.position = {Number(words, 3), Number(words, 4), Number(words, 5)};
    request.initial_pose.pose.orientation.w = 1;
  },
      [](const auto& reply) -> Json {
    return {{"result", Of(reply.result)}, {"entity_name", reply.entity_name}};
      });
  GSV_SIMULATION_CALL("delete_entity", DeleteEntity) kEntity, kResult);
  GSV_SIMULATION_CALL("set_entity_info", SetEntityInfo)
  [](auto& request, const Words& words) {
    kEntity(request, words);
    request.info.description = Text("");
  },
      kResult);
  GSV_SIMULATION_CALL("load_world", LoadWorld)
  [](auto& request, const Words& words) {
    static std::string uri, text;
    uri = Word(words, 0);
    text = Word(words, 2);
    request.uri = Text(uri);
    request.resource_string = Text(text);
    request.fail_on_unsupported_element = Word(words, 1) == "strict";
  },
      [](const auto& reply) -> Json {
    return {{"result", Of(reply.result)}, {"name", reply.world.name}};
      });
  GSV_SIMULATION_CALL("unload_world", UnloadWorld) kNothing, kResult);
}

void Calls::AddRun() {
  GSV_SIMULATION_CALL("get_simulation_state", GetSimulationState)
  kNothing, [](const auto& reply) -> Json {
    return {{"state", reply.state}, {"result", Of(reply.result)}};
  });
  GSV_SIMULATION_CALL("set_simulation_state", SetSimulationState)
  [](auto& request, const Words& words) {
    request.state = static_cast<std::uint8_t>(Number(words, 0));
  },
      kResult);
  GSV_SIMULATION_CALL("reset_simulation", ResetSimulation)
  [](auto& request, const Words& words) {
    request.scope = static_cast<std::uint8_t>(Number(words, 0));
  },
      kResult);
  GSV_SIMULATION_CALL("step_simulation", StepSimulation)
  [](auto& request, const Words& words) {
    request.steps = static_cast<std::uint64_t>(Number(words, 0));
  },
      kResult);
}

void Calls::AddParameters() {
  GSV_CALL("list_parameters", rcl_interfaces_srv, ListParameters)
  kNothing, [](const auto& reply) -> Json {
    return List(reply.names); });
  GSV_CALL("get_parameters", rcl_interfaces_srv, GetParameters)
  [](auto& request, const Words& words) {
    static std::string name;
    static char* names[1];
    name = Word(words, 0);
    names[0] = Text(name);
    request.names._length = request.names._maximum = 1;
    request.names._buffer = names;
  },
      [](const auto& reply) -> Json {
    const auto& value = reply.values._buffer[0];
    return {{"type", value.type}, {"bool_value", value.bool_value}};
      });
}

void Calls::AddAction() {
  const std::string action = "simulate_steps/_action/";
  GSV_CALL(action + "send_goal", simulation_interfaces_action, SimulateSteps_SendGoal)
  [](auto& request, const Words& words) {
    SetId(request.goal_id, words);
    request.steps = static_cast<std::uint64_t>(Number(words, 1));
  },
      [](const auto& reply) -> Json {
    return {{"accepted", reply.accepted}}; });
  GSV_CALL(action + "get_result", simulation_interfaces_action, SimulateSteps_GetResult)
  [](auto& request, const Words& words) {
    SetId(request.goal_id, words); },
      [](const auto& reply) -> Json {
    return {{"status", static_cast<int>(reply.status)}, {"result", Of(reply.result)}};
      });
  GSV_CALL(action + "cancel_goal", action_msgs_srv, CancelGoal)
  [](auto& request, const Words& words) {
    SetId(request.goal_id, words); },
      [](const auto& reply) -> Json {
    return {{"return_code", static_cast<int>(reply.return_code)},
            {"canceling", reply.goals_canceling._length}};
      });
  const Type feedback{&simulation_interfaces_action_dds__SimulateSteps_FeedbackMessage__desc,
                      nullptr};
  const dds_entity_t reader = participant_.Reader(feedback, "/gsv/" + action + "feedback", true);
  participant_.Watch(reader);
  calls_["feedback"] = [this, reader](const Words& words) {
    for (int missing = static_cast<int>(Number(words, 0)); missing > 0;) {
      const bool came = TakeOne(reader, [&](const void* sample) {
        const auto& message =
            *static_cast<const simulation_interfaces_action_dds__SimulateSteps_FeedbackMessage_*>(
                sample);
        Print({{"completed", message.completed_steps}, {"remaining", message.remaining_steps}});
        --missing;
      });
      if (!came && !participant_.WaitForData()) return false;
    }
    return true;
  };
}

#undef GSV_SIMULATION_CALL
#undef GSV_CALL

}  // namespace

int CallAll(Participant& participant, std::istream& lines) {
  const Calls calls(participant);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream stream(line);
    std::string name;
    if (!(stream >> name)) continue;
    const Call* const call = calls.Find(name);
    if (call == nullptr) Die("there is no service " + name);
    Words words;
    for (std::string word; stream >> word;) words.push_back(std::move(word));
    if ((*call)(words)) continue;
    std::fprintf(stderr, "ros2_peer: no reply from %s\n", name.c_str());
    return 1;
  }
  return 0;
}

int CallMany(Participant& participant, const std::string& entity, int count, int window) {
  using Request = simulation_interfaces_srv_dds__GetEntityState_Request_;
  using Response = simulation_interfaces_srv_dds__GetEntityState_Response_;
  Client<Request, Response> client(
      participant, simulation_interfaces_srv_dds__GetEntityState_Request__desc,
      simulation_interfaces_srv_dds__GetEntityState_Response__desc, "/gsv/get_entity_state");
  if (!client.Connect()) return 1;
  std::vector<bool> has_come(static_cast<std::size_t>(count) + 1);
  int replies = 0;
  while (replies < count) {
    while (client.number() < count && client.number() - replies < window) {
      Request request{};
      request.entity = Text(entity);
      client.Send(request);
    }
    if (!participant.WaitForData()) break;
    client.Take([&](const Response& response) {
      if (response.number < 1 || response.number > count || response.result.result != 1) return;
      const auto number = static_cast<std::size_t>(response.number);
      replies += has_come[number] ? 0 : 1;
      has_come[number] = true;
    });
  }
  Print({{"calls", count}, {"replies", replies}});
  return replies == count ? 0 : 1;
}

}  // namespace gsv::ros2_peer
