// A participant of Cyclone DDS, which stays on loopback.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include <dds/dds.h>
#include <dds/ddsrt/log.h>
#include <nlohmann/json.hpp>

namespace gsv::ros2_peer {

using Json = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

// Returns a configuration of Cyclone DDS that uses only the loopback device. `receive_buffer` is
// the size in bytes that each socket requests for its buffer; 0 means the default of Cyclone DDS.
inline std::string Loopback(int receive_buffer) {
  const std::string bytes = std::to_string(receive_buffer) + " B";
  const std::string buffers = receive_buffer == 0
                                  ? std::string()
                                  : "<Internal><SocketReceiveBufferSize min=\"" + bytes +
                                        "\" max=\"" + bytes + "\"/></Internal>";
  return "<CycloneDDS><Domain><General><Interfaces><NetworkInterface name=\"lo\" "
         "multicast=\"false\"/></Interfaces>"
         "<AllowMulticast>false</AllowMulticast></General><Discovery><ParticipantIndex>auto</"
         "ParticipantIndex>"
         "<MaxAutoParticipantIndex>32</MaxAutoParticipantIndex><Peers><Peer "
         "Address=\"127.0.0.1\"/></Peers>"
         "</Discovery>" +
         buffers + "</Domain></CycloneDDS>";
}

[[noreturn]] inline void Die(const std::string& message) {
  std::fprintf(stderr, "ros2_peer: %s\n", message.c_str());
  std::exit(2);
}

inline dds_entity_t Made(dds_entity_t entity, const std::string& what) {
  if (entity < 0) Die("cannot make " + what + ": " + dds_strretcode(-entity));
  return entity;
}

struct Type {
  const dds_topic_descriptor_t* descriptor;
  Json (*to_json)(const void* sample);
};

struct Arguments {
  dds_domainid_t domain = 0;
  int count = 1, window = 100, receive_buffer = 0;
  double timeout = 20, distance = 1, seconds = 10, speed = 0.2;
  bool is_stamped = false, is_reliable = false, uses_multicast = false;
  std::vector<std::string> words;
};

class Participant {
 public:
  explicit Participant(const Arguments& arguments)
      : deadline_(Clock::now() +
                  std::chrono::milliseconds(static_cast<std::int64_t>(1000 * arguments.timeout))) {
    // Disables the log, because replies to clients of other RMW implementations do not decode.
    dds_set_log_mask(0);
    if (!arguments.uses_multicast) {
      Made(dds_create_domain(arguments.domain, Loopback(arguments.receive_buffer).c_str()),
           "a domain");
    }
    Join(arguments);
  }
  // Joins the domain of the first participant.
  Participant(const Arguments& arguments, const Participant& first) : deadline_(first.deadline_) {
    Join(arguments);
  }

  dds_entity_t entity() const { return entity_; }
  bool Has(const dds_builtintopic_endpoint_t& endpoint) const {
    dds_guid_t own{};
    dds_get_guid(entity_, &own);
    return std::equal(std::begin(own.v), std::end(own.v), std::begin(endpoint.participant_key.v));
  }

