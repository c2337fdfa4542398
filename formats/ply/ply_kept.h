#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "core/scene.h"
#include "formats/ply/ply_body.h"

namespace pstrips::inline formats::ply {

/// Values of a property that the mesh has no place for: scalars have an empty `sizes`.
struct KeptColumn {
  std::uint64_t rows = 0;
  ListColumn data;
};

/// What a PLY file said besides the mesh, as it travels in Scene::foreign:
/// "ply/header" is the header as text, in ascii format and with counts of zero for vertices and
/// faces; "ply/elements" a u64 digest of the mesh, then for each kept property u32 element,
/// u32 property, u64 rows, for a list a u32 size a row, and the values; "ply/rest" the bytes
/// after the end of a binary body.
struct Kept {
  Header header;
  std::deque<KeptColumn> columns;  ///< named by Property::kept; addresses stay
  std::uint64_t digest = 0;
};

/// Stands for positions, faces and their order: what rows bound to vertices or faces rely on.
std::uint64_t digest_of(const Mesh& mesh);

void put_kept(const Kept& kept, std::vector<Foreign>& foreign);

/// Nothing when the model did not come from PLY. Errors: corrupt, for foreign data are as
/// untrusted as the file they travelled in.
Result<std::optional<Kept>> get_kept(const std::vector<Foreign>& foreign);

const Foreign* find_foreign(const std::vector<Foreign>& foreign, std::string_view key);

}  // namespace pstrips::inline formats::ply
