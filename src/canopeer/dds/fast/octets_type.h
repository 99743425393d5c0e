#pragma once

#include <cstddef>
#include <cstdint>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <functional>
#include <span>
#include <string>

#include "canopeer/dds/fast/fast_dds.h"

namespace canopeer::ros {

/// What the library calls data: octets going out, or those that came in.
struct Octets {
  std::span<const std::uint8_t> out;
  Payload in;
};

/// Whatever the type's name: the payload, its encapsulation header included.
class OctetsType final : public fast::TopicDataType {
 public:
  OctetsType(const std::string& name, std::size_t max_payload);
#if CANOPEER_FAST_DDS >= 3
  bool serialize(const void* data, rtps::SerializedPayload_t& payload,
                 fast::DataRepresentationId_t) override;
  bool deserialize(rtps::SerializedPayload_t& payload, void* data) override;
  std::uint32_t calculate_serialized_size(const void* data, fast::DataRepresentationId_t) override;
  void* create_data() override;
  void delete_data(void* data) override;
  bool compute_key(rtps::SerializedPayload_t&, rtps::InstanceHandle_t&, bool) override;
  bool compute_key(const void*, rtps::InstanceHandle_t&, bool) override;
#else
  bool serialize(void* data, rtps::SerializedPayload_t* payload) override;
  bool deserialize(rtps::SerializedPayload_t* payload, void* data) override;
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override;
  void* createData() override;
  void deleteData(void* data) override;
  bool getKey(void*, rtps::InstanceHandle_t*, bool) override;
#endif
};

}  // namespace canopeer::ros
