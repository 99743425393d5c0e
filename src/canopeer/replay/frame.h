#pragma once

#include <string>
#include <string_view>

#include "canopeer/base/expected.h"

namespace canopeer {

/// One message to who watches a run (docs/live-view.md): a line of JSON, and octets.
struct Frame {
  std::string head;    ///< a JSON object with "type"; "bytes" is added when it is written
  std::string octets;  ///< may be empty

  /// As it goes over the wire.
  [[nodiscard]] std::string bytes() const;
};

/// The "type" of a frame as it goes over the wire; empty: it is none.
[[nodiscard]] std::string_view frame_type(std::string_view bytes);

}  // namespace canopeer
