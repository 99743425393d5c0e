#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

// Who has which nodes (topic "ros_discovery_info"). Two layouts have one name: an id has 24 octets
// up to Humble and 16 from Iron on. A node that gets the wrong one may abort.

namespace canopeer::ros::rmw_dds_common {

inline constexpr std::size_t kHumbleGid = 24;
inline constexpr std::size_t kIronGid = 16;

template <std::size_t N>
struct Gid {
  std::array<std::uint8_t, N> data{};
  template <class Archive>
  void visit(Archive& archive) {
    archive(data);
  }
};

template <std::size_t N>
struct NodeEntitiesInfo {
  std::string node_namespace;
  std::string node_name;
  std::vector<Gid<N>> reader_gid_seq;
  std::vector<Gid<N>> writer_gid_seq;
  template <class Archive>
  void visit(Archive& archive) {
    archive(node_namespace, node_name, reader_gid_seq, writer_gid_seq);
  }
};

template <std::size_t N>
struct ParticipantEntitiesInfo {
  static constexpr std::string_view kType = "rmw_dds_common/msg/ParticipantEntitiesInfo";
  Gid<N> gid;
  std::vector<NodeEntitiesInfo<N>> node_entities_info_seq;
  template <class Archive>
  void visit(Archive& archive) {
    archive(gid, node_entities_info_seq);
  }
};

}  // namespace canopeer::ros::rmw_dds_common
