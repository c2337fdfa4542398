#include "converters/capacity.h"

#include <algorithm>

namespace pstrip {
namespace {

// Fitted to peaks of the whole program with subset placement: igea, with two triangles a vertex,
// 230 bytes a triangle, a million triangles that share no vertex 455. Free placement with the
// memoryless metric takes up to 60 more; each attribute adds its values and gradients.
constexpr std::uint64_t kBytesATriangle = 180;
constexpr std::uint64_t kBytesAVertex = 96;
constexpr std::uint64_t kBytesAnAttribute = 24;

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

Result<void> check_capacity(const WorkSize& size, std::uint64_t memory_bytes) {
  if (const std::uint64_t corners = 3 * size.triangles; corners > kMaxCount)
    return fail(ErrorCode::over_limit,
                over_limit_message(corners, "corners of triangles", kMaxCount));
  if (const std::uint64_t bytes = encoding_bytes(size); bytes > memory_bytes)
    return fail(ErrorCode::over_limit,
                over_limit_message(bytes, "bytes of memory to encode", memory_bytes));
  return {};
}

}  // namespace pstrip
