#include "gsv/ros2/dds/fast_loopback.h"

#include <fastdds/rtps/network/SenderResource.h>
#include <fastdds/rtps/transport/TransportReceiverInterface.h>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>

namespace gsv::ros2::dds {
namespace {

namespace rtps = eprosima::fastdds::rtps;
using eprosima::fastrtps::rtps::Locator_t;

class Loopback final : public rtps::ChainingTransport {
 public:
  using ChainingTransport::ChainingTransport;

  rtps::TransportDescriptorInterface* get_configuration() override {
    return low_level_transport_->get_configuration();
  }

  // Addresses of this machine become 127.0.0.1; those of others are refused.
  bool transform_remote_locator(const Locator_t& remote, Locator_t& result) const override {
    if (!IsLocatorSupported(remote) || !low_level_transport_->is_local_locator(remote))
      return false;
    result = remote;
    eprosima::fastrtps::rtps::IPLocator::setIPv4(result, 127, 0, 0, 1);
    return true;
  }

  bool send(eprosima::fastrtps::rtps::SenderResource* sender,
            const eprosima::fastrtps::rtps::octet* bytes, std::uint32_t size,
            eprosima::fastrtps::rtps::LocatorsIterator* begin,
            eprosima::fastrtps::rtps::LocatorsIterator* end,
            const std::chrono::steady_clock::time_point& timeout) override {
    return sender->send(bytes, size, begin, end, timeout);
  }

  void receive(rtps::TransportReceiverInterface* next, const eprosima::fastrtps::rtps::octet* bytes,
               std::uint32_t size, const Locator_t& local, const Locator_t& remote) override {
    next->OnDataReceived(bytes, size, local, remote);
  }
};

struct LoopbackDescriptor final : rtps::ChainingTransportDescriptor {
  using ChainingTransportDescriptor::ChainingTransportDescriptor;
  rtps::TransportInterface* create_transport() const override { return new Loopback(*this); }
};

}  // namespace

std::shared_ptr<rtps::TransportDescriptorInterface> LoopbackTransport(std::uint32_t max_peers) {
  auto udp = std::make_shared<rtps::UDPv4TransportDescriptor>();
  udp->interfaceWhiteList = {"127.0.0.1"};
  udp->maxInitialPeersRange = max_peers;
  return std::make_shared<LoopbackDescriptor>(std::move(udp));
}

}  // namespace gsv::ros2::dds
