#include "formats/gltf/image_type.h"

#include <algorithm>

#include "core/text.h"

namespace pstrips::inline formats::gltf {

std::string_view mime_type_of(ByteView image) {
  const std::string_view text = as_text(image);
  using namespace std::string_view_literals;
  if (text.starts_with("\x89PNG\r\n\x1a\n"sv)) return "image/png";
  if (text.starts_with("\xff\xd8\xff"sv)) return "image/jpeg";
  if (text.starts_with("\xabKTX 20\xbb"sv)) return "image/ktx2";
  if (text.starts_with("RIFF"sv) &&
      text.substr(std::min<std::size_t>(8, text.size())).starts_with("WEBP"sv))
    return "image/webp";
  return "";
}

bool is_image_of(const Image& image, std::initializer_list<std::string_view> endings) {
  const std::string& name = image.mime_type.empty() ? image.uri : image.mime_type;
  const std::size_t dot = name.find_last_of("./");
  const std::string ending = dot == std::string::npos ? "" : lower_case(name.substr(dot + 1));
  return std::ranges::find(endings, ending) != endings.end();
}

}  // namespace pstrips::inline formats::gltf
