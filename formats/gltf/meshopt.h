#pragma once

#include "formats/gltf/document.h"

namespace pstrips::inline formats::gltf {

/// The bytes of a view that meshopt compression stores. [EXT_meshopt_compression]
///
/// payload  the compressed bytes
/// errors   corrupt when the extension's numbers do not fit one another or the payload, which is
/// seen
///          before anything is allocated by them; unsupported for a later version or another filter
Result<Bytes> decode_meshopt(const View::Compressed& in, ByteView payload);

/// How many bytes that will be; 0 for numbers that do not fit one another.
std::uint64_t decoded_bytes(const View::Compressed& in);

}  // namespace pstrips::inline formats::gltf
