#include "canopeer/ros2/out/octomap_message.h"

#include "canopeer/map/octomap_file.h"

namespace canopeer::ros {

Expected<octomap_msgs::Octomap> octomap_message(const VoxelMap& map, bool binary,
                                                const std_msgs::Header& header) {
  const auto nodes = binary ? bt_nodes(map) : ot_nodes(map);
  if (!nodes) return tl::unexpected(nodes.error());
  octomap_msgs::Octomap message;
  message.header = header;
  message.binary = binary;
  message.id = "OcTree";
  message.resolution = map.resolution_m();
  message.data.assign(nodes->begin(), nodes->end());
  return message;
}

}  // namespace canopeer::ros
