#include "canopeer/ros2/check/topic_judgement.h"

#include <algorithm>
#include <fstream>
#include <set>

#include "canopeer/ros2/time/figure.h"

namespace canopeer::ros {
namespace {

constexpr std::string_view kTopicPrefix = "rt/";

std::string kib(std::size_t octets) {
  return figure(static_cast<double>(octets) / 1024.0, 0) + " KiB";
}

std::optional<std::size_t> number_in(const std::filesystem::path& file) {
  std::ifstream in(file);
  std::size_t number = 0;
  if (!(in >> number)) return std::nullopt;
  return number;
}

/// At most a handful of names.
std::string some_of(const std::vector<std::string>& names) {
  constexpr std::size_t kMost = 6;
  std::string list;
  for (std::size_t i = 0; i < std::min(kMost, names.size()); ++i) {
    list += (i == 0 ? "" : ", ") + names[i];
  }
  return list +
         (names.size() > kMost ? " and " + std::to_string(names.size() - kMost) + " more" : "");
}

}  // namespace

std::optional<ReceiveBuffers> receive_buffers(const std::filesystem::path& folder) {
  const auto usual = number_in(folder / "rmem_default"), largest = number_in(folder / "rmem_max");
  if (!usual || !largest) return std::nullopt;
  return ReceiveBuffers{*usual, *largest};
}

std::vector<std::string> topics_of_type(const std::vector<Endpoint>& endpoints,
                                        const std::string& ros_type) {
  const std::string type = dds_type_name(ros_type);
  std::set<std::string> topics;
  for (const Endpoint& endpoint : endpoints) {
    if (!endpoint.writer || endpoint.type != type) continue;
    if (endpoint.topic.rfind(kTopicPrefix, 0) != 0) continue;
    topics.insert("/" + endpoint.topic.substr(kTopicPrefix.size()));
  }
  return {topics.begin(), topics.end()};
}

void judge_topic(const ListenedTopic& topic, const std::vector<Endpoint>& publishers,
                 const std::vector<std::string>& others, double listened_s, Findings& findings) {
  if (publishers.empty()) {
    findings.wrong(topic.what,
                   topic.topic + ": nobody publishes it" +
                       (others.empty() ? "; nor anything of its type"
                                       : "; of its type there are: " + some_of(others)) +
                       " (" + topic.key + ")");
    return;
  }
  const std::string type = dds_type_name(topic.type);
  const auto fits = [&](const Endpoint& endpoint) { return endpoint.type == type; };
  if (std::none_of(publishers.begin(), publishers.end(), fits)) {
    findings.wrong(topic.what, topic.topic + " is " + ros_type_name(publishers.front().type) +
                                   ", expected " + topic.type + " (" + topic.key + ")");
    return;
  }
  const auto reaches = [&](const Endpoint& endpoint) {
    return fits(endpoint) && (endpoint.qos.reliable || !topic.reliable);
  };
  if (std::none_of(publishers.begin(), publishers.end(), reaches)) {
    findings.wrong(topic.what, topic.topic +
                                   " is published best effort and asked for reliable: "
                                   "they never meet; set ros2.camera.reliable to false");
    return;
  }
  if (topic.count == 0) {
    findings.wrong(topic.what,
                   topic.topic + " is published, but nothing came in " + figure(listened_s, 0) +
                       " s: does the driver run, or are images larger than the receive buffer "
                       "(see there; or set ros2.camera.reliable to true)?");
    return;
  }
  const std::string encoding = topic.encoding.empty() ? "" : ", " + topic.encoding;
  const std::string size = topic.octets == 0 ? "" : ", " + kib(topic.octets);
  std::string text = topic.topic + ": " + figure(static_cast<double>(topic.count) / listened_s, 1) +
                     " Hz" + encoding + size;
  std::set<ParticipantId> programs;
  for (const Endpoint& publisher : publishers) programs.insert(participant_of(publisher.guid));
  if (programs.size() > 1) {
    findings.notice(topic.what, text + "; " + std::to_string(programs.size()) +
                                    " programs publish it: are two drivers running?");
    return;
  }
  findings.ok(topic.what, text);
}

void judge_buffers(const std::vector<ListenedTopic>& topics, const ReceiveBuffers& buffers,
                   Findings& findings) {
  const std::string what = "receive buffer";
  std::size_t largest = 0;
  bool reliable = true;
  for (const ListenedTopic& topic : topics) {
    largest = std::max(largest, topic.octets);
    reliable = reliable && topic.reliable;
  }
  const std::string said = kib(buffers.usual);
  // The kernel counts its own overhead too.
  const std::size_t wanted = std::max<std::size_t>(4u << 20, 2 * largest);
  if (largest == 0 || 2 * largest <= buffers.usual) {
    findings.ok(what, said);
    return;
  }
  findings.notice(what, said + ", images are " + kib(largest) + ": " +
                            (reliable ? "many may have to be sent again" : "many may get lost") +
                            "; sudo sysctl -w net.core.rmem_default=" + std::to_string(wanted) +
                            " net.core.rmem_max=" + std::to_string(wanted) +
                            (reliable ? "" : ", or set ros2.camera.reliable to true"));
}

}  // namespace canopeer::ros
