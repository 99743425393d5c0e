#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "canopeer/base/expected.h"
#include "canopeer/config/ros2_settings.h"
#include "canopeer/ros2/camera/frame_assembly.h"
#include "canopeer/ros2/camera/frame_intake.h"
#include "canopeer/ros2/camera/frame_poses.h"

namespace canopeer::ros {

/// A frame and how it came.
struct TimedFrame {
  RgbdFrame frame;
  Stamp stamp = 0;         ///< by the clock of joint states: the image's stamp and time_offset_s
  double waited_s = 0.0;   ///< from the arrival of its last message to its use
  double decoded_s = 0.0;  ///< what it took to decode
};

/// Frames with poses out of what came in, and which of them counts. Does not know where messages
/// come from. Thread-safe.
class CameraFeed {
 public:
  struct Parts {
    FrameIntakeOptions intake;
    FrameAssemblyOptions assembly;
    /// The topic of a part, for errors; who publishes on it is added by `publishers`.
    std::function<std::string(FramePart)> topic;
    std::string info_topic;
    /// What is odd about a topic's publishers: none, another type, another quality of service.
    /// Empty: nothing.
    std::function<std::string(const std::string& topic)> odd_publishers;
    std::function<double(Stamp)> mission_time_s;  ///< of a stamp by the clock of joint states
    /// Asked while a frame is waited for. The error, which ends that: the robot is lost. Empty:
    /// nobody knows.
    std::function<Expected<void>()> alive{};
  };
  /// Joints and poses outlive it.
  CameraFeed(const Ros2CameraSettings& settings, Parts parts, const JointHistory& joints,
             std::unique_ptr<FramePoses> poses);

  [[nodiscard]] FrameIntake& intake() { return intake_; }

  /// Frames from before are not taken any more by capture(): something that moves the camera has
  /// just stopped. By the clock of joint states.
  void not_before(Stamp stamp);

  /// The newest frame whose stamp lies `settle_s` after the arm stood still, or later, and none
  /// twice; waits for it up to `timeout_s`. Messages that cannot be read are counted and passed
  /// over. The error says what is missing and where.
  [[nodiscard]] Expected<TimedFrame> capture();

  /// Frames taken after `stamp` (by the clock of joint states) whether the arm moves or not, by
  /// time, each at the pose of its time. Frames whose pose is not known yet are left for later.
  /// The last dozens are kept only: ask often.
  [[nodiscard]] std::vector<TimedFrame> frames_since(Stamp stamp);

  /// The same before they are decoded.
  using Messages = std::shared_ptr<const FrameMessages>;
  [[nodiscard]] std::vector<Messages> messages_since(Stamp stamp) const;
  /// When they were taken, by the clock of joint states.
  [[nodiscard]] Stamp stamp_of(const FrameMessages& messages) const {
    return messages.stamp + offset_;
  }
  [[nodiscard]] const std::string& frame_id(const FrameMessages& messages) const;
  [[nodiscard]] Expected<TimedFrame> decode(const FrameMessages& messages);

  /// Where the camera was, by the clock of joint states.
  [[nodiscard]] Expected<Pose> pose_at(Stamp stamp, const std::string& frame_id) const {
    return poses_->at(stamp, frame_id);
  }

  /// Messages that could not be read.
  [[nodiscard]] std::int64_t malformed() const;
  /// Why the last of them could not be read; empty: none.
  [[nodiscard]] std::string last_flaw() const;

 private:
  /// From when on frames count; nothing: joints are not known.
  [[nodiscard]] std::optional<Stamp> counts_from() const;
  /// The stamp of the frame that capture() gave last, by the camera's clock. 0: none yet, or the
  /// clock was set back since.
  [[nodiscard]] Stamp last_given() const;
  /// The newest that came after `after` (camera's clock) and whose pose is known; null: none.
  [[nodiscard]] std::shared_ptr<const FrameMessages> newest_with_pose(Stamp after,
                                                                      std::string* why_none) const;
  [[nodiscard]] Error timeout_error(const std::string& why_none, Stamp from) const;
  [[nodiscard]] std::string silent_topics() const;

  const Ros2CameraSettings settings_;
  const Parts parts_;
  const JointHistory& joints_;
  const std::unique_ptr<FramePoses> poses_;
  const std::int64_t offset_;  // from the camera's clock to that of joint states
  FrameIntake intake_;
  mutable std::mutex mutex_;  // of all below
  FrameAssembler assembler_;
  Stamp not_before_ = 0;
  Stamp given_ = 0;  // see last_given()
  std::int64_t malformed_ = 0;
  std::string last_flaw_;
  Stamp unreadable_ = 0;  // stamp of the last frame that could not be read
};

}  // namespace canopeer::ros
