#pragma once

#include <string>
#include <string_view>

namespace canopeer {

/// An address with each %20 and the like made the character it stands for; what is none of those
/// stays ("100%").
[[nodiscard]] std::string percent_decoded(std::string_view address);

}  // namespace canopeer
