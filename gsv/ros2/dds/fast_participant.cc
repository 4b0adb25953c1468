#include "gsv/ros2/dds/fast_participant.h"

#include <arpa/inet.h>

#include <atomic>
#include <cstdlib>
#include <initializer_list>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPFinder.h>
#include <fastrtps/utils/IPLocator.h>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/log/Log.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/rtps/flowcontrol/FlowControllerDescriptor.hpp>

#include "gsv/base/log.h"
#include "gsv/base/mutex.h"
#include "gsv/ros2/dds/fast_loopback.h"
#include "gsv/ros2/dds/fast_types.h"
#include "gsv/ros2/dds/free_ports.h"
#include "gsv/ros2/dds/module.h"

namespace gsv::ros2::dds {
namespace {

namespace fast = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;
using eprosima::fastrtps::types::ReturnCode_t;

constexpr std::uint32_t kMaxDomain = 232;  // domains above this have no ports
// The number of participants per machine that discovery searches for without multicast.
constexpr std::uint32_t kMaxLocalPeers = 32;
// A flow controller for large samples: bursts of four datagrams of 64 KiB, 250 MiB/s in all. By
// default, Linux gives a socket a buffer of 208 KiB and drops datagrams that do not fit.
constexpr const char* kLargeSamples = "large";
constexpr std::int32_t kBurst = 4 << 16;   // bytes
constexpr std::uint64_t kBurstPeriod = 1;  // ms

Guid GuidOf(const rtps::GUID_t& guid) {
  Guid bytes{};
  std::copy(guid.guidPrefix.value, guid.guidPrefix.value + 12, bytes.begin());
  std::copy(guid.entityId.value, guid.entityId.value + 4, bytes.begin() + 12);
  return bytes;
}

// The first 12 bytes of a GUID, which identify the participant.
using Prefix = std::array<std::uint8_t, 12>;

Prefix PrefixOf(const Guid& guid) {
  Prefix prefix{};
  std::copy_n(guid.begin(), prefix.size(), prefix.begin());
  return prefix;
}

rtps::SampleIdentity IdentityOf(const SampleIdentity& identity) {
  rtps::SampleIdentity out;
  std::copy_n(identity.writer.begin(), 12, out.writer_guid().guidPrefix.value);
  std::copy_n(identity.writer.begin() + 12, 4, out.writer_guid().entityId.value);
  out.sequence_number() =
      rtps::SequenceNumber_t(static_cast<std::int32_t>(identity.sequence >> 32),
                             static_cast<std::uint32_t>(identity.sequence & 0xffffffff));
  return out;
}

Request RequestOf(const fast::SampleInfo& info) {
  Request request;
  request.writer = GuidOf(info.sample_identity.writer_guid());
  request.identity.writer = request.writer;
  request.identity.sequence =
      static_cast<std::int64_t>(info.sample_identity.sequence_number().to64long());
  // In requests of rmw_fastrtps, this field contains the GUID of the reader that expects the reply.
  const rtps::GUID_t& reader = info.related_sample_identity.writer_guid();
  if (reader == rtps::GUID_t::unknown()) return request;
  request.identity.writer = GuidOf(reader);
  request.related.writer = GuidOf(reader);
  request.related.sequence =
      static_cast<std::int64_t>(info.related_sample_identity.sequence_number().to64long());
  return request;
}

template <typename EndpointQos>
void Apply(const Topic& topic, EndpointQos& qos) {
  qos.reliability().kind =
      topic.qos.is_reliable ? fast::RELIABLE_RELIABILITY_QOS : fast::BEST_EFFORT_RELIABILITY_QOS;
  qos.durability().kind = topic.qos.is_transient_local ? fast::TRANSIENT_LOCAL_DURABILITY_QOS
                                                       : fast::VOLATILE_DURABILITY_QOS;
  qos.history().kind = fast::KEEP_LAST_HISTORY_QOS;
  qos.history().depth = topic.qos.depth;
  auto& limits = qos.resource_limits();
  limits.max_samples = std::max(limits.max_samples, topic.qos.depth);
  limits.max_samples_per_instance = std::max(limits.max_samples_per_instance, topic.qos.depth);
  qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  qos.data_sharing().off();
  const std::vector<rtps::octet> data(topic.user_data.begin(), topic.user_data.end());
  qos.user_data().setValue(data);
}

rtps::Locator_t LocatorOf(const std::string& address) {
  rtps::Locator_t locator;
  locator.kind = LOCATOR_KIND_UDPv4;
  locator.port = 0;
  rtps::IPLocator::setIPv4(locator, address);
  return locator;
}

base::Result<rtps::Locator_t> PeerOf(const std::string& peer) {
  in_addr parsed{};
  if (inet_pton(AF_INET, peer.c_str(), &parsed) == 1) return LocatorOf(peer);
  const auto found = rtps::IPLocator::resolveNameDNS(peer);
  if (!found.first.empty()) return LocatorOf(*found.first.begin());
  return base::Fail(base::ErrorCode::kInvalidArgument,
                    "'" + peer + "' is neither an IPv4 address nor a host name that resolves",
                    "ROS_STATIC_PEERS");
}

// Sets listening addresses. Without them, Fast DDS also listens at multicast addresses.
void UseUnicastOnly(const std::string& address, rtps::BuiltinAttributes& builtin,
                    rtps::LocatorList_t& user) {
  builtin.metatrafficMulticastLocatorList.clear();
  builtin.metatrafficUnicastLocatorList.push_back(LocatorOf(address));
  user.push_back(LocatorOf(address));
}

// Shortens the period of announcements (default: 3 s). If two participants start at the same time,
// each may announce itself before the other listens. These announcements are lost.
void AnnounceOften(rtps::BuiltinAttributes& builtin) {
  builtin.discovery_config.leaseDuration_announcementperiod = {1, 0};
  builtin.discovery_config.initial_announcements.count = 10;
  builtin.discovery_config.initial_announcements.period = {0, 200'000'000};
}

void PaceLargeSamples(fast::DomainParticipantQos& qos) {
  auto pace = std::make_shared<eprosima::fastdds::rtps::FlowControllerDescriptor>();
  pace->name = kLargeSamples;
  pace->max_bytes_per_period = kBurst;
  pace->period_ms = kBurstPeriod;
  qos.flow_controllers().push_back(std::move(pace));
}

base::Status UseTransport(const ParticipantOptions& options, fast::DomainParticipantQos& qos) {
  auto& wire = qos.wire_protocol();
  qos.transport().use_builtin_transports = false;  // the built-in transports include shared memory
  wire.builtin.initialPeersList.push_back(LocatorOf("127.0.0.1"));
  AnnounceOften(wire.builtin);
  if (options.range == Range::kLocalhost) {
    qos.transport().user_transports.push_back(LoopbackTransport(kMaxLocalPeers));
    wire.builtin.initialPeersList.push_back(LocalGroup(options.domain));
    UseUnicastOnly("127.0.0.1", wire.builtin, wire.default_unicast_locator_list);
    return {};
  }
  auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  udp->maxInitialPeersRange = kMaxLocalPeers;
  udp->receiveBufferSize = kSocketBuffer;
  qos.transport().user_transports.push_back(std::move(udp));
  if (options.range == Range::kPeers) {
    UseUnicastOnly("0.0.0.0", wire.builtin, wire.default_unicast_locator_list);
  } else {
    rtps::Locator_t multicast = LocatorOf("239.255.0.1");
    multicast.port = 7400 + 250 * options.domain;
    wire.builtin.initialPeersList.push_back(multicast);
  }
  for (const std::string& peer : options.peers) {
    auto locator = PeerOf(peer);
    if (!locator) return base::Fail(locator.error());
    wire.builtin.initialPeersList.push_back(*locator);
  }
  return {};
}

// Chooses the index of a participant, which determines its ports. This is the lowest index whose
// ports are free. If Fast DDS chose the index, other participants might not search for these ports,
// or the index might have no ports.
class ParticipantIndex {
 public:
  ParticipantIndex(std::uint32_t domain, bool on_loopback) : domain_(domain) {
    const base::MutexLock lock(mutex_);
    std::set<int>& taken = taken_[domain_];
    value_ = FreeIndex(domain_, on_loopback, taken);
    if (value_ >= 0) taken.insert(value_);
  }
  ~ParticipantIndex() {
    const base::MutexLock lock(mutex_);
    taken_[domain_].erase(value_);
  }
  ParticipantIndex(const ParticipantIndex&) = delete;
  ParticipantIndex& operator=(const ParticipantIndex&) = delete;

