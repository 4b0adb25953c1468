// A ROS 2 peer that shares no code with GSV: Cyclone DDS, with types that its idlc generated from
// IDL.
//
//   ros2_peer listen [--count N] TYPE:TOPIC…
//       Prints N samples of each topic as JSON, one per line.
//   ros2_peer count --seconds S [--reliable] [--receive-buffer BYTES] TYPE:TOPIC…
//       Prints the time to the first sample of each topic, and the number of samples in the next S
//       seconds. The readers are reliable with --reliable. BYTES is the buffer of each socket.
//   ros2_peer latency [--count N] ROBOT
//       Sends N commands to turn left and right. Prints after how many milliseconds ROBOT/imu showed
//       each command, and how late the sleeps before the commands ended.
//   ros2_peer drive --distance M [--stamped] ROBOT
//       Sends cmd_vel until ROBOT/odom shows M metres.
//   ros2_peer step --seconds S [--speed V] ROBOT
//       Answers each /clock with a TwistStamped of its time, until S seconds of simulated time are
//       over.
//   ros2_peer disturb ROBOT
//       Publishes bad commands: another type on cmd_vel, NaN and infinities, and 20,000 commands from
//       a second publisher, 10,000 per second.
//   ros2_peer call
//       Calls the services in the lines of its standard input (ros2_calls.h).
//   ros2_peer call-many --count N --window W ENTITY
//       Calls get_entity_state N times, with at most W calls in progress at a time.
//   ros2_peer joint ROBOT position|velocity VALUE
//       Commands the robot's only joint until joint_states shows the value. Before that, sends arrays
//       that must not move the joint.
//   ros2_peer malformed ROBOT
//       Sends truncated samples, and samples with huge counts, to the robot's command topics and to a
//       service of /gsv.
//   ros2_peer endpoints TOPIC…
//       Prints endpoints of other participants (topic, type, QoS, user data) until each topic, such
//       as rt/clock, was among them.
//
// All commands take --domain D, --timeout SECONDS (default: 20) and --multicast, which leaves
// Cyclone DDS its default settings; without this option, Cyclone DDS stays on loopback and uses no
// multicast. TYPE is "sensor_msgs/msg/LaserScan", TOPIC is "/pebble/scan". Exits with 0 if all
// expected samples came, 1 after the time limit, 2 for a usage error.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <map>
#include <memory>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <dds/dds.h>

#include "tests/ros2/ros2_calls.h"
#include "tests/ros2/ros2_json.h"
#include "tests/ros2/ros2_participant.h"

