#pragma once

#include <optional>

#include "formats/ply/ply_body.h"

namespace pstrips::inline formats::ply {

/// Appends the triangles of strips: -1 restarts, every other triangle is turned, degenerate ones
/// (that only steer the strip) are left out.
class StripExpander {
 public:
  StripExpander(FaceLists& faces, std::uint64_t vertices, std::uint64_t max_corners)
      : faces_(faces), vertices_(vertices), max_corners_(max_corners) {}

  /// `offset` is that of the strips in the file. Empty when all went well.
  std::optional<Error> add(const ListColumn& strips, ComponentType type, std::uint64_t offset);

 private:
  bool step(Index c);

  FaceLists& faces_;
  std::uint64_t vertices_, max_corners_;
  Index older_ = 0, newer_ = 0;
  std::uint64_t length_ = 0;
};

/// In the header the strips become the faces that they were expanded into.
void turn_strips_into_faces(Header& header);

}  // namespace pstrips::inline formats::ply
