#pragma once

#include <string>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/cdr/cdr.h"
#include "canopeer/ros2/camera/camera_model.h"
#include "canopeer/ros2/camera/frame_messages.h"
#include "canopeer/sensing/rgbd_frame.h"

namespace canopeer::ros {

struct FrameAssemblyOptions {
  bool color_is_raw = true;          ///< the lens has to be taken out of the colour images
  bool depth_is_raw = true;          ///< and out of the depth images
  bool depth_is_registered = false;  ///< said by the topic's name; else by the headers' frames
  double min_confidence = 0.5;       ///< labels below it are background
  double min_range_m = 0.15;         ///< nearer and farther surfaces give no return
  double max_range_m = 3.0;
};

/// Makes frames of messages, without their poses. Not thread-safe: it keeps what it knows of the
/// camera.
class FrameAssembler {
 public:
  explicit FrameAssembler(const FrameAssemblyOptions& options) : options_(options) {}

  /// A frame of the smaller of the sizes of its depth and colour images. time_s and pose are left
  /// alone. The error says what is wrong with the messages, and what to ask the driver for.
  [[nodiscard]] Expected<RgbdFrame> assemble(const FrameMessages& messages);

 private:
  struct Known {  // a model, and of what
    Payload info;
    int width = 0, height = 0;
    CameraModel model;
  };
  [[nodiscard]] Expected<RgbdFrame> from_images(const FrameMessages& messages);
  [[nodiscard]] Expected<RgbdFrame> from_cloud(const FrameMessages& messages);
  [[nodiscard]] Expected<void> add_labels(const FrameMessages& messages, RgbdFrame& frame);
  [[nodiscard]] Expected<CameraModel> model(const sensor_msgs::CameraInfo& info, int width,
                                            int height, bool raw);

  const FrameAssemblyOptions options_;
  std::vector<Known> known_;
};

/// What the topics' names say: ".../image_rect..." is rectified, "aligned_depth..." or
/// "..._registered" is registered to the colour images.
[[nodiscard]] FrameAssemblyOptions assembly_options(const std::string& color_topic,
                                                    const std::string& depth_topic);

}  // namespace canopeer::ros
