#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "canopeer/base/expected.h"
#include "canopeer/scene/texture.h"

namespace canopeer {

/// A picture file in memory: PNG, JPEG, or what read_picture() reads, told apart by its bytes.
/// Alpha becomes opacity. `name` stands for the file in messages.
[[nodiscard]] Expected<Texture> decode_texture(std::string_view bytes, const std::string& name);

/// A PNG file in memory, with alpha when the texture has an opacity of the colour's size.
[[nodiscard]] Expected<std::string> encode_texture(const Texture& texture);

/// Reads each texture file once.
class TextureStore {
 public:
  using Result = Expected<std::shared_ptr<const Texture>>;
  [[nodiscard]] Result get(const std::filesystem::path& path);

 private:
  std::map<std::string, Result> read_;
};

}  // namespace canopeer
