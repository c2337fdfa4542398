#include "formats/gltf/container.h"

#include <algorithm>
#include <cctype>
#include <limits>

#include "core/base64.h"
#include "core/text.h"

namespace pstrips::inline formats::gltf {
namespace {

constexpr std::uint32_t kMagic = 0x46546c67, kJson = 0x4e4f534a, kBin = 0x004e4942;

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

/// "C:", "http:" … at the start.
bool has_scheme(std::string_view uri) {
  const std::size_t colon = uri.find(':');
  return colon != std::string_view::npos && uri.find('/') > colon;
}

bool climbs_out(std::string_view path) {
  int depth = 0;
  while (!path.empty()) {
    const std::size_t end = std::min(path.find('/'), path.size());
    const std::string_view part = path.substr(0, end);
    if (part == "..")
      --depth;
    else if (!part.empty() && part != ".")
      ++depth;
    if (depth < 0) return true;
    path.remove_prefix(std::min(end + 1, path.size()));
  }
  return false;
}

}  // namespace

Result<Container> split(ByteView file) {
  constexpr std::string_view kName = "glTF";
  if (file.size() < kName.size() && kName.starts_with(as_text(file)))
    return fail(ErrorCode::truncated, "ends before the file header", file.size());
  ByteReader in(file);
  Container out;
  if (in.u32() != kMagic) {
    out.json = as_text(file);
    return out;
  }
  const std::uint32_t version = in.u32(), length = in.u32();
  if (in.error()) return fail(ErrorCode::truncated, "ends inside the file header", file.size());
  if (version == 1) return fail(ErrorCode::unsupported, "glTF 1.0", 4);
  if (version != 2) return fail(ErrorCode::unsupported, "binary glTF of another version than 2", 4);
  if (length < 12) return fail(ErrorCode::corrupt, "file length is below the header's", 8);
  if (length > file.size())
    return fail(ErrorCode::truncated, "ends before its announced length", file.size());
  out.bytes_after = file.size() - length;
  in = ByteReader(file.first(length));
  in.take(12);
  for (bool first = true; first || in.remaining() > 0; first = false) {
    const std::uint64_t start = in.offset();
    const std::uint32_t size = in.u32(), type = in.u32();
    const ByteView payload = in.take(size);
    // The length above is met, so what is missing here no further byte would bring.
    if (in.error()) return fail(ErrorCode::corrupt, "chunk reaches past the file", start);
    if (first != (type == kJson))
      return fail(ErrorCode::corrupt, "the first chunk, and only that, must be JSON", start);
    if (type == kJson) {
      out.json = as_text(payload);
      out.json_offset = start + 8;
    } else if (type == kBin) {
      if (out.bin) return fail(ErrorCode::corrupt, "second BIN chunk", start);
      out.bin = payload;
    } else {
      const ByteView chunk = file.subspan(start, 8 + payload.size());
      out.other_chunks.insert(out.other_chunks.end(), chunk.begin(), chunk.end());
    }
  }
  return out;
}

Result<Bytes> join(std::string_view json, ByteView bin, ByteView other_chunks) {
  const auto padded = [](std::uint64_t size) { return (size + 3) / 4 * 4; };
  const std::uint64_t total = 12 + 8 + padded(json.size()) +
                              (bin.empty() ? 0 : 8 + padded(bin.size())) + other_chunks.size();
  if (total > std::numeric_limits<std::uint32_t>::max())
    return fail(ErrorCode::over_limit, "a .glb file cannot reach 4 GiB");
  ByteWriter out;
  out.reserve(total);
  for (const std::uint64_t word : {std::uint64_t{kMagic}, std::uint64_t{2}, total})
    out.u32(static_cast<std::uint32_t>(word));
  out.u32(static_cast<std::uint32_t>(padded(json.size())));
  out.u32(kJson);
  out.bytes(as_bytes(json));
  while (out.size() % 4 != 0) out.u8(' ');
  if (!bin.empty()) {
    out.u32(static_cast<std::uint32_t>(padded(bin.size())));
    out.u32(kBin);
    out.bytes(bin);
    out.align(4);
  }
  out.bytes(other_chunks);
  return std::move(out).take();
}

bool is_data_uri(std::string_view uri) { return lower_case(uri.substr(0, 5)) == "data:"; }

Result<DataUri> decode_data_uri(std::string_view uri) {
  constexpr std::string_view kEncoding = ";base64";
  const std::size_t comma = uri.find(',');
  if (comma == std::string_view::npos) return fail(ErrorCode::corrupt, "data URI without a comma");
  std::string_view head = uri.substr(5, comma - 5);
  const bool is_base64 = lower_case(head).ends_with(kEncoding);
  if (is_base64) head.remove_suffix(kEncoding.size());
  std::string text;
  std::string_view content = uri.substr(comma + 1);
  if (!is_base64 || content.find_first_of("% \t\r\n") != std::string_view::npos) {
    text = percent_decode(content);
    if (is_base64) std::erase_if(text, [](char c) { return std::isspace(c) != 0; });
    content = text;
  }
  DataUri out{std::string(head.substr(0, head.find(';'))), {}};
  if (!is_base64) {
    const ByteView bytes = as_bytes(content);
    out.data.assign(bytes.begin(), bytes.end());
    return out;
  }
  std::optional<Bytes> data = parse_base64(content, Base64::lenient);
  if (!data) return fail(ErrorCode::corrupt, "data URI that is not base64");
  out.data = std::move(*data);
  return out;
}

Result<std::string> decode_relative_uri(std::string_view uri) {
  if (has_scheme(uri)) return fail(ErrorCode::unsupported, "absolute URI");
  std::string path = percent_decode(uri);
  if (path.find('\0') != std::string::npos) return fail(ErrorCode::corrupt, "zero byte in a URI");
  // A backslash climbs out of folders as well on some systems.
  std::ranges::replace(path, '\\', '/');
  if (path.empty()) return fail(ErrorCode::corrupt, "empty URI");
  if (path.front() == '/' || has_scheme(path) || climbs_out(path))
    return fail(ErrorCode::unsupported, "URI leaves the model's folder");
  return path;
}

std::string percent_decode(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const int high = text[i] == '%' && i + 2 < text.size() ? hex_digit(text[i + 1]) : -1;
    const int low = high >= 0 ? hex_digit(text[i + 2]) : -1;
    out += low < 0 ? text[i] : static_cast<char>(high * 16 + low);
    if (low >= 0) i += 2;
  }
  return out;
}

std::string percent_encode(std::string_view path) {
  constexpr std::string_view kPlain = "-._~/!$&'()*+,;=@", kHex = "0123456789ABCDEF";
  std::string out;
  for (const char c : path) {
    const auto byte = static_cast<unsigned char>(c);
    const bool letter = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
    if (letter || kPlain.find(c) != std::string_view::npos)
      out += c;
    else
      out += {'%', kHex[byte >> 4], kHex[byte & 15]};
  }
  return out;
}

}  // namespace pstrips::inline formats::gltf
