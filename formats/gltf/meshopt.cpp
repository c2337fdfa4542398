#include "formats/gltf/meshopt.h"

#include <meshoptimizer.h>

namespace pstrips::inline formats::gltf {
namespace {

/// A byte of payload never makes more: vertices spend two bits on sixteen bytes.
constexpr std::uint64_t kMostPerByte = 64;

const unsigned char* data_of(ByteView bytes) {
  return reinterpret_cast<const unsigned char*>(bytes.data());
}

/// Whether the payload begins as the version of the library's codec does.
bool is_known(const View::Compressed& in, ByteView payload) {
  if (payload.empty()) return true;  // the codec says what is missing
  const unsigned head = static_cast<unsigned>(payload[0]);
  if (in.mode == "ATTRIBUTES") return head == 0xa0;
  if (in.mode == "TRIANGLES") return head == 0xe0 || head == 0xe1;
  return head == 0xd0 || head == 0xd1;
}

int decode(const View::Compressed& in, ByteView payload, Bytes& out) {
  if (in.mode == "ATTRIBUTES")
    return meshopt_decodeVertexBuffer(out.data(), in.count, in.stride, data_of(payload),
                                      payload.size());
  if (in.mode == "TRIANGLES")
    return meshopt_decodeIndexBuffer(out.data(), in.count, in.stride, data_of(payload),
                                     payload.size());
  return meshopt_decodeIndexSequence(out.data(), in.count, in.stride, data_of(payload),
                                     payload.size());
}

/// False for a filter or a stride that there is not.
bool undo_filter(const View::Compressed& in, Bytes& bytes) {
  if (in.filter.empty() || in.filter == "NONE") return true;
  if (in.mode != "ATTRIBUTES") return false;
  if (in.filter == "OCTAHEDRAL" && (in.stride == 4 || in.stride == 8))
    meshopt_decodeFilterOct(bytes.data(), in.count, in.stride);
  else if (in.filter == "QUATERNION" && in.stride == 8)
    meshopt_decodeFilterQuat(bytes.data(), in.count, in.stride);
  else if (in.filter == "EXPONENTIAL")
    meshopt_decodeFilterExp(bytes.data(), in.count, in.stride);
  else
    return false;
  return true;
}

}  // namespace

std::uint64_t decoded_bytes(const View::Compressed& in) {
  const bool is_stride = in.mode == "ATTRIBUTES"
                             ? in.stride >= 4 && in.stride <= 256 && in.stride % 4 == 0
                             : in.stride == 2 || in.stride == 4;
  const bool is_mode = in.mode == "ATTRIBUTES" || in.mode == "INDICES" ||
                       (in.mode == "TRIANGLES" && in.count % 3 == 0);
  return is_stride && is_mode && in.count <= kMaxCount ? in.count * in.stride : 0;
}

Result<Bytes> decode_meshopt(const View::Compressed& in, ByteView payload) {
  const std::uint64_t bytes = decoded_bytes(in);
  if (bytes == 0 && in.count > 0)
    return fail(ErrorCode::corrupt, "meshopt compression whose numbers do not fit");
  if (!is_known(in, payload))
    return fail(ErrorCode::unsupported, "meshopt compression of another version");
  if (bytes / kMostPerByte > payload.size())
    return fail(ErrorCode::corrupt, "meshopt compression of fewer bytes than its elements take");
  Bytes out(bytes);
  if (bytes == 0) return out;
  if (decode(in, payload, out) != 0)
    return fail(ErrorCode::corrupt, "meshopt compression that does not decode");
  if (!undo_filter(in, out))
    return fail(ErrorCode::unsupported, "meshopt filter " + in.filter.substr(0, 100));
  return out;
}

}  // namespace pstrips::inline formats::gltf
