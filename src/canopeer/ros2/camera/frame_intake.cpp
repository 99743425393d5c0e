#include "canopeer/ros2/camera/frame_intake.h"

#include <algorithm>

#include "canopeer/base/check.h"

namespace canopeer::ros {
namespace {

std::string encoding_of(const PartMessage& message) {
  if (const auto* raw = std::get_if<sensor_msgs::Image>(&message)) return raw->encoding;
  if (const auto* packed = std::get_if<sensor_msgs::CompressedImage>(&message)) {
    return packed->format;
  }
  return "";
}

std::size_t octets_beside_data(const sensor_msgs::Image& image) { return image.encoding.size(); }
std::size_t octets_beside_data(const sensor_msgs::CompressedImage& image) {
  return image.format.size();
}
std::size_t octets_beside_data(const sensor_msgs::PointCloud2& cloud) {
  std::size_t sum = 0;
  for (const auto& field : cloud.fields) sum += sizeof field + field.name.size();
  return sum;
}

std::size_t octets_of_frame(const FrameMessages& frame) {
  std::size_t sum = 0;
  for (const auto& part : frame.parts) sum += part != nullptr ? octets_of(*part) : 0;
  return sum;
}

}  // namespace

std::size_t octets_of(const PartMessage& message) {
  const auto count = [](const auto& m) {
    return m.header.frame_id.size() + octets_beside_data(m) + m.data.size();
  };
  return std::visit(count, message);
}

FrameIntake::FrameIntake(FrameIntakeOptions options)
    : options_(std::move(options)), sync_(options_.parts.size(), options_.sync) {}

void FrameIntake::add(FramePart part, PartMessage message, Stamp now) {
  const auto stream = std::find(options_.parts.begin(), options_.parts.end(), part);
  CANOPEER_CHECK(stream != options_.parts.end(), "a part that was asked for");
  const Stamp stamp = stamp_of(header_of(message).stamp);
  const std::size_t octets = octets_of(message);
  const std::lock_guard lock(mutex_);
  Heard& heard = heard_[static_cast<std::size_t>(part)];
  ++heard.count;
  heard.last = Steady::now();
  heard.frame_id = header_of(message).frame_id;
  heard.encoding = encoding_of(message);
  heard.octets = octets;
  if (stamp <= 0) {
    ++heard.without_stamp;
    return;
  }
  heard.newest = std::max(heard.newest.value_or(stamp), stamp);
  ages_[static_cast<std::size_t>(part)].add(now - stamp);
  auto sets = sync_.add(static_cast<std::size_t>(stream - options_.parts.begin()), stamp,
                        std::make_shared<const PartMessage>(std::move(message)), octets);
  for (auto& set : sets) keep(std::move(set));
  if (!sets.empty()) news_.notify_all();
}

void FrameIntake::keep(FrameSync<Message>::Set&& set) {
  auto frame = std::make_shared<FrameMessages>();
  frame->stamp = set.stamp;
  frame->arrived = Steady::now();
  frame->info = info_;
  for (std::size_t i = 0; i < set.items.size(); ++i) {
    frame->parts[static_cast<std::size_t>(options_.parts[i])] = std::move(set.items[i]);
  }
  ++joined_;
  if (options_.needs_info && info_ == nullptr) return;
  if (!kept_.empty() && frame->stamp < kept_.back()->stamp) {  // the clock was set back
    kept_.clear();
    kept_octets_ = 0;
  }
  kept_octets_ += octets_of_frame(*frame);
  kept_.push_back(std::move(frame));
  while (kept_.size() > options_.max_kept ||
         (kept_.size() > 1 && kept_octets_ > options_.max_kept_octets)) {
    kept_octets_ -= octets_of_frame(*kept_.front());
    kept_.pop_front();
  }
}

void FrameIntake::set_info(sensor_msgs::CameraInfo info) {
  const std::lock_guard lock(mutex_);
  info_ = std::make_shared<const sensor_msgs::CameraInfo>(std::move(info));
}

std::shared_ptr<const FrameMessages> FrameIntake::wait_for(Stamp from, Steady::time_point until) {
  std::unique_lock lock(mutex_);
  news_.wait_until(lock, until, [&] { return !kept_.empty() && kept_.back()->stamp >= from; });
  return !kept_.empty() && kept_.back()->stamp >= from ? kept_.back() : nullptr;
}

std::vector<std::shared_ptr<const FrameMessages>> FrameIntake::after(Stamp stamp) const {
  const std::lock_guard lock(mutex_);
  std::vector<std::shared_ptr<const FrameMessages>> frames;
  for (const auto& frame : kept_) {
    if (frame->stamp > stamp) frames.push_back(frame);
  }
  return frames;
}

FrameIntake::Heard FrameIntake::heard(FramePart part) const {
  const std::lock_guard lock(mutex_);
  Heard heard = heard_[static_cast<std::size_t>(part)];
  heard.least_age_s = ages_[static_cast<std::size_t>(part)].least_age_s();
  return heard;
}

std::optional<sensor_msgs::CameraInfo> FrameIntake::info() const {
  const std::lock_guard lock(mutex_);
  if (info_ == nullptr) return std::nullopt;
  return *info_;
}

std::int64_t FrameIntake::joined() const {
  const std::lock_guard lock(mutex_);
  return joined_;
}

std::int64_t FrameIntake::dropped() const {
  const std::lock_guard lock(mutex_);
  return sync_.dropped();
}

}  // namespace canopeer::ros