  // Creates a volatile reader. A best-effort reader matches every writer.
  dds_entity_t Reader(const Type& type, const std::string& topic, bool is_reliable = false) {
    dds_qos_t* const qos = dds_create_qos();
    dds_qset_reliability(qos, is_reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT,
                         DDS_SECS(1));
    dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 100);
    const dds_entity_t reader =
        Made(dds_create_reader(entity_, Topic(type, topic), qos, nullptr), "a reader of " + topic);
    dds_delete_qos(qos);
    return reader;
  }
  // Creates a reader that also gets samples that were sent before it existed.
  dds_entity_t LatchedReader(const Type& type, const std::string& topic) {
    dds_qos_t* const qos = dds_create_qos();
    dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
    dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
    const dds_entity_t reader =
        Made(dds_create_reader(entity_, Topic(type, topic), qos, nullptr), "a reader of " + topic);
    dds_delete_qos(qos);
    return reader;
  }
  // Creates the writer and the reader of a service's client. They keep all samples, as in
  // rmw_cyclonedds: with "keep last", replies to other clients would replace a reply that was not
  // taken yet.
  dds_entity_t Requester(const dds_topic_descriptor_t& type, const std::string& service) {
    return Endpoint(&dds_create_writer, type, "rq" + service + "Request", kKeepAll);
  }
  dds_entity_t ReplyReader(const dds_topic_descriptor_t& type, const std::string& service) {
    return Endpoint(&dds_create_reader, type, "rr" + service + "Reply", kKeepAll);
  }
  dds_entity_t Writer(const Type& type, const std::string& topic) {
    dds_qos_t* const qos = dds_create_qos();
    dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_SECS(1));
    const dds_entity_t writer =
        Made(dds_create_writer(entity_, Topic(type, topic), qos, nullptr), "a writer of " + topic);
    dds_delete_qos(qos);
    return writer;
  }
  dds_entity_t WriterOf(const dds_topic_descriptor_t& type, const std::string& name) {
    return Endpoint(&dds_create_writer, type, name, 10);
  }
  // After this call, WaitForData() also returns when this reader has data.
  void Watch(dds_entity_t reader) {
    dds_set_status_mask(reader, DDS_DATA_AVAILABLE_STATUS);
    dds_waitset_attach(waits_, reader, reader);
  }
  // Waits briefly for discovery. Returns false after the time limit.
  bool Pause() {
    dds_sleepfor(DDS_MSECS(5));
    return Clock::now() < deadline_;
  }
  // Returns false after the time limit.
  bool WaitForData() {
    const auto left = deadline_ - Clock::now();
    if (left <= left.zero()) return false;
    return dds_waitset_wait(waits_, nullptr, 0, std::chrono::nanoseconds(left).count()) > 0;
  }

 private:
  static constexpr int kKeepAll = DDS_LENGTH_UNLIMITED;

  template <typename Create>
  dds_entity_t Endpoint(Create create, const dds_topic_descriptor_t& type, const std::string& name,
                        int depth) {
    dds_qos_t* const qos = dds_create_qos();
    dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, DDS_SECS(10));
    const bool keeps_all = depth == kKeepAll;
    dds_qset_history(qos, keeps_all ? DDS_HISTORY_KEEP_ALL : DDS_HISTORY_KEEP_LAST, depth);
    const dds_entity_t made = Made(create(entity_, TopicOf(type, name), qos, nullptr), name);
    dds_delete_qos(qos);
    return made;
  }
  void Join(const Arguments& arguments) {
    entity_ = Made(dds_create_participant(arguments.domain, nullptr, nullptr), "a participant");
    waits_ = Made(dds_create_waitset(entity_), "a wait set");
  }
  dds_entity_t Topic(const Type& type, const std::string& topic) {
    return TopicOf(*type.descriptor, "rt" + topic);
  }
  dds_entity_t TopicOf(const dds_topic_descriptor_t& type, const std::string& name) {
    return Made(dds_create_topic(entity_, &type, name.c_str(), nullptr, nullptr),
                "the topic " + name);
  }

  const Clock::time_point deadline_;
  dds_entity_t entity_ = 0, waits_ = 0;
};

// Passes the next sample of a reader to `use`. Returns false if there is none.
template <typename Use>
bool TakeOne(dds_entity_t reader, Use use) {
  void* samples[1] = {nullptr};
  dds_sample_info_t info[1];
  const dds_return_t count = dds_take(reader, samples, info, 1, 1);
  if (count <= 0) return false;
  if (info[0].valid_data) use(samples[0]);
  dds_return_loan(reader, samples, count);
  return true;
}

inline void Print(const Json& json) {
  std::printf("%s\n", json.dump(-1, ' ', false, Json::error_handler_t::replace).c_str());
  std::fflush(stdout);
}

}  // namespace gsv::ros2_peer
