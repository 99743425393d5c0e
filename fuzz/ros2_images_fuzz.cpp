#include <cstddef>
#include <cstdint>
#include <span>

#include "canopeer/cdr/cdr.h"
#include "canopeer/ros2/camera/camera_model.h"
#include "canopeer/ros2/camera/compressed_image.h"
#include "canopeer/ros2/camera/organised_cloud.h"
#include "canopeer/ros2/camera/raw_image.h"

/// The first octet picks what the rest is taken for.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace canopeer::ros;
  if (size == 0) return 0;
  const auto payload = std::span(data, size).subspan(1);
  switch (data[0] % 4) {
    case 0:
      if (const auto image = from_cdr<sensor_msgs::Image>(payload)) {
        static_cast<void>(color_of(*image));
        static_cast<void>(depth_of(*image));
        static_cast<void>(labels_of(*image));
        static_cast<void>(confidences_of(*image));
      }
      break;
    case 1:
      if (const auto image = from_cdr<sensor_msgs::CompressedImage>(payload)) {
        static_cast<void>(color_of(*image));
        static_cast<void>(depth_of(*image));
        static_cast<void>(labels_of(*image));
      }
      break;
    case 2:
      if (const auto cloud = from_cdr<sensor_msgs::PointCloud2>(payload)) {
        static_cast<void>(images_of(*cloud));
      }
      break;
    default:
      if (const auto info = from_cdr<sensor_msgs::CameraInfo>(payload)) {
        static_cast<void>(camera_model(*info, 64, 48, true));
      }
  }
  return 0;
}
