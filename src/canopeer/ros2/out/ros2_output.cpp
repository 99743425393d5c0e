#include "canopeer/ros2/out/ros2_output.h"

#include <utility>

#include "canopeer/ros2/out/mission_parameters.h"
#include "canopeer/ros2/out/robot_description_text.h"

namespace canopeer::ros {

Ros2Output::Ros2Output(const Parts& parts, const Ros2Settings& settings)
    : node_(parts.node),
      clock_(parts.clock),
      settings_(settings.output),
      consent_(settings.confirm, [this](const std::string& question) { tell(question); }) {}
Ros2Output::~Ros2Output() = default;

Expected<std::unique_ptr<Ros2Output>> Ros2Output::make(const Parts& parts) {
  std::unique_ptr<Ros2Output> output(new Ros2Output(parts, parts.settings));
  if (auto ok = output->open(parts); !ok) return tl::unexpected(ok.error());
  return output;
}

Expected<void> Ros2Output::open(const Parts& parts) {
  auto watcher = Ros2Watcher::make({node_, clock_, settings_, parts.robot.setup().camera_frame});
  if (!watcher) return tl::unexpected(watcher.error());
  watcher_ = std::move(*watcher);
  auto services = SteeringServices::make(
      {*node_, consent_, [this] { return save(); }, parts.settings.wait_for_start});
  if (!services) return tl::unexpected(services.error());
  services_ = std::move(*services);
  if (auto ok = open_parameters(parts); !ok) return ok;
  return settings_.enabled ? open_frames(parts) : Expected<void>();
}

Expected<void> Ros2Output::open_parameters(const Parts& parts) {
  const auto now = [clock = clock_] { return ros_time(clock->now()); };
  const auto rate = [this](const char* name, double Ros2OutputSettings::*which) {
    return ParameterAccess{name,
                           "At most so many a second; 0: none.",
                           [this, which] {
                             const std::lock_guard lock(mutex_);
                             return parameter_value(settings_.*which);
                           },
                           [this, which](const ParameterValue& value) -> Expected<void> {
                             set_rate(which, value.double_value);
                             return {};
                           },
                           0.0,
                           100.0};
  };
  std::vector<ParameterAccess> live = {
      rate("output.map_rate_hz", &Ros2OutputSettings::map_rate_hz),
      rate("output.image_rate_hz", &Ros2OutputSettings::image_rate_hz),
      {"confirm", "Every motion is asked for: ~/confirm, ~/refuse.",
       [this] { return parameter_value(consent_.asking()); },
       [this](const ParameterValue& value) -> Expected<void> {
         consent_.set_asking(value.bool_value);
         return {};
       }},
      {"use_sim_time",
       "Time comes from /clock. It holds for the run.",
       [simulated = parts.settings.use_sim_time] { return parameter_value(simulated); },
       {}}};
  auto made = Parameters::make(*node_, mission_parameters(parts.file.settings_json, live), now);
  if (!made) return fail_in("parameters", made.error());
  parameters_ = std::move(*made);
  return {};
}

Expected<void> Ros2Output::open_frames(const Parts& parts) {
  FrameTeller::Parts teller{*node_, *clock_, parts.robot, parts.where};
  if (settings_.robot_description) {
    auto text = robot_description_text(parts.file.robot);
    if (!text) return tl::unexpected(text.error());
    teller.description = std::move(*text);
  }
  auto frames = FrameTeller::make(std::move(teller), settings_);
  if (!frames) return tl::unexpected(frames.error());
  frames_ = std::move(*frames);
  return {};
}

void Ros2Output::set_rate(double Ros2OutputSettings::*which, double rate_hz) {
  const std::lock_guard lock(mutex_);
  settings_.*which = rate_hz;
  watcher_->set_rates(settings_.map_rate_hz, settings_.image_rate_hz);
}

void Ros2Output::save_into(const std::filesystem::path& out) {
  const std::lock_guard lock(mutex_);
  out_ = out;
}

Expected<std::string> Ros2Output::save() const {
  std::filesystem::path out;
  {
    const std::lock_guard lock(mutex_);
    out = out_;
  }
  if (out.empty()) return fail("the run has no directory yet");
  const auto written = watcher_->save(out / "saved");
  if (!written) return tl::unexpected(written.error());
  std::string text = "saved in " + (out / "saved").string() + ":";
  for (const auto& file : *written) text += " " + file.filename().string();
  return text;
}

void Ros2Output::tell(const std::string& text) const { watcher_->say(LogLevel::warn, text); }

}  // namespace canopeer::ros
