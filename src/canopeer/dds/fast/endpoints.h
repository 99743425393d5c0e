#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include "canopeer/dds/delivery.h"
#include "canopeer/dds/fast/fast_dds.h"

namespace eprosima::fastdds::dds {
class Publisher;
class Subscriber;
class Topic;
}  // namespace eprosima::fastdds::dds

namespace canopeer::ros {

/// Null if the library makes none. Goes before publisher and delivery.
[[nodiscard]] std::unique_ptr<Writer> make_writer(fast::Publisher& publisher, fast::Topic& topic,
                                                  Delivery& delivery, const Qos& qos,
                                                  const std::string& user_data,
                                                  std::function<void()> on_match);

/// Null if the library makes none. At most `most_octets` of samples wait for `on_sample`. Goes
/// before subscriber and delivery.
[[nodiscard]] std::unique_ptr<Reader> make_reader(fast::Subscriber& subscriber, fast::Topic& topic,
                                                  Delivery& delivery, const Qos& qos,
                                                  const std::string& user_data,
                                                  std::size_t most_octets,
                                                  std::function<void(Sample&&)> on_sample);

}  // namespace canopeer::ros
