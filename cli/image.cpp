#include "cli/image.h"

#include <png.h>
#include <turbojpeg.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

namespace pstrips::cli {
namespace {

constexpr std::size_t kChannels = 3;

// A texel is decoded to three bytes, then to three floats.
bool fits(std::uint64_t width, std::uint64_t height, const Limits& limits) {
  constexpr std::uint64_t kTexelBytes = kChannels + sizeof(Texture::texels.front());
  return width > 0 && height > 0 && width * height <= limits.memory_bytes / kTexelBytes;
}

Texture texture_of(Index width, Index height, const std::vector<std::uint8_t>& rgb) {
  std::array<float, 256> linear;
  for (std::size_t i = 0; i < linear.size(); ++i)
    linear[i] = linear_of(static_cast<std::uint8_t>(i));
  Texture out{width, height, {}};
  out.texels.reserve(rgb.size() / kChannels);
  for (std::size_t i = 0; i < rgb.size(); i += kChannels)
    out.texels.push_back({linear[rgb[i]], linear[rgb[i + 1]], linear[rgb[i + 2]]});
  return out;
}

std::optional<Texture> decode_png(ByteView file, const Limits& limits) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  const std::unique_ptr<png_image, decltype(&png_image_free)> freed(&image, png_image_free);
  if (png_image_begin_read_from_memory(&image, file.data(), file.size()) == 0) return {};
  if (!fits(image.width, image.height, limits)) return {};
  image.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> rgb(PNG_IMAGE_SIZE(image));
  const png_color white{255, 255, 255};  // behind what is transparent
  if (png_image_finish_read(&image, &white, rgb.data(), 0, nullptr) == 0) return {};
  return texture_of(image.width, image.height, rgb);
}

std::optional<Texture> decode_jpeg(ByteView file, const Limits& limits) {
  const std::unique_ptr<void, decltype(&tjDestroy)> decoder(tjInitDecompress(), tjDestroy);
  if (!decoder) return {};
  const auto* const bytes = reinterpret_cast<const unsigned char*>(file.data());
  int width = 0, height = 0, sampling = 0, colours = 0;
  if (tjDecompressHeader3(decoder.get(), bytes, file.size(), &width, &height, &sampling,
                          &colours) != 0)
    return {};
  if (!fits(static_cast<std::uint64_t>(width), static_cast<std::uint64_t>(height), limits))
    return {};
  std::vector<std::uint8_t> rgb(kChannels * static_cast<std::size_t>(width) *
                                static_cast<std::size_t>(height));
  if (tjDecompress2(decoder.get(), bytes, file.size(), rgb.data(), width, 0, height, TJPF_RGB, 0) !=
      0)
    return {};
  return texture_of(static_cast<Index>(width), static_cast<Index>(height), rgb);
}

bool starts_with(ByteView file, std::initializer_list<unsigned> bytes) {
  return file.size() >= bytes.size() &&
         std::ranges::equal(bytes, file.first(bytes.size()), {}, {},
                            [](std::byte b) { return std::to_integer<unsigned>(b); });
}

}  // namespace

Result<Bytes> write_png(const RgbaImage& image) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = image.width;
  png.height = image.height;
  png.format = PNG_FORMAT_RGBA;
  const std::unique_ptr<png_image, decltype(&png_image_free)> freed(&png, png_image_free);
  Bytes out(PNG_IMAGE_PNG_SIZE_MAX(png));
  png_alloc_size_t size = out.size();
  if (png_image_write_to_memory(&png, out.data(), &size, 0, image.pixels.data(), 0, nullptr) == 0)
    return fail(ErrorCode::io, png.message);
  out.resize(size);
  return out;
}

std::optional<Texture> decode_texture(ByteView file, const Limits& limits) {
  if (starts_with(file, {0x89, 'P', 'N', 'G'})) return decode_png(file, limits);
  if (starts_with(file, {0xff, 0xd8, 0xff})) return decode_jpeg(file, limits);
  return {};
}

float linear_of(std::uint8_t srgb) {
  const float x = static_cast<float>(srgb) / 255;
  return x <= 0.04045f ? x / 12.92f : std::pow((x + 0.055f) / 1.055f, 2.4f);
}

std::uint8_t srgb_of(float linear) {
  const float x = std::clamp(linear, 0.f, 1.f);
  const float y = x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1 / 2.4f) - 0.055f;
  return static_cast<std::uint8_t>(std::lround(255 * y));
}

}  // namespace pstrips::cli
