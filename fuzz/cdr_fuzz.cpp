#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "all_messages.h"
#include "canopeer/cdr/cdr.h"

/// The first octet picks the message; what was read is written and read again.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  std::size_t number = 0;
  const std::size_t picked = data[0] % std::tuple_size_v<canopeer::ros::AllMessages>;
  canopeer::ros::for_each_message([&](const auto& empty) {
    using Message = std::decay_t<decltype(empty)>;
    if (number++ != picked) return;
    const auto read = canopeer::ros::from_cdr<Message>(std::span(data, size).subspan(1));
    if (!read) return;
    const auto written = canopeer::ros::to_cdr(*read);
    const auto again = canopeer::ros::from_cdr<Message>(written);
    if (!again || canopeer::ros::to_cdr(*again) != written) std::abort();
  });
  return 0;
}
