#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace canopeer {

/// Undoes LZF compression (Lehmann's format, which compressed PCD files use). `size`: bytes that
/// must come out. Nothing when the data is damaged, or so short that it cannot hold `size` bytes.
[[nodiscard]] std::optional<std::string> lzf_decompress(std::string_view data, std::size_t size);

}  // namespace canopeer
