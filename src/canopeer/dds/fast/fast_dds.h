#pragma once

// What Fast DDS 2 and 3 call the same things, and between its values and ours. CMake tells which of
// them is there.

#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#if CANOPEER_FAST_DDS >= 3
#include <fastdds/rtps/common/SampleIdentity.hpp>
#else
#include <fastdds/rtps/common/SampleIdentity.h>
#endif
#include <fastdds/dds/core/policy/QosPolicies.hpp>

#include "canopeer/dds/participant.h"

namespace canopeer::ros {

namespace fast = eprosima::fastdds::dds;
#if CANOPEER_FAST_DDS >= 3
namespace rtps = eprosima::fastdds::rtps;
inline const fast::ReturnCode_t kOk = fast::RETCODE_OK;
#else
namespace rtps = eprosima::fastrtps::rtps;
inline constexpr auto kOk = eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK;
#endif

inline Guid to_guid(const rtps::GUID_t& from) {
  Guid guid{};
  std::memcpy(guid.data(), from.guidPrefix.value, 12);
  std::memcpy(guid.data() + 12, from.entityId.value, 4);
  return guid;
}

inline rtps::GUID_t from_guid(const Guid& from) {
  rtps::GUID_t guid;
  std::memcpy(guid.guidPrefix.value, from.data(), 12);
  std::memcpy(guid.entityId.value, from.data() + 12, 4);
  return guid;
}

inline SampleIdentity to_identity(const rtps::SampleIdentity& from) {
  const auto& number = from.sequence_number();
  return {to_guid(from.writer_guid()),
          (std::int64_t{number.high} << 32) | static_cast<std::int64_t>(number.low)};
}

inline rtps::SampleIdentity from_identity(const SampleIdentity& from) {
  rtps::SampleIdentity identity;
  identity.writer_guid(from_guid(from.writer));
  identity.sequence_number(rtps::SequenceNumber_t(static_cast<std::int32_t>(from.sequence >> 32),
                                                  static_cast<std::uint32_t>(from.sequence)));
  return identity;
}

inline std::vector<rtps::octet> octets_of(const std::string& text) {
  return {text.begin(), text.end()};
}

/// What writers and readers offer and ask for alike.
template <class FastQos>
void fill(FastQos& to, const Qos& qos, const std::string& user_data) {
  to.reliability().kind =
      qos.reliable ? fast::RELIABLE_RELIABILITY_QOS : fast::BEST_EFFORT_RELIABILITY_QOS;
  to.durability().kind =
      qos.transient_local ? fast::TRANSIENT_LOCAL_DURABILITY_QOS : fast::VOLATILE_DURABILITY_QOS;
  to.history().kind = fast::KEEP_LAST_HISTORY_QOS;
  to.history().depth = qos.depth;
  to.resource_limits().allocated_samples = 0;
  to.resource_limits().max_samples = 0;
  to.data_sharing().off();
  to.user_data().setValue(octets_of(user_data));
}

}  // namespace canopeer::ros