  int value() const { return value_; }  // -1 if no index has free ports

 private:
  static inline base::Mutex mutex_;
  // The indices that this process has taken, by domain. Fast DDS may bind the ports of an index a
  // little later. Until then, the ports look free, so the indices are listed here.
  static inline std::map<std::uint32_t, std::set<int>> taken_ GSV_GUARDED_BY(mutex_);
  const std::uint32_t domain_;
  int value_ = -1;
};

// Sets the properties of DDS Security (1.1, 9.3 to 9.5) for the files of an SROS2 enclave.
void UseEnclave(const std::string& folder, fast::PropertyPolicyQos& policy) {
  const std::string authentication = "dds.sec.auth.builtin.PKI-DH.";
  const std::string access = "dds.sec.access.builtin.Access-Permissions.";
  const auto file = [&folder](const char* name) { return "file://" + folder + "/" + name; };
  for (const auto& [name, value] : std::initializer_list<std::pair<std::string, std::string>>{
           {"dds.sec.auth.plugin", "builtin.PKI-DH"},
           {authentication + "identity_ca", file("identity_ca.cert.pem")},
           {authentication + "identity_certificate", file("cert.pem")},
           {authentication + "private_key", file("key.pem")},
           {"dds.sec.crypto.plugin", "builtin.AES-GCM-GMAC"},
           {"dds.sec.access.plugin", "builtin.Access-Permissions"},
           {access + "permissions_ca", file("permissions_ca.cert.pem")},
           {access + "governance", file("governance.p7s")},
           {access + "permissions", file("permissions.p7s")}}) {
    policy.properties().emplace_back(name, value);
  }
}

base::Failure<base::Error> NoParticipant(const ParticipantOptions& options) {
  const std::string domain = std::to_string(options.domain);
  if (!options.enclave_folder.empty()) {
    return base::Fail(base::ErrorCode::kUnavailable,
                      "Fast DDS refuses the keys or the permissions for domain " + domain +
                          ". Make the enclave again with `ros2 security create_enclave`",
                      options.enclave_folder);
  }
  return base::Fail(base::ErrorCode::kUnavailable,
                    "no DDS participant can be made in domain " + domain +
                        ": the network is not usable. Look at `ip address`");
}

class FastWriter final : public Writer, fast::DataWriterListener {
 public:
  FastWriter(fast::Publisher& publisher, std::function<void()> on_match)
      : publisher_(publisher), on_match_(std::move(on_match)) {}
  ~FastWriter() override {
    if (writer_ == nullptr) return;
    writer_->set_listener(nullptr);
    // The history is cleared first. If the history contains samples, Fast DDS may wait forever for
    // a heartbeat while it deletes the writer (pull request 4076 of Fast DDS).
    std::size_t removed = 0;
    (void)writer_->clear_history(&removed);
    publisher_.delete_datawriter(writer_);
  }
  bool Open(fast::Topic* topic, const Topic& description) {
    fast::DataWriterQos qos = fast::DATAWRITER_QOS_DEFAULT;
    Apply(description, qos);
    if (const int heartbeat = description.qos.heartbeat_ms; heartbeat > 0) {
      qos.reliable_writer_qos().times.heartbeatPeriod =
          eprosima::fastrtps::Duration_t(heartbeat / 1000.0);
    }
    if (description.qos.is_large) {
      qos.publish_mode().kind = fast::ASYNCHRONOUS_PUBLISH_MODE;
      qos.publish_mode().flow_controller_name = kLargeSamples;
    }
    writer_ =
        publisher_.create_datawriter(topic, qos, this, fast::StatusMask::publication_matched());
    return writer_ != nullptr;
  }

