#include "canopeer/ros2/camera/camera_feed.h"

#include <algorithm>
#include <cstdio>
#include <thread>

namespace canopeer::ros {
namespace {

using IntakeClock = FrameIntake::Steady;

/// Joints that move less stand still: what encoders and a light breeze of vibration make.
constexpr double kStill = 2e-3;  // rad or m
/// A topic that says nothing for less is slow.
constexpr double kSilent_s = 1.0;
/// Joint states may be late by less.
constexpr std::int64_t kFarBack = 5 * kNanosecondsPerSecond;
/// How long one waits before looking at the joints again.
constexpr auto kGlance = std::chrono::milliseconds(20);

double seconds_between(IntakeClock::time_point from, IntakeClock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

IntakeClock::duration in_seconds(double s) {
  return std::chrono::duration_cast<IntakeClock::duration>(std::chrono::duration<double>(s));
}

std::string text_of_seconds(double s) {
  char text[40];
  std::snprintf(text, sizeof text, "%.3g s", s);
  return text;
}

}  // namespace

CameraFeed::CameraFeed(const Ros2CameraSettings& settings, Parts parts, const JointHistory& joints,
                       std::unique_ptr<FramePoses> poses)
    : settings_(settings),
      parts_(std::move(parts)),
      joints_(joints),
      poses_(std::move(poses)),
      offset_(nanoseconds(settings.time_offset_s)),
      intake_(parts_.intake),
      assembler_(parts_.assembly) {}

void CameraFeed::not_before(Stamp stamp) {
  const std::lock_guard lock(mutex_);
  not_before_ = stamp;
}

const std::string& CameraFeed::frame_id(const FrameMessages& messages) const {
  return header_of(*messages.part(parts_.intake.parts.front())).frame_id;
}

Expected<TimedFrame> CameraFeed::decode(const FrameMessages& messages) {
  TimedFrame timed;
  timed.stamp = messages.stamp + offset_;
  const auto T_world_camera = poses_->at(timed.stamp, frame_id(messages));
  if (!T_world_camera) return tl::unexpected(T_world_camera.error());
  const auto began = IntakeClock::now();
  const std::lock_guard lock(mutex_);
  auto frame = assembler_.assemble(messages);
  if (!frame) {
    if (unreadable_ != messages.stamp) ++malformed_;
    unreadable_ = messages.stamp;
    last_flaw_ = frame.error().message;
    return tl::unexpected(frame.error());
  }
  timed.frame = std::move(*frame);
  timed.frame.T_world_camera = *T_world_camera;
  timed.frame.time_s = parts_.mission_time_s(timed.stamp);
  timed.waited_s = seconds_between(messages.arrived, began);
  timed.decoded_s = seconds_between(began, IntakeClock::now());
  return timed;
}

std::optional<Stamp> CameraFeed::counts_from() const {
  const auto still_since = joints_.still_since(kStill);
  if (!still_since) return std::nullopt;
  const std::lock_guard lock(mutex_);
  return std::max(*still_since, not_before_) + nanoseconds(settings_.settle_s);
}

Stamp CameraFeed::last_given() const {
  const auto newest = joints_.newest();
  const std::lock_guard lock(mutex_);
  const bool was_set_back = newest && given_ + offset_ > *newest + kFarBack;
  return was_set_back ? 0 : given_;
}

std::shared_ptr<const FrameMessages> CameraFeed::newest_with_pose(Stamp after,
                                                                  std::string* why_none) const {
  std::shared_ptr<const FrameMessages> newest;
  for (const auto& messages : intake_.after(after)) {
    const auto known_until = poses_->known_until(frame_id(*messages));
    if (known_until && *known_until >= messages->stamp + offset_) {
      newest = messages;
    } else if (const auto pose = poses_->at(messages->stamp + offset_, frame_id(*messages));
               !pose) {
      *why_none = pose.error().message;
    }
  }
  return newest;
}

Expected<TimedFrame> CameraFeed::capture() {
  const auto deadline = IntakeClock::now() + in_seconds(settings_.timeout_s);
  std::string why_none;
  Stamp from = 0, tried = 0;
  while (IntakeClock::now() < deadline) {
    if (auto ok = parts_.alive ? parts_.alive() : Expected<void>(); !ok) {
      return tl::unexpected(ok.error());
    }
    const auto counts = counts_from();
    if (!counts) {
      why_none = "not all of the arm's joints are in the joint states";
      std::this_thread::sleep_for(kGlance);
      continue;
    }
    from = *counts;
    const Stamp first = std::max({from - offset_, tried + 1, last_given() + 1});
    if (!intake_.wait_for(first, std::min(deadline, IntakeClock::now() + kGlance))) continue;
    const auto messages = newest_with_pose(first - 1, &why_none);
    if (messages == nullptr) {  // its joint states come soon
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      continue;
    }
    // The arm may move again since.
    if (counts_from().value_or(from) > messages->stamp + offset_) continue;
    tried = messages->stamp;
    auto frame = decode(*messages);
    if (frame) {
      const std::lock_guard lock(mutex_);
      given_ = messages->stamp;
      return frame;
    }
    why_none = frame.error().message;
  }
  return tl::unexpected(timeout_error(why_none, from));
}

std::vector<TimedFrame> CameraFeed::frames_since(Stamp stamp) {
  std::vector<TimedFrame> frames;
  for (const Messages& messages : messages_since(stamp)) {
    if (auto frame = decode(*messages)) frames.push_back(std::move(*frame));
  }
  return frames;
}

std::vector<CameraFeed::Messages> CameraFeed::messages_since(Stamp stamp) const {
  std::vector<Messages> all = intake_.after(stamp - offset_);
  const auto unknown = std::find_if(all.begin(), all.end(), [&](const Messages& messages) {
    const auto known_until = poses_->known_until(frame_id(*messages));
    return !known_until || *known_until < stamp_of(*messages);
  });
  all.erase(unknown, all.end());
  return all;
}

std::int64_t CameraFeed::malformed() const {
  const std::lock_guard lock(mutex_);
  return malformed_;
}

std::string CameraFeed::last_flaw() const {
  const std::lock_guard lock(mutex_);
  return last_flaw_;
}

std::string CameraFeed::silent_topics() const {
  std::string text;
  const auto add = [&](const std::string& topic, const std::string& since) {
    const std::string odd = parts_.odd_publishers(topic);
    text += (text.empty() ? "nothing came on " : ", nor on ") + topic + since +
            (odd.empty() ? "" : " (" + odd + ")");
  };
  for (const FramePart part : parts_.intake.parts) {
    const auto heard = intake_.heard(part);
    if (heard.count > 0 && heard.without_stamp == heard.count) {
      return "images on " + parts_.topic(part) + " have no stamp: set the driver's clock";
    }
    if (!heard.last) {
      add(parts_.topic(part), "");
      continue;
    }
    const double silence = seconds_between(*heard.last, IntakeClock::now());
    if (silence < std::max(settings_.timeout_s, kSilent_s)) continue;
    add(parts_.topic(part), " for " + text_of_seconds(silence));
  }
  if (parts_.intake.needs_info && !intake_.info()) add(parts_.info_topic, "");
  return text;
}

Error CameraFeed::timeout_error(const std::string& why_none, Stamp from) const {
  const std::string head = "no frame within " + text_of_seconds(settings_.timeout_s) + ": ";
  if (!why_none.empty()) return {head + why_none};
  if (const std::string silent = silent_topics(); !silent.empty()) return {head + silent};
  const auto newest = intake_.heard(parts_.intake.parts.front()).newest;
  if (intake_.after(0).empty() && newest) {
    return {head + "images came, but no depth and colour within " +
            text_of_seconds(settings_.max_difference_s) +
            " of each other: have the driver synchronise them, or raise max_difference_s"};
  }
  if (newest && *newest + offset_ < from) {
    return {head + "the newest image is stamped " +
            text_of_seconds(seconds(from - *newest - offset_)) +
            " before the arm had stood still for settle_s: does the arm move, or is the camera's "
            "clock behind (time_offset_s)?"};
  }
  if (newest && *newest <= last_given()) {
    return {head + "nothing came on " + parts_.topic(parts_.intake.parts.front()) +
            " since the last frame"};
  }
  return {head + "the arm does not stand still"};
}

}  // namespace canopeer::ros
