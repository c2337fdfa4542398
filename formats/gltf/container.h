#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/bytes.h"
#include "core/result.h"

namespace pstrips::inline formats::gltf {

/// The parts of a .glb or .gltf file; all views point into it.
struct Container {
  std::string_view json;
  std::uint64_t json_offset = 0;
  std::optional<ByteView> bin;  ///< the BIN chunk
  Bytes other_chunks;           ///< unknown chunks with their headers, one after the other
};

/// Splits a .glb, or takes the whole file as JSON when it does not start with "glTF".
///
/// errors  truncated, corrupt; unsupported for binary glTF 1
Result<Container> split(ByteView file);

/// A .glb; `other_chunks` as Container holds them. errors over_limit from 4 GiB on
Result<Bytes> join(std::string_view json, ByteView bin, ByteView other_chunks);

struct DataUri {
  std::string mime_type;
  Bytes data;
};
inline bool is_data_uri(std::string_view uri) { return uri.starts_with("data:"); }
/// errors  corrupt, unsupported when it is not base64. Precondition: is_data_uri(uri)
Result<DataUri> decode_data_uri(std::string_view uri);

/// The file that a relative URI names, percent-decoded.
///
/// errors  unsupported when the URI is absolute or leaves the folder, corrupt when it is malformed
Result<std::string> decode_relative_uri(std::string_view uri);
std::string percent_encode(std::string_view path);

}  // namespace pstrips::inline formats::gltf
