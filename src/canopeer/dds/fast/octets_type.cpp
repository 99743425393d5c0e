#include "canopeer/dds/fast/octets_type.h"

#include <cstring>

namespace canopeer::ros {
namespace {

std::uint32_t length_of(const void* data) {
  return static_cast<std::uint32_t>(static_cast<const Octets*>(data)->out.size());
}

bool put(const void* data, rtps::SerializedPayload_t& payload) {
  const std::uint32_t length = length_of(data);
  if (length > payload.max_size) return false;
  std::memcpy(payload.data, static_cast<const Octets*>(data)->out.data(), length);
  payload.length = length;
  payload.encapsulation = CDR_LE;
  return true;
}

bool get(const rtps::SerializedPayload_t& payload, void* data) {
  static_cast<Octets*>(data)->in.assign(payload.data, payload.data + payload.length);
  return true;
}

}  // namespace

#if CANOPEER_FAST_DDS >= 3

OctetsType::OctetsType(const std::string& name, std::size_t max_payload) {
  set_name(name);
  max_serialized_type_size = static_cast<std::uint32_t>(max_payload);
}
bool OctetsType::serialize(const void* data, rtps::SerializedPayload_t& payload,
                           fast::DataRepresentationId_t) {
  return put(data, payload);
}
bool OctetsType::deserialize(rtps::SerializedPayload_t& payload, void* data) {
  return get(payload, data);
}
std::uint32_t OctetsType::calculate_serialized_size(const void* data,
                                                    fast::DataRepresentationId_t) {
  return length_of(data);
}
void* OctetsType::create_data() { return new Octets; }
void OctetsType::delete_data(void* data) { delete static_cast<Octets*>(data); }
bool OctetsType::compute_key(rtps::SerializedPayload_t&, rtps::InstanceHandle_t&, bool) {
  return false;
}
bool OctetsType::compute_key(const void*, rtps::InstanceHandle_t&, bool) { return false; }

#else

OctetsType::OctetsType(const std::string& name, std::size_t max_payload) {
  setName(name.c_str());
  m_typeSize = static_cast<std::uint32_t>(max_payload);
  m_isGetKeyDefined = false;
  auto_fill_type_object(false);
  auto_fill_type_information(false);
}
bool OctetsType::serialize(void* data, rtps::SerializedPayload_t* payload) {
  return put(data, *payload);
}
bool OctetsType::deserialize(rtps::SerializedPayload_t* payload, void* data) {
  return get(*payload, data);
}
std::function<std::uint32_t()> OctetsType::getSerializedSizeProvider(void* data) {
  return [data] { return length_of(data); };
}
void* OctetsType::createData() { return new Octets; }
void OctetsType::deleteData(void* data) { delete static_cast<Octets*>(data); }
bool OctetsType::getKey(void*, rtps::InstanceHandle_t*, bool) { return false; }

#endif

}  // namespace canopeer::ros