  void WriteParts(std::span<const std::byte> head, std::span<const std::byte> rest) override {
    OutgoingSample sample{head, rest};
    writer_->write(&sample);
  }
  void WriteReply(std::span<const std::byte> reply, const SampleIdentity& request) override {
    rtps::WriteParams parameters;
    parameters.related_sample_identity(IdentityOf(request));
    OutgoingSample sample{reply, {}};
    writer_->write(&sample, parameters);
  }
  bool HasReaderInSameParticipant(const Guid& endpoint) const override {
    const base::MutexLock lock(mutex_);
    return readers_in_.contains(PrefixOf(endpoint));
  }
  bool has_readers() const override { return readers_ > 0; }
  Guid guid() const override { return GuidOf(writer_->guid()); }

 private:
  void on_publication_matched(fast::DataWriter*,
                              const fast::PublicationMatchedStatus& status) override {
    readers_ = status.current_count;
    Count(status);
    if (on_match_) on_match_();
  }

  void Count(const fast::PublicationMatchedStatus& status) {
    rtps::GUID_t reader;
    rtps::iHandle2GUID(reader, status.last_subscription_handle);
    const base::MutexLock lock(mutex_);
    int& count = readers_in_[PrefixOf(GuidOf(reader))];
    count += status.current_count_change;
    if (count <= 0) readers_in_.erase(PrefixOf(GuidOf(reader)));
  }

