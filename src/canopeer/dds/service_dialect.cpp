#include "canopeer/dds/service_dialect.h"

#include <algorithm>
#include <cstring>
#include <random>

namespace canopeer::ros {
namespace {

constexpr std::size_t kEncapsulation = 4;
constexpr std::size_t kHead = 16;

}  // namespace

Expected<Rmw> dialect_of(const std::set<Rmw>& servers) {
  if (servers.empty()) return fail("no server is there");
  if (servers.contains(Rmw::unknown)) {
    return fail(
        "a server is on a ROS middleware that is spoken otherwise: start it with "
        "RMW_IMPLEMENTATION=rmw_fastrtps_cpp or rmw_cyclonedds_cpp");
  }
  if (servers.size() == 1) return *servers.begin();
  return fail(
      "there are servers on rmw_fastrtps and on rmw_cyclonedds, who would misread each other's "
      "requests: stop one of them");
}

Payload with_head(const Payload& body, const RequestHead& head) {
  Payload payload(body.size() + kHead);
  const auto members = body.begin() + kEncapsulation;
  std::copy(body.begin(), members, payload.begin());
  std::memcpy(payload.data() + kEncapsulation, &head.client, 8);
  std::memcpy(payload.data() + kEncapsulation + 8, &head.sequence, 8);
  std::copy(members, body.end(), payload.begin() + kEncapsulation + kHead);
  return payload;
}

std::optional<HeadAndBody> split_head(Payload&& payload) {
  try {
    HeadAndBody parts;
    CdrReader reader(payload);
    reader(parts.head.client, parts.head.sequence);
    parts.body = std::move(payload);
    const auto begin = parts.body.begin() + kEncapsulation;
    parts.body.erase(begin, begin + kHead);
    return parts;
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

std::string new_pair_mark(const std::string& key) {
  static constexpr const char* kDigits = "0123456789abcdef";
  std::random_device random;
  std::string mark = key + "=";
  for (int i = 0; i < 16; ++i) {
    const unsigned octet = random() & 0xFFu;
    if (i > 0) mark += '.';
    if (octet > 0xF) mark += kDigits[octet >> 4];
    mark += kDigits[octet & 0xF];
  }
  return mark + ";";
}

std::string user_data_value(const std::string& user_data, const std::string& key) {
  for (std::size_t at = 0; at < user_data.size();) {
    const std::size_t end = std::min(user_data.find(';', at), user_data.size());
    const std::string item = user_data.substr(at, end - at);
    if (item.starts_with(key + "=")) return item.substr(key.size() + 1);
    at = end + 1;
  }
  return {};
}

}  // namespace canopeer::ros
