// The interface of a DDS participant: topics whose samples are bytes in CDR.
//
// This header depends on no DDS library. The implementation is a plug-in (module.h), so that a
// program without ROS 2 neither loads nor links one.
//
// Threads  any. `on_message`, `on_request` and `on_match` are called on threads of the DDS library.
//          They must return at once, and must not call the participant, its writers or its readers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "gsv/base/error.h"

namespace gsv::ros2::dds {

// The GUID in the form of RTPS: twelve bytes for the participant, then four bytes for the entity.
using Guid = std::array<std::uint8_t, 16>;

// The quality of service of an endpoint.
struct Qos {
  bool is_reliable = true;
  bool is_transient_local = false;  // readers that join later get the last `depth` samples
  int depth = 10;                   // number of samples that are kept
  int heartbeat_ms = 0;  // period of a reliable writer's heartbeats; 0 means the library's default
  // Set this if samples are larger than a datagram. The writer then sends bursts that fit a usual
  // socket buffer, with pauses between them. Write() only queues such a sample.
  bool is_large = false;
  friend bool operator==(const Qos&, const Qos&) = default;
};

// A topic and its type, by their DDS names.
struct Topic {
  // "rt/pebble/scan" for a topic of ROS 2. Names such as "rq/gsv/spawn_entityRequest" and
  // "rr/gsv/spawn_entityReply" for a service. "ros_discovery_info" for the list of nodes.
  std::string name;
  std::string type;  // "sensor_msgs::msg::dds_::LaserScan_"
  Qos qos;
  std::string user_data;  // USER_DATA of the endpoint; may be empty
};

// The range of discovery.
enum class Range {
  kLocalhost,  // only participants on this machine
  kPeers,      // this machine and the machines in `peers`, without multicast
  kSubnet,     // multicast on all interfaces, and the machines in `peers`
};

// The domain of a participant, its range, and what it announces.
struct ParticipantOptions {
  std::uint32_t domain = 0;  // 0 to 232
  Range range = Range::kLocalhost;
  std::vector<std::string> peers{};  // IPv4 addresses or host names
  std::string name = "gsv";          // name of the participant; other participants can read it
  std::string user_data{};           // "enclave=/;"
  // whether endpoints() returns the endpoints; if false, it returns an empty list
  bool watches_endpoints = false;
  // DDS Security: the folder of an SROS2 enclave with its keys and permissions; empty means no
  // security.
  std::string enclave_folder{};
  // reason why security is off although it was requested; empty if there is no such reason
  std::string insecure_reason{};
};

// Identifies a request, in the reply to it: the client's endpoint and the number of the request.
struct SampleIdentity {
  Guid writer{};
  std::int64_t sequence = 0;  // number of the sample, counted by its writer
};

// The identities in a request to a service, or in a reply.
struct Request {
  Guid writer{};            // the endpoint that sent the request or the reply
  SampleIdentity identity;  // in a request: the identity that its reply must contain
  SampleIdentity related;   // in a reply: the identity of the request that it answers
};

// The publishing endpoint of a topic.
class Writer {
 public:
  virtual ~Writer() = default;
  // Writes one sample with its encapsulation header. Does not wait for readers: a reader that is
  // too slow loses the oldest samples. Only one thread may call this at a time.
  void Write(std::span<const std::byte> sample) { WriteParts(sample, {}); }
  // Writes one sample in two parts, like Write(); the second part may be empty.
  virtual void WriteParts(std::span<const std::byte> head, std::span<const std::byte> rest) = 0;
  // Writes one sample as the reply to a request.
  virtual void WriteReply(std::span<const std::byte> sample, const SampleIdentity& request) = 0;
  // Whether a matching reader belongs to the participant of `endpoint`. If not, that participant
  // would not receive a reply.
  virtual bool HasReaderInSameParticipant(const Guid& endpoint) const = 0;
  virtual bool has_readers() const = 0;  // whether a matching reader is known
  virtual Guid guid() const = 0;
};

// The subscribing endpoint of a topic.
class Reader {
 public:
  virtual ~Reader() = default;
  virtual Guid guid() const = 0;
  virtual int writers() const = 0;  // The number of matching writers.
};

// An endpoint of another participant.
struct Endpoint {
  Guid guid{};
  bool is_writer = false;
  Topic topic;
};

// The program's membership in a DDS domain. Creates writers and readers.
class Participant {
 public:
  // Maximum size of an incoming sample in bytes. Larger samples are dropped.
  static constexpr std::size_t kMaxSampleIn = 16 << 20;

  virtual ~Participant() = default;

  // `on_match` is called when a matching reader appears or disappears; it may be empty.
  virtual base::Result<std::unique_ptr<Writer>> MakeWriter(const Topic& topic,
                                                           std::function<void()> on_match) = 0;
  // Makes a reader of a usual topic. `on_message` gets each sample with its encapsulation header.
  virtual base::Result<std::unique_ptr<Reader>> MakeReader(
      const Topic& topic, std::function<void(std::span<const std::byte>)> on_message) = 0;
  // Makes a reader of a service's requests. `on_request` also gets the identities of the request;
  // WriteReply() needs `identity`.
  virtual base::Result<std::unique_ptr<Reader>> MakeRequestReader(
      const Topic& topic,
      std::function<void(std::span<const std::byte>, const Request&)> on_request) = 0;
  virtual Guid guid() const = 0;
  // Returns the known endpoints, ordered by their GUIDs.
  virtual std::vector<Endpoint> endpoints() const = 0;
};

}  // namespace gsv::ros2::dds