  fast::Publisher& publisher_;
  const std::function<void()> on_match_;
  std::atomic<int> readers_{0};
  mutable base::Mutex mutex_;
  std::map<Prefix, int> readers_in_ GSV_GUARDED_BY(mutex_);
  fast::DataWriter* writer_ = nullptr;
};

class FastReader final : public Reader, fast::DataReaderListener {
 public:
  // Samples are passed to `on_message`, or to `on_request` if `on_message` is empty.
  FastReader(fast::Subscriber& subscriber,
             std::function<void(std::span<const std::byte>)> on_message,
             std::function<void(std::span<const std::byte>, const Request&)> on_request = {})
      : subscriber_(subscriber),
        on_message_(std::move(on_message)),
        on_request_(std::move(on_request)) {}
  ~FastReader() override {
    if (reader_ == nullptr) return;
    reader_->set_listener(nullptr);
    subscriber_.delete_datareader(reader_);
  }
  bool Open(fast::Topic* topic, const Topic& description) {
    fast::DataReaderQos qos = fast::DATAREADER_QOS_DEFAULT;
    Apply(description, qos);
    fast::StatusMask mask = fast::StatusMask::data_available();
    mask << fast::StatusMask::subscription_matched();
    reader_ = subscriber_.create_datareader(topic, qos, this, mask);
    return reader_ != nullptr;
  }

  Guid guid() const override { return GuidOf(reader_->guid()); }
  int writers() const override { return writers_; }

 private:
  void on_data_available(fast::DataReader* reader) override {
    fast::SampleInfo info;
    while (reader->take_next_sample(&sample_, &info) == ReturnCode_t::RETCODE_OK) {
      if (!info.valid_data || sample_.empty()) continue;
      on_message_ ? on_message_(sample_) : on_request_(sample_, RequestOf(info));
    }
  }
  void on_subscription_matched(fast::DataReader*,
                               const fast::SubscriptionMatchedStatus& status) override {
    writers_ = status.current_count;
  }

