#pragma once

#include <cstdint>

namespace canopeer::gltf {

// Numbers of the glTF 2.0 specification: component types, targets of views, binary files.
inline constexpr int kByte = 5120;
inline constexpr int kUnsignedByte = 5121;
inline constexpr int kShort = 5122;
inline constexpr int kUnsignedShort = 5123;
inline constexpr int kUnsignedInt = 5125;
inline constexpr int kFloat = 5126;
inline constexpr int kVertexData = 34962;
inline constexpr int kIndexData = 34963;
inline constexpr std::uint32_t kMagic = 0x46546c67;
inline constexpr std::uint32_t kJsonChunk = 0x4e4f534a;
inline constexpr std::uint32_t kBinaryChunk = 0x004e4942;

}  // namespace canopeer::gltf
