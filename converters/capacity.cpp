#include "converters/capacity.h"

#include <algorithm>

namespace pstrips::inline converters {
namespace {

// Fitted to peaks of the whole program, optimal placement with the memoryless metric, in bytes a
// triangle: a grid 202, with normals and texture coordinates 287, triangles that share no vertex
// 668. Subset placement takes 132, 201 and 435.
constexpr std::uint64_t kBytesATriangle = 120;
constexpr std::uint64_t kBytesAVertex = 190;
constexpr std::uint64_t kBytesAnAttribute = 32;
constexpr std::uint64_t kStrippingBytesATriangle = 130;

Result<void> check(const WorkSize& size, std::uint64_t bytes, std::string_view what,
                   std::uint64_t memory_bytes) {
  if (const std::uint64_t corners = 3 * size.triangles; corners > kMaxCount)
    return fail(ErrorCode::over_limit,
                over_limit_message(corners, "corners of triangles", kMaxCount));
  if (bytes > memory_bytes)
    return fail(ErrorCode::over_limit, over_limit_message(bytes, what, memory_bytes));
  return {};
}

}  // namespace

WorkSize work_size(const Mesh& mesh) {
  WorkSize out{.vertices = mesh.vertex_count(), .wedges = mesh.wedge_count()};
  for (Index f = 0; f < mesh.face_count(); ++f)
    out.triangles += std::max<std::size_t>(mesh.face(f).size(), 2) - 2;
  for (const Attribute& a : mesh.wedge_attributes) out.attribute_numbers += a.count;
  return out;
}

std::uint64_t encoding_bytes(const WorkSize& size) {
  return kBytesATriangle * size.triangles + kBytesAVertex * size.vertices +
         kBytesAnAttribute * size.attribute_numbers * size.wedges;
}

std::uint64_t stripping_bytes(const WorkSize& size) {
  return kStrippingBytesATriangle * size.triangles;
}

Result<void> check_capacity(const WorkSize& size, std::uint64_t memory_bytes) {
  return check(size, encoding_bytes(size), "bytes of memory to encode", memory_bytes);
}

Result<void> check_stripping_capacity(const WorkSize& size, std::uint64_t memory_bytes) {
  return check(size, stripping_bytes(size), "bytes of memory to stripify", memory_bytes);
}

}  // namespace pstrips::inline converters
