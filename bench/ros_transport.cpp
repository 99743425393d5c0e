// What it costs to speak ROS 2 between two processes of this machine: a camera of 640 × 480 pixels
// at 30 Hz, colour and depth (65 MB/s), and calls of a service.
//   ros_transport [SECONDS]
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <thread>

#include "canopeer/cdr/messages/sensor_msgs.h"
#include "canopeer/cdr/messages/std_srvs.h"
#include "canopeer/dds/service.h"
#include "support/must.h"
#include "support/own_network.h"

namespace {

using namespace canopeer;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;
using ros::sensor_msgs::Image;
using ros::std_srvs::SetBool;

constexpr int kWidth = 640;
constexpr int kHeight = 480;
constexpr auto kPeriod = std::chrono::microseconds(33'333);

std::unique_ptr<ros::Node> node_named(const std::string& name) {
  ros::NodeOptions options;
  options.name = name;
  options.participant.domain = testing_support::own_domain();
  return must(ros::Node::make(options));
}

Image image_of(const std::string& encoding, int octets) {
  Image image;
  image.width = kWidth;
  image.height = kHeight;
  image.encoding = encoding;
  image.step = static_cast<std::uint32_t>(kWidth * octets);
  image.data.resize(std::size_t{image.step} * kHeight, 7);
  return image;
}

/// Stamped by the clock that both processes share.
void stamp(Image& image) {
  const auto now = Clock::now().time_since_epoch();
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(now);
  image.header.stamp.sec = static_cast<std::int32_t>(seconds.count());
  image.header.stamp.nanosec = static_cast<std::uint32_t>((now - seconds).count());
}

double age_ms(const Image& image) {
  const auto then = std::chrono::seconds(image.header.stamp.sec) +
                    std::chrono::nanoseconds(image.header.stamp.nanosec);
  return std::chrono::duration<double, std::milli>(Clock::now().time_since_epoch() - then).count();
}

double used_cpu_s() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// The other process: sends images, answers calls, until it is killed.
[[noreturn]] void be_the_camera() {
  const auto node = node_named("camera");
  const auto color = must(node->advertise<Image>("/color"));
  const auto depth = must(node->advertise<Image>("/depth"));
  const auto server =
      must(ros::Server<SetBool>::make(*node, "/turn", [](SetBool::Request&& request, auto reply) {
        reply({!request.data, ""});
      }));
  Image rgb = image_of("rgb8", 3);
  Image metres = image_of("32FC1", 4);
  double before = used_cpu_s();
  int sent = 0;
  for (auto next = Clock::now();; next += kPeriod) {
    std::this_thread::sleep_until(next);
    if (color.readers() == 0 || depth.readers() == 0) continue;
    stamp(rgb);
    color.publish(rgb);
    stamp(metres);
    depth.publish(metres);
    if (++sent % 150 != 0) continue;
    std::printf("camera   %5.1f %% of a core\n", (used_cpu_s() - before) * 100.0 / 5.0);
    std::fflush(stdout);
    before = used_cpu_s();
  }
}

double share(std::vector<double>& sorted, double part) {
  return sorted[static_cast<std::size_t>(part * static_cast<double>(sorted.size() - 1))];
}

void tell(const char* name, std::vector<double> values, const char* unit) {
  if (values.empty()) {
    std::printf("%s nothing came\n", name);
    return;
  }
  std::sort(values.begin(), values.end());
  std::printf("%s median %.2f, p95 %.2f, longest %.2f %s (%zu)\n", name, share(values, 0.5),
              share(values, 0.95), values.back(), unit, values.size());
}

void watch_images(ros::Node& node, const ros::Qos& qos, const char* name,
                  std::chrono::seconds duration) {
  std::mutex mutex;
  std::vector<double> ages;
  const auto note = [&](Image&& image, const ros::Guid&) {
    const double age = age_ms(image);
    const std::lock_guard lock(mutex);
    ages.push_back(age);
  };
  auto color = must(node.subscribe<Image>("/color", qos, note));
  auto depth = must(node.subscribe<Image>("/depth", qos, note));
  std::this_thread::sleep_for(1s);
  {
    const std::lock_guard lock(mutex);
    ages.clear();
  }
  const double before = used_cpu_s();
  std::this_thread::sleep_for(duration);
  const double cpu = used_cpu_s() - before;
  color.reset();
  depth.reset();
  tell(name, ages, "ms");
  std::printf("         %.1f %% of images lost, %.1f %% of a core to receive them\n",
              100.0 - 100.0 * static_cast<double>(ages.size()) /
                          (60.0 * static_cast<double>(duration.count())),
              cpu * 100.0 / static_cast<double>(duration.count()));
}

void call(ros::Node& node) {
  auto client = must(ros::Client<SetBool>::make(node, "/turn"));
  while (!client.ready()) std::this_thread::sleep_for(5ms);
  std::vector<double> times;
  for (int i = 0; i < 1000; ++i) {
    const auto start = Clock::now();
    must(client.call({true}, 5s));
    times.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
  }
  tell("service ", times, "ms");
}

}  // namespace

int main(int argc, char** argv) {
  const std::chrono::seconds duration(argc > 1 ? std::atoi(argv[1]) : 10);
  canopeer::testing_support::enter_own_network();
  const pid_t camera = fork();
  if (camera == 0) be_the_camera();
  {
    const auto node = node_named("watcher");
    call(*node);
    watch_images(*node, ros::kDefaultQos, "reliable", duration);
    watch_images(*node, ros::kSensorQos, "lossy   ", duration);
  }
  kill(camera, SIGKILL);
  waitpid(camera, nullptr, 0);
  return 0;
}
