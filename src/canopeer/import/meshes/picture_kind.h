#pragma once

#include <string>
#include <string_view>

namespace canopeer {

enum class PictureKind { png, jpeg, tga, bmp, gif, psd, webp, unknown };

/// What a picture is, by its bytes; its name says nothing. TGA has no signature: a header that
/// makes sense is one.
[[nodiscard]] PictureKind picture_kind(std::string_view bytes);

/// Of a file of unknown kind: what it is, as far as known, and what to do, to follow its name.
[[nodiscard]] std::string picture_refusal(std::string_view bytes);

}  // namespace canopeer