  fast::Subscriber& subscriber_;
  const std::function<void(std::span<const std::byte>)> on_message_;
  const std::function<void(std::span<const std::byte>, const Request&)> on_request_;
  std::vector<std::byte> sample_;  // used by the thread that calls on_data_available
  std::atomic<int> writers_{0};
  fast::DataReader* reader_ = nullptr;
};

// The known endpoints of other participants.
class EndpointList final : public fast::DomainParticipantListener {
 public:
  std::vector<Endpoint> list() const {
    const base::MutexLock lock(mutex_);
    std::vector<Endpoint> all;
    for (const auto& [guid, endpoint] : endpoints_) all.push_back(endpoint);
    return all;
  }

 private:
  static constexpr std::size_t kMaxEndpoints = 100'000;

  void on_publisher_discovery(fast::DomainParticipant*, rtps::WriterDiscoveryInfo&& info) override {
    Note(info.info, true, info.status == rtps::WriterDiscoveryInfo::REMOVED_WRITER);
  }
  void on_subscriber_discovery(fast::DomainParticipant*,
                               rtps::ReaderDiscoveryInfo&& info) override {
    Note(info.info, false, info.status == rtps::ReaderDiscoveryInfo::REMOVED_READER);
  }

  template <typename Proxy>
  void Note(const Proxy& proxy, bool is_writer, bool is_gone) {
    Endpoint endpoint;
    endpoint.guid = GuidOf(proxy.guid());
    endpoint.is_writer = is_writer;
    endpoint.topic.name = proxy.topicName().to_string();
    endpoint.topic.type = proxy.typeName().to_string();
    endpoint.topic.qos.is_reliable =
        proxy.m_qos.m_reliability.kind == fast::RELIABLE_RELIABILITY_QOS;
    endpoint.topic.qos.is_transient_local =
        proxy.m_qos.m_durability.kind >= fast::TRANSIENT_LOCAL_DURABILITY_QOS;
    const auto data = proxy.m_qos.m_userData.getValue();
    endpoint.topic.user_data.assign(data.begin(), data.end());
    const base::MutexLock lock(mutex_);
    if (is_gone) {
      endpoints_.erase(endpoint.guid);
    } else if (endpoints_.size() < kMaxEndpoints) {
      endpoints_[endpoint.guid] = std::move(endpoint);
    }
  }

  mutable base::Mutex mutex_;
  std::map<Guid, Endpoint> endpoints_ GSV_GUARDED_BY(mutex_);
};

class FastParticipant final : public Participant {
 public:
  ~FastParticipant() override {
    if (participant_ == nullptr) return;
    participant_->set_listener(nullptr);
    participant_->delete_contained_entities();
    fast::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }

  base::Status Open(const ParticipantOptions& options) {
    fast::DomainParticipantQos qos = fast::PARTICIPANT_QOS_DEFAULT;
    if (auto ok = UseTransport(options, qos); !ok) return ok;
    const bool on_loopback = options.range == Range::kLocalhost;
    if (on_loopback && !IsLoopbackUp()) {
      return base::Fail(
          base::ErrorCode::kUnavailable,
          "the loopback interface lo is down, and ROS 2 uses it. Run `ip link set lo up`");
    }
    index_.emplace(options.domain, on_loopback);
    if (index_->value() < 0) {
      return base::Fail(base::ErrorCode::kUnavailable,
                        "all UDP ports of ROS 2 domain " + std::to_string(options.domain) +
                            " are in use. Choose another domain with ROS_DOMAIN_ID");
    }
    qos.name(options.name.c_str());
    qos.wire_protocol().participant_id = index_->value();
    if (!options.enclave_folder.empty()) UseEnclave(options.enclave_folder, qos.properties());
    qos.user_data().setValue({options.user_data.begin(), options.user_data.end()});
    PaceLargeSamples(qos);
    fast::DomainParticipantListener* const listener = options.watches_endpoints ? &list_ : nullptr;
    participant_ = fast::DomainParticipantFactory::get_instance()->create_participant(
        options.domain, qos, listener, fast::StatusMask::none());
    if (participant_ != nullptr) publisher_ = participant_->create_publisher({});
    if (participant_ != nullptr) subscriber_ = participant_->create_subscriber({});
    if (publisher_ != nullptr && subscriber_ != nullptr) return {};
    return NoParticipant(options);
  }

