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
  std::optional<ByteView> bin;    ///< the BIN chunk
  Bytes other_chunks;             ///< unknown chunks with their headers, one after the other
  std::uint64_t bytes_after = 0;  ///< behind the end that the header of a .glb names; not looked at
};

/// Splits a .glb, or takes the whole file as JSON when it does not start with "glTF".
///
/// errors  truncated, corrupt; unsupported for glTF 1.0
Result<Container> split(ByteView file);

/// A .glb; `other_chunks` as Container holds them. errors over_limit from 4 GiB on
Result<Bytes> join(std::string_view json, ByteView bin, ByteView other_chunks);

struct DataUri {
  std::string mime_type;
  Bytes data;
};
bool is_data_uri(std::string_view uri);
/// In base64 or percent-encoded. [RFC2397]
///
/// errors  corrupt. Precondition: is_data_uri(uri)
Result<DataUri> decode_data_uri(std::string_view uri);

/// The file that a relative URI names, percent-decoded; a percent sign without two digits stands
/// for itself, as in files whose writers encode nothing.
///
/// errors  unsupported when the URI is absolute or leaves the folder, corrupt when it is malformed
Result<std::string> decode_relative_uri(std::string_view uri);
/// A URI as plain text; a percent sign without two digits behind it stands for itself.
std::string percent_decode(std::string_view text);
std::string percent_encode(std::string_view path);

}  // namespace pstrips::inline formats::gltf
