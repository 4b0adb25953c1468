#include "gsv/ros2/dds/fast_loopback.h"

#include <cstddef>
#include <span>

#include <fastdds/rtps/network/SenderResource.h>
#include <fastdds/rtps/transport/TransportReceiverInterface.h>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>

#include "gsv/ros2/dds/local_multicast.h"

namespace gsv::ros2::dds {
namespace {

namespace transport = eprosima::fastdds::rtps;
using eprosima::fastrtps::rtps::IPLocator;
using eprosima::fastrtps::rtps::Locator_t;
using eprosima::fastrtps::rtps::LocatorsIterator;

// A placeholder for kDiscoveryGroup in the list of peers. Participants with default settings
// announce that they listen to this group. If the list contained the group itself, Fast DDS would
// also send data to the group.
constexpr const char* kGroupPeer = "127.255.255.254";
constexpr const char* kDiscoveryGroup = "239.255.0.1";  // RTPS 2.3, 9.6.1.4

bool IsGroupPeer(const Locator_t& locator) {
  return locator.kind == LOCATOR_KIND_UDPv4 && IPLocator::toIPv4string(locator) == kGroupPeer;
}

// Fast DDS never deletes an iterator through this base class, so the destructor need not be
// virtual.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wnon-virtual-dtor"
// Skips kGroupPeer in a list of destinations. Sends the datagram by multicast on this machine
// instead.
class WithoutGroup final : public LocatorsIterator {
 public:
  WithoutGroup(LocatorsIterator& next, const LocatorsIterator& end,
               std::span<const std::byte> datagram, const LocalMulticast& multicast)
      : next_(next), end_(end), datagram_(datagram), multicast_(multicast) {
    SkipGroup();
  }
  LocatorsIterator& operator++() override {
    ++next_;
    SkipGroup();
    return *this;
  }
  bool operator==(const LocatorsIterator& other) const override { return next_ == other; }
  bool operator!=(const LocatorsIterator& other) const override { return next_ != other; }
  const Locator_t& operator*() const override { return *next_; }

 private:
  void SkipGroup() {
    for (; next_ != end_ && IsGroupPeer(*next_); ++next_) {
      multicast_.Send(datagram_, IPLocator::getPhysicalPort(*next_));
    }
  }

  LocatorsIterator& next_;
  const LocatorsIterator& end_;
  const std::span<const std::byte> datagram_;
  const LocalMulticast& multicast_;
};
#pragma GCC diagnostic pop

class Loopback final : public transport::ChainingTransport {
 public:
  using ChainingTransport::ChainingTransport;

  transport::TransportDescriptorInterface* get_configuration() override {
    return low_level_transport_->get_configuration();
  }

  // Replaces addresses of this machine by 127.0.0.1, and refuses addresses of other machines.
  bool transform_remote_locator(const Locator_t& remote, Locator_t& result) const override {
    result = remote;
    if (IsGroupPeer(remote)) return true;
    if (!IsLocatorSupported(remote) || !low_level_transport_->is_local_locator(remote))
      return false;
    IPLocator::setIPv4(result, 127, 0, 0, 1);
    return true;
  }

  bool send(eprosima::fastrtps::rtps::SenderResource* sender,
            const eprosima::fastrtps::rtps::octet* bytes, std::uint32_t size,
            LocatorsIterator* begin, LocatorsIterator* end,
            const std::chrono::steady_clock::time_point& timeout) override {
    WithoutGroup to(*begin, *end, std::as_bytes(std::span(bytes, size)), multicast_);
    return sender->send(bytes, size, &to, end, timeout);
  }

  void receive(transport::TransportReceiverInterface* next,
               const eprosima::fastrtps::rtps::octet* bytes, std::uint32_t size,
               const Locator_t& local, const Locator_t& remote) override {
    next->OnDataReceived(bytes, size, local, remote);
  }

 private:
  const LocalMulticast multicast_{kDiscoveryGroup};
};

struct LoopbackDescriptor final : transport::ChainingTransportDescriptor {
  using ChainingTransportDescriptor::ChainingTransportDescriptor;
  transport::TransportInterface* create_transport() const override { return new Loopback(*this); }
};

}  // namespace

std::shared_ptr<transport::TransportDescriptorInterface> LoopbackTransport(
    std::uint32_t max_peers) {
  auto udp = std::make_shared<transport::UDPv4TransportDescriptor>();
  udp->interfaceWhiteList = {"127.0.0.1"};
  udp->maxInitialPeersRange = max_peers;
  udp->receiveBufferSize = kSocketBuffer;
  return std::make_shared<LoopbackDescriptor>(std::move(udp));
}

eprosima::fastrtps::rtps::Locator_t LocalGroup(std::uint32_t domain) {
  Locator_t locator;
  locator.kind = LOCATOR_KIND_UDPv4;
  IPLocator::setIPv4(locator, kGroupPeer);
  locator.port = 7400 + 250 * domain;  // RTPS 2.3, 9.6.1.1
  return locator;
}

}  // namespace gsv::ros2::dds