  base::Result<std::unique_ptr<Writer>> MakeWriter(const Topic& topic,
                                                   std::function<void()> on_match) override {
    auto writer = std::make_unique<FastWriter>(*publisher_, std::move(on_match));
    fast::Topic* const fast_topic = TopicOf(topic);
    if (fast_topic != nullptr && writer->Open(fast_topic, topic)) return writer;
    return Refusal(topic);
  }
  base::Result<std::unique_ptr<Reader>> MakeReader(
      const Topic& topic, std::function<void(std::span<const std::byte>)> on_message) override {
    return Opened(std::make_unique<FastReader>(*subscriber_, std::move(on_message)), topic);
  }
  base::Result<std::unique_ptr<Reader>> MakeRequestReader(
      const Topic& topic,
      std::function<void(std::span<const std::byte>, const Request&)> on_request) override {
    return Opened(std::make_unique<FastReader>(*subscriber_, nullptr, std::move(on_request)),
                  topic);
  }

  Guid guid() const override { return GuidOf(participant_->guid()); }
  std::vector<Endpoint> endpoints() const override { return list_.list(); }

 private:
  base::Result<std::unique_ptr<Reader>> Opened(std::unique_ptr<FastReader> reader,
                                               const Topic& topic) {
    fast::Topic* const fast_topic = TopicOf(topic);
    if (fast_topic != nullptr && reader->Open(fast_topic, topic)) return reader;
    return Refusal(topic);
  }

  static base::Failure<base::Error> Refusal(const Topic& topic) {
    return base::Fail(base::ErrorCode::kUnavailable,
                      "Fast DDS refuses the topic with type " + topic.type, topic.name);
  }

  // Topics exist as long as the participant, so a robot that is added again can reuse its topics.
  fast::Topic* TopicOf(const Topic& topic) {
    const base::MutexLock lock(mutex_);
    const auto found = topics_.find(topic.name);
    if (found != topics_.end()) {
      return found->second->get_type_name() == topic.type ? found->second : nullptr;
    }
    if (participant_->find_type(topic.type).empty()) {
      fast::TypeSupport(new RawType(topic.type, kMaxSampleIn)).register_type(participant_);
    }
    fast::Topic* const made =
        participant_->create_topic(topic.name, topic.type, fast::TOPIC_QOS_DEFAULT);
    if (made != nullptr) topics_[topic.name] = made;
    return made;
  }

  std::optional<ParticipantIndex> index_;
  EndpointList list_;
  fast::DomainParticipant* participant_ = nullptr;
  fast::Publisher* publisher_ = nullptr;
  fast::Subscriber* subscriber_ = nullptr;
  base::Mutex mutex_;
  std::map<std::string, fast::Topic*> topics_ GSV_GUARDED_BY(mutex_);
};

}  // namespace

base::Result<std::unique_ptr<Participant>> MakeFastParticipant(const ParticipantOptions& options) {
  if (options.domain > kMaxDomain) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "must be from 0 to 232, found " + std::to_string(options.domain),
                      "ROS_DOMAIN_ID");
  }
  if (std::getenv("ROS_DISCOVERY_SERVER") != nullptr) {
    spdlog::warn("ROS_DISCOVERY_SERVER is ignored: gsv finds its peers without a discovery server");
    unsetenv("ROS_DISCOVERY_SERVER");
  }
  if (!options.insecure_reason.empty()) {
    spdlog::warn("ROS 2 runs without security: {}", options.insecure_reason);
  }
  fast::Log::SetVerbosity(fast::Log::Kind::Error);
  auto participant = std::make_unique<FastParticipant>();
  if (auto ok = participant->Open(options); !ok) return base::Fail(ok.error());
  return participant;
}

}  // namespace gsv::ros2::dds
