#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "codecs/render/rasterizer.h"
#include "core/bytes.h"
#include "core/limits.h"
#include "core/result.h"
#include "core/scene.h"

namespace pstrips::cli {

/// Rows from top to bottom; sRGB, alpha not multiplied in.
struct RgbaImage {
  std::uint32_t width = 0, height = 0;
  std::vector<std::uint8_t> pixels;  ///< 4 each
};

/// errors  runtime failures of the encoder as io
Result<Bytes> write_png(const RgbaImage& image);

/// The encoded PNG or JPEG file of an image as linear colours; nothing for other formats, files
/// that are broken and those of more pixels than `limits` have memory for.
std::optional<Texture> decode_texture(ByteView file, const Limits& limits);

/// Between linear colours and their sRGB bytes. [IEC 61966-2-1]
float linear_of(std::uint8_t srgb);
std::uint8_t srgb_of(float linear);

}  // namespace pstrips::cli