namespace gsv::ros2_peer {
namespace {

template <typename Message>
Json JsonOf(const void* sample) {
  return ToJson(*static_cast<const Message*>(sample));
}

const std::map<std::string, Type>& Types() {
#define GSV_PEER_TYPE(PACKAGE, NAME)                                            \
  {                                                                             \
#PACKAGE "/msg/" #NAME, {                                                   \
      &PACKAGE##_msg_dds__##NAME##__desc, &JsonOf<PACKAGE##_msg_dds__##NAME##_> \
    }                                                                           \
  }
  static const std::map<std::string, Type> kTypes = {
      GSV_PEER_TYPE(rosgraph_msgs, Clock),
      GSV_PEER_TYPE(std_msgs, String),
      GSV_PEER_TYPE(geometry_msgs, PoseStamped),
      GSV_PEER_TYPE(geometry_msgs, Twist),
      GSV_PEER_TYPE(geometry_msgs, TwistStamped),
      GSV_PEER_TYPE(tf2_msgs, TFMessage),
      GSV_PEER_TYPE(nav_msgs, Odometry),
      GSV_PEER_TYPE(sensor_msgs, LaserScan),
      GSV_PEER_TYPE(sensor_msgs, Range),
      GSV_PEER_TYPE(sensor_msgs, Imu),
      GSV_PEER_TYPE(sensor_msgs, JointState),
      GSV_PEER_TYPE(std_msgs, Float64MultiArray),
      GSV_PEER_TYPE(sensor_msgs, Image),
      GSV_PEER_TYPE(sensor_msgs, CameraInfo),
      GSV_PEER_TYPE(rcl_interfaces, Log),
      GSV_PEER_TYPE(sensor_msgs, CompressedImage),
      GSV_PEER_TYPE(sensor_msgs, PointCloud2),
      GSV_PEER_TYPE(sensor_msgs, NavSatFix),
      GSV_PEER_TYPE(sensor_msgs, MagneticField),
      GSV_PEER_TYPE(sensor_msgs, BatteryState),
      GSV_PEER_TYPE(geometry_msgs, WrenchStamped),
      GSV_PEER_TYPE(gsv_msgs, Bumper),
      GSV_PEER_TYPE(diagnostic_msgs, DiagnosticArray)};
#undef GSV_PEER_TYPE
  return kTypes;
}

const Type& TypeNamed(const std::string& name) {
  const auto found = Types().find(name);
  if (found == Types().end()) Die("unknown type " + name);
  return found->second;
}

Arguments Parse(int count, char** words) {
  Arguments arguments;
  for (int i = 2; i < count; ++i) {
    const std::string word = words[i];
    const auto value = [&] {
      if (++i >= count) Die(word + " needs a value");
      return std::atof(words[i]);
    };
    if (word == "--domain") {
      arguments.domain = static_cast<dds_domainid_t>(value());
    } else if (word == "--count") {
      arguments.count = static_cast<int>(value());
    } else if (word == "--timeout") {
      arguments.timeout = value();
    } else if (word == "--window") {
      arguments.window = static_cast<int>(value());
    } else if (word == "--receive-buffer") {
      arguments.receive_buffer = static_cast<int>(value());
    } else if (word == "--seconds") {
      arguments.seconds = value();
    } else if (word == "--speed") {
      arguments.speed = value();
    } else if (word == "--distance") {
      arguments.distance = value();
    } else if (word == "--reliable") {
      arguments.is_reliable = true;
    } else if (word == "--stamped") {
      arguments.is_stamped = true;
    } else if (word == "--multicast") {
      arguments.uses_multicast = true;
    } else if (word.starts_with("--")) {
      Die("unknown option " + word);
    } else {
      arguments.words.push_back(word);
    }
  }
  return arguments;
}

int Listen(const Arguments& arguments) {
  struct Wanted {
    std::string topic;
    const Type* type;
    dds_entity_t reader;
    int missing;
  };
  Participant participant(arguments);
  std::vector<Wanted> all;
  for (const std::string& word : arguments.words) {
    const std::size_t colon = word.find(':');
    if (colon == std::string::npos) Die("expected TYPE:TOPIC, found " + word);
    const Type& type = TypeNamed(word.substr(0, colon));
    const std::string topic = word.substr(colon + 1);
    const bool is_latched =
        topic.ends_with("tf_static") || topic.ends_with("robot_description") || topic == "/rosout";
    all.push_back(
        {topic, &type,
         is_latched ? participant.LatchedReader(type, topic) : participant.Reader(type, topic),
         is_latched ? 1 : arguments.count});
    participant.Watch(all.back().reader);
  }
  const auto is_complete = [](const Wanted& wanted) { return wanted.missing <= 0; };
  while (!std::all_of(all.begin(), all.end(), is_complete)) {
    if (!participant.WaitForData()) {
      for (const Wanted& wanted : all) {
        if (wanted.missing > 0) {
          std::fprintf(stderr, "ros2_peer: %s lacks %d samples\n", wanted.topic.c_str(),
                       wanted.missing);
        }
      }
      return 1;
    }
    for (Wanted& wanted : all) {
      while (TakeOne(wanted.reader, [&](const void* sample) {
        if (--wanted.missing < 0) return;
        Print({{"topic", wanted.topic}, {"message", wanted.type->to_json(sample)}});
      })) {
      }
    }
  }
  return 0;
}

// Measures the rate of incoming data without decoding it.
int Count(const Arguments& arguments) {
  Participant participant(arguments);
  const Clock::time_point begin = Clock::now();
  std::vector<dds_entity_t> readers;
  for (const std::string& word : arguments.words) {
    const std::size_t colon = word.find(':');
    if (colon == std::string::npos) Die("expected TYPE:TOPIC, found " + word);
    readers.push_back(participant.Reader(TypeNamed(word.substr(0, colon)), word.substr(colon + 1),
                                         arguments.is_reliable));
    participant.Watch(readers.back());
  }
  std::set<dds_entity_t> silent(readers.begin(), readers.end());
  std::uint64_t count = 0;
  Clock::time_point all_came{};
  const auto seconds = [](Clock::duration d) { return std::chrono::duration<double>(d).count(); };
  while (!silent.empty() || seconds(Clock::now() - all_came) < arguments.seconds) {
    if (!participant.WaitForData()) {
      std::fprintf(stderr, "ros2_peer: %zu topics had no sample\n", silent.size());
      return 1;
    }
    for (const dds_entity_t reader : readers) {
      while (TakeOne(reader, [](const void*) {})) {
        ++count;
        silent.erase(reader);
      }
    }
    if (!silent.empty() || all_came != Clock::time_point{}) continue;
    all_came = Clock::now();
    count = 0;
  }
  Print({{"first_samples_s", seconds(all_came - begin)},
         {"samples", count},
         {"seconds", seconds(Clock::now() - all_came)}});
  return 0;
}

// A command is sent for each odometry message, so that the result does not depend on time.
int Drive(const Arguments& arguments) {
  if (arguments.words.size() != 1) Die("drive needs one robot, such as /pebble");
  const std::string& robot = arguments.words.front();
  Participant participant(arguments);
  const dds_entity_t odometry =
      participant.Reader(TypeNamed("nav_msgs/msg/Odometry"), robot + "/odom");
  const dds_entity_t command =
      participant.Writer(TypeNamed(arguments.is_stamped ? "geometry_msgs/msg/TwistStamped"
                                                        : "geometry_msgs/msg/Twist"),
                         robot + "/cmd_vel");
  participant.Watch(odometry);
  double distance = 0;
  std::uint64_t commands = 0;
  std::vector<double> start;
  while (distance < arguments.distance) {
    if (!participant.WaitForData()) {
      std::fprintf(stderr, "ros2_peer: %s went %.3f m by %lu commands\n", robot.c_str(), distance,
                   commands);
      return 1;
    }
    while (TakeOne(odometry, [&](const void* sample) {
      const auto& p = static_cast<const nav_msgs_msg_dds__Odometry_*>(sample)->pose.pose.position;
      if (start.empty()) start = {p.x, p.y};
      distance = std::hypot(p.x - start[0], p.y - start[1]);
      geometry_msgs_msg_dds__TwistStamped_ twist{};
      char frame[] = "";
      twist.header.frame_id = frame;
      twist.twist.linear.x = 0.3;
      if (arguments.is_stamped) {
        dds_write(command, &twist);
      } else {
        dds_write(command, &twist.twist);
      }
      ++commands;
    })) {
    }
  }
  const geometry_msgs_msg_dds__Twist_ stop{};
  if (!arguments.is_stamped) dds_write(command, &stop);
  Print({{"distance", distance}, {"commands", commands}});
  return 0;
}

// Acts as a node that steps a robot in lockstep.
int Step(const Arguments& arguments) {
  if (arguments.words.size() != 1) Die("step needs one robot, such as /pebble");
  Participant participant(arguments);
  const dds_entity_t clock = participant.Reader(TypeNamed("rosgraph_msgs/msg/Clock"), "/clock");
  const dds_entity_t command = participant.Writer(TypeNamed("geometry_msgs/msg/TwistStamped"),
                                                  arguments.words.front() + "/cmd_vel");
  participant.Watch(clock);
  double time = 0;
  std::uint64_t commands = 0;
  while (time < arguments.seconds) {
    if (!participant.WaitForData()) return 1;
    while (TakeOne(clock, [&](const void* sample) {
      const auto& now = static_cast<const rosgraph_msgs_msg_dds__Clock_*>(sample)->clock;
      time = now.sec + 1e-9 * now.nanosec;
      geometry_msgs_msg_dds__TwistStamped_ twist{};
      char frame[] = "";
      twist.header.stamp = now;
      twist.header.frame_id = frame;
      twist.twist.linear.x = arguments.speed;
      dds_write(command, &twist);
      ++commands;
    })) {
    }
  }
  Print({{"time", time}, {"commands", commands}});
  return 0;
}

// Whether a reader for this writer was found within the time limit.
bool WaitForReader(Participant& participant, dds_entity_t writer) {
  dds_publication_matched_status_t status{};
  while (dds_get_publication_matched_status(writer, &status) == 0 && status.current_count == 0) {
    if (!participant.WaitForData()) return false;
  }
  return true;
}

// Commands are sent at pseudo-random instants, so that they arrive in all parts of a step.
int Latency(const Arguments& arguments) {
  if (arguments.words.size() != 1) Die("latency needs one robot, such as /pebble");
  const std::string& robot = arguments.words.front();
  Participant participant(arguments);
  const dds_entity_t imu = participant.Reader(TypeNamed("sensor_msgs/msg/Imu"), robot + "/imu");
  const dds_entity_t command =
      participant.Writer(TypeNamed("geometry_msgs/msg/Twist"), robot + "/cmd_vel");
  participant.Watch(imu);
  if (!WaitForReader(participant, command)) return 1;
  std::minstd_rand random(1);
  std::vector<double> milliseconds, sleeps_late;
  double rate = 0;
  const auto milliseconds_since = [](Clock::time_point time) {
    return std::chrono::duration<double, std::milli>(Clock::now() - time).count();
  };
  const auto take = [&] {
    while (TakeOne(imu, [&](const void* sample) {
      rate = static_cast<const sensor_msgs_msg_dds__Imu_*>(sample)->angular_velocity.z;
    })) {
    }
  };
  for (int i = 0; i < arguments.count; ++i) {
    const auto pause = static_cast<std::int64_t>(20'000 + random() % 20'000);  // us
    const Clock::time_point begin = Clock::now();
    dds_sleepfor(DDS_USECS(pause));
    sleeps_late.push_back(milliseconds_since(begin) - static_cast<double>(pause) / 1000);
    take();
    geometry_msgs_msg_dds__Twist_ twist{};
    twist.angular.z = i % 2 == 0 ? 0.5 : -0.5;
    const Clock::time_point sent = Clock::now();
    dds_write(command, &twist);
    while (rate * twist.angular.z <= 0) {
      if (!participant.WaitForData()) return 1;
      take();
    }
    milliseconds.push_back(milliseconds_since(sent));
  }
  Print({{"milliseconds", milliseconds}, {"sleeps_late_milliseconds", sleeps_late}});
  return 0;
}

// One array is sent for each message of the joint's state. The first has two numbers and the second
// NaN: neither must move the joint. The others have the value, until the joint has it.
int MoveJoint(const Arguments& arguments) {
  if (arguments.words.size() != 3) Die("joint needs a robot, position or velocity, and a value");
  const std::string& robot = arguments.words[0];
  const bool is_position = arguments.words[1] == "position";
  const double wanted = std::atof(arguments.words[2].c_str());
  Participant participant(arguments);
  const dds_entity_t states =
      participant.Reader(TypeNamed("sensor_msgs/msg/JointState"), robot + "/joint_states");
  const dds_entity_t command =
      participant.Writer(TypeNamed("std_msgs/msg/Float64MultiArray"),
                         robot + "/joint_" + arguments.words[1] + "_controller/commands");
  participant.Watch(states);
  if (!WaitForReader(participant, command)) return 1;
  double value = 0;
  int sent = 0;
  bool was_moved_by_bad = false;
  while (std::abs(value - wanted) > 1e-6) {
    if (!participant.WaitForData()) return 1;
    while (TakeOne(states, [&](const void* sample) {
      const auto* state = static_cast<const sensor_msgs_msg_dds__JointState_*>(sample);
      value = is_position ? state->position._buffer[0] : state->velocity._buffer[0];
      was_moved_by_bad = was_moved_by_bad || (sent <= 2 && value != 0);
      double numbers[] = {sent == 1 ? std::nan("") : wanted, wanted};
      std_msgs_msg_dds__Float64MultiArray_ array{};
      array.data._length = array.data._maximum = sent == 0 ? 2 : 1;
      array.data._buffer = numbers;
      dds_write(command, &array);
      ++sent;
    })) {
    }
  }
  Print({{"value", value}, {"moved_by_bad", was_moved_by_bad}});
  return 0;
}

// Bad commands are sent for each odometry message, for about two seconds. The robot's odometry must
// stay finite.
int Disturb(const Arguments& arguments) {
  if (arguments.words.size() != 1) Die("disturb needs one robot, such as /pebble");
  const std::string topic = arguments.words.front() + "/cmd_vel";
  constexpr int kRounds = 100, kCommandsEach = 200;  // 10,000 commands per second
  Participant participant(arguments);
  const dds_entity_t odometry =
      participant.Reader(TypeNamed("nav_msgs/msg/Odometry"), arguments.words.front() + "/odom");
  const dds_entity_t flood = participant.Writer(TypeNamed("geometry_msgs/msg/Twist"), topic);
  const dds_entity_t bad = participant.Writer(TypeNamed("geometry_msgs/msg/Twist"), topic);
  Participant other(arguments, participant);
  const dds_entity_t wrong = other.Writer(TypeNamed("std_msgs/msg/String"), topic);
  participant.Watch(odometry);
  if (!WaitForReader(participant, flood) || !WaitForReader(participant, bad)) return 1;
  int rounds = 0;
  double x = 0;
  while (rounds < kRounds) {
    if (!participant.WaitForData()) return 1;
    while (TakeOne(odometry, [&](const void* sample) {
      x = static_cast<const nav_msgs_msg_dds__Odometry_*>(sample)->pose.pose.position.x;
      ++rounds;
      geometry_msgs_msg_dds__Twist_ twist{};
      twist.linear.x = rounds % 2 == 0 ? std::nan("") : HUGE_VAL;
      dds_write(bad, &twist);
      twist.linear.x = 0.1;
      for (int i = 0; i < kCommandsEach; ++i) dds_write(flood, &twist);
      char text[] = "go";
      const std_msgs_msg_dds__String_ string{text};
      dds_write(wrong, &string);
    })) {
    }
  }
  Print({{"finite", std::isfinite(x)}, {"commands", kRounds * kCommandsEach}});
  return std::isfinite(x) ? 0 : 1;
}

// Returns a type with this content under another name.
dds_topic_descriptor_t Disguised(const dds_topic_descriptor_t& content, const char* name) {
  return {.m_size = content.m_size,
          .m_align = content.m_align,
          .m_flagset = content.m_flagset & ~DDS_TOPIC_XTYPES_METADATA,
          .m_nkeys = content.m_nkeys,
          .m_typename = name,
          .m_keys = content.m_keys,
          .m_nops = content.m_nops,
          .m_ops = content.m_ops,
          .m_meta = ""};
}

// A sample is sent for each odometry message, which shows that gsv continues to run.
int Malformed(const Arguments& arguments) {
  if (arguments.words.size() != 1) Die("malformed needs one robot, such as /arm");
  const std::string robot = "rt" + arguments.words.front();
  const std::pair<std::string, const char*> targets[] = {
      {robot + "/cmd_vel", "geometry_msgs::msg::dds_::Twist_"},
      {robot + "/joint_trajectory", "trajectory_msgs::msg::dds_::JointTrajectory_"},
      {robot + "/joint_position_controller/commands", "std_msgs::msg::dds_::Float64MultiArray_"},
      {"rq/gsv/get_entity_stateRequest",
       "simulation_interfaces::srv::dds_::GetEntityState_Request_"},
      {"rq/gsv/set_parametersRequest", "rcl_interfaces::srv::dds_::SetParameters_Request_"}};
  Participant participant(arguments);
  Participant second(arguments, participant);  // in one participant, a topic has only one type
  const dds_entity_t odometry =
      participant.Reader(TypeNamed("nav_msgs/msg/Odometry"), arguments.words.front() + "/odom");
  participant.Watch(odometry);
  std::vector<dds_entity_t> cut, huge;
  for (const auto& [topic, type] : targets) {
    cut.push_back(participant.WriterOf(Disguised(gsv_peer_Cut_desc, type), topic));
    huge.push_back(second.WriterOf(Disguised(gsv_peer_Words_desc, type), topic));
  }
  for (const auto* writers : {&cut, &huge}) {
    for (const dds_entity_t writer : *writers) {
      if (!WaitForReader(participant, writer)) return 1;
    }
  }
  constexpr std::uint32_t kCounts[] = {0xffffffff, 0x7fffffff, 0x10000000, 0x00000fff};
  int rounds = 0;
  while (rounds < 20) {
    if (!participant.WaitForData()) return 1;
    while (TakeOne(odometry, [&](const void*) {
      const gsv_peer_Cut octet{7};
      gsv_peer_Words words{};
      std::fill(std::begin(words.numbers), std::end(words.numbers), kCounts[rounds++ % 4]);
      for (const dds_entity_t writer : cut) dds_write(writer, &octet);
      for (const dds_entity_t writer : huge) dds_write(writer, &words);
    })) {
    }
  }
  Print({{"rounds", rounds}});
  return 0;
}

Json EndpointJson(const dds_builtintopic_endpoint_t& endpoint, const char* kind) {
  Json json = {{"kind", kind}, {"topic", endpoint.topic_name}, {"type", endpoint.type_name}};
  dds_reliability_kind_t reliability = DDS_RELIABILITY_BEST_EFFORT;
  dds_durability_kind_t durability = DDS_DURABILITY_VOLATILE;
  void* user_data = nullptr;
  std::size_t size = 0;
  if (dds_qget_reliability(endpoint.qos, &reliability, nullptr)) {
    json["reliable"] = reliability == DDS_RELIABILITY_RELIABLE;
  }
  if (dds_qget_durability(endpoint.qos, &durability)) {
    json["transient_local"] = durability == DDS_DURABILITY_TRANSIENT_LOCAL;
  }
  if (dds_qget_userdata(endpoint.qos, &user_data, &size) && size > 0) {
    json["user_data"] = std::string(static_cast<const char*>(user_data), size);
  }
  dds_free(user_data);
  return json;
}

int Endpoints(const Arguments& arguments) {
  Participant participant(arguments);
  struct Kind {
    const char* name;
    dds_entity_t topic, reader;
  };
  Kind kinds[] = {{"writer", DDS_BUILTIN_TOPIC_DCPSPUBLICATION, 0},
                  {"reader", DDS_BUILTIN_TOPIC_DCPSSUBSCRIPTION, 0}};
  for (Kind& kind : kinds) {
    kind.reader =
        Made(dds_create_reader(participant.entity(), kind.topic, nullptr, nullptr), "a reader");
    participant.Watch(kind.reader);
  }
  std::set<std::string> missing(arguments.words.begin(), arguments.words.end());
  while (!missing.empty()) {
    if (!participant.WaitForData()) {
      std::fprintf(stderr, "ros2_peer: nobody announced %s\n", missing.begin()->c_str());
      return 1;
    }
    for (const Kind& kind : kinds) {
      while (TakeOne(kind.reader, [&](const void* sample) {
        const auto& endpoint = *static_cast<const dds_builtintopic_endpoint_t*>(sample);
        if (participant.Has(endpoint)) return;
        Print(EndpointJson(endpoint, kind.name));
        missing.erase(endpoint.topic_name);
      })) {
      }
    }
  }
  return 0;
}

int Main(int count, char** words) {
  if (count < 2)
    Die("expected listen, count, latency, drive, step, disturb, joint, malformed, call, call-many "
        "or "
        "endpoints");
  const std::string command = words[1];
  const Arguments arguments = Parse(count, words);
  if (command == "listen") return Listen(arguments);
  if (command == "count") return Count(arguments);
  if (command == "drive") return Drive(arguments);
  if (command == "latency") return Latency(arguments);
  if (command == "joint") return MoveJoint(arguments);
  if (command == "malformed") return Malformed(arguments);
  if (command == "step") return Step(arguments);
  if (command == "disturb") return Disturb(arguments);
  if (command == "call") {
    Participant participant(arguments);
    return CallAll(participant, std::cin);
  }
  if (command == "call-many") {
    if (arguments.words.size() != 1) Die("call-many needs one entity");
    Participant participant(arguments);
    return CallMany(participant, arguments.words[0], arguments.count, arguments.window);
  }
  if (command == "endpoints") return Endpoints(arguments);
  Die("expected listen, count, latency, drive, step, disturb, call, call-many or endpoints, "
      "found " +
      command);
}

}  // namespace
}  // namespace gsv::ros2_peer

int main(int count, char** words) { return gsv::ros2_peer::Main(count, words); }
