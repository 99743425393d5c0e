#include "canopeer/dds/fast/library_settings.h"

#include <memory>
#include <string>
#include <vector>

#if CANOPEER_FAST_DDS >= 3
#include <fastdds/LibrarySettings.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.hpp>
#include <fastdds/rtps/transport/shared_mem/SharedMemTransportDescriptor.hpp>
#include <fastdds/utils/IPLocator.hpp>
#else
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastdds/rtps/transport/shared_mem/SharedMemTransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>
#include <fastrtps/xmlparser/XMLProfileManager.h>
#endif
#include <fastdds/dds/log/Log.hpp>

#include "canopeer/dds/peers.h"

namespace canopeer::ros {
namespace {

namespace transports = eprosima::fastdds::rtps;

constexpr std::uint32_t kSocketBuffer = 4u << 20;
// Where discovery is heard (DDSI-RTPS 2.3, 9.6.1).
constexpr int kMulticastPort = 7400;
constexpr int kPortsOfDomain = 250;

/// Its own complaints about a sample that was too long are all it says about that.
class LogListener final : public fast::LogConsumer {
 public:
  explicit LogListener(std::atomic<std::int64_t>& too_long) : too_long_(too_long) {}
  void Consume(const fast::Log::Entry& entry) override {
    if (entry.message.find("larger than the history payload size") != std::string::npos) {
      ++too_long_;
    }
  }

 private:
  std::atomic<std::int64_t>& too_long_;
};

std::shared_ptr<transports::UDPv4TransportDescriptor> udp_over(
    const std::vector<std::string>& interfaces) {
  auto udp = std::make_shared<transports::UDPv4TransportDescriptor>();
  udp->sendBufferSize = udp->receiveBufferSize = kSocketBuffer;
  udp->maxInitialPeersRange = 32;  // participants on one machine that are asked by their ports
  udp->interfaceWhiteList = interfaces;
  return udp;
}

/// Port 0: all that participants on that machine may have.
rtps::Locator_t address(const std::string& ipv4, int port = 0) {
  rtps::Locator_t locator;
  rtps::IPLocator::setIPv4(locator, ipv4);
  rtps::IPLocator::setPhysicalPort(locator, static_cast<std::uint16_t>(port));
  return locator;
}

}  // namespace

fast::DomainParticipantQos participant_qos(const ParticipantOptions& options) {
  fast::DomainParticipantQos qos;
  qos.name(options.name);
  qos.user_data().setValue(octets_of("enclave=/;"));
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports.push_back(udp_over(used_interfaces(options.interfaces)));
  if (options.shared_memory) {
    auto memory = std::make_shared<transports::SharedMemTransportDescriptor>();
    memory->segment_size(16u << 20);
    qos.transport().user_transports.push_back(memory);
  }
  auto& builtin = qos.wire_protocol().builtin;
  // Named peers replace the multicast announcement, so it is named as well. Peers limited to this
  // machine listen to no multicast.
  builtin.initialPeersList.push_back(address("127.0.0.1"));
  builtin.initialPeersList.push_back(
      address("239.255.0.1", kMulticastPort + kPortsOfDomain * options.domain));
  for (const std::string& peer : options.peers) {
    builtin.initialPeersList.push_back(address(peer));
  }
  // Others notice after six seconds that this participant was killed.
  builtin.discovery_config.leaseDuration = {6, 0};
  builtin.discovery_config.leaseDuration_announcementperiod = {1, 500'000'000};
  return qos;
}

void no_short_cuts() {
#if CANOPEER_FAST_DDS >= 3
  eprosima::fastdds::LibrarySettings settings;
  settings.intraprocess_delivery = eprosima::fastdds::INTRAPROCESS_OFF;
  fast::DomainParticipantFactory::get_instance()->set_library_settings(settings);
#else
  eprosima::fastrtps::LibrarySettingsAttributes settings;
  settings.intraprocess_delivery = eprosima::fastrtps::INTRAPROCESS_OFF;
  eprosima::fastrtps::xmlparser::XMLProfileManager::library_settings(settings);
#endif
}

std::atomic<std::int64_t>& too_long_count() {
  static std::atomic<std::int64_t> count{0};
  static const bool listening = [] {
    fast::Log::ClearConsumers();
    fast::Log::SetVerbosity(fast::Log::Kind::Error);
    fast::Log::RegisterConsumer(std::make_unique<LogListener>(count));
    return true;
  }();
  static_cast<void>(listening);
  return count;
}

}  // namespace canopeer::ros
