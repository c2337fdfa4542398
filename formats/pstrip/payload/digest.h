#pragma once

#include <array>
#include <cstddef>

#include "core/bytes.h"
#include "core/mesh.h"

namespace pstrips::inline formats {

using Digest = std::array<std::byte, 32>;

/// A SHA-256 under way. Whoever has one hands it to digest(), so that the decoder needs none.
class Sha256 {
 public:
  virtual void add(ByteView bytes) = 0;
  /// Called once, last.
  virtual Digest finish() = 0;

 protected:
  ~Sha256() = default;
};

/// SHA-256 over the canonical bytes of a fully decoded mesh, in decoded numbering. Two meshes have
/// the same digest when they agree bit for bit in all but names, groups' names and materials; the
/// short and the long form of an optional list count as the same. [spec/model.md §8]
///
/// cost  O(size); constant extra memory
Digest digest(const Mesh& decoded, Sha256& sha256);
/// The same with libcrypto's SHA-256; not in the decoder.
Digest digest(const Mesh& decoded);

}  // namespace pstrips::inline formats
