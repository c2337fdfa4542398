#pragma once

#include <algorithm>
#include <bit>
#include <string>
#include <tuple>

#include "formats/pstrip/container/chunk_table.h"
#include "formats/pstrip/payload/layout.h"

namespace pstrips::inline formats::layout {

// What a mesh may have beyond its strips: one description a chunk type, for reading, writing and
// locating. A new chunk of a mesh is a description here, a line in `Extras`, a row in chunk_table.h
// and a member of ProgressiveMesh. [spec/container.md §8]

/// A demand that is broken, and what stands there instead.
struct Broken {
  Fault fault = Fault::none;
  std::string found = {};
};

/// What a description need not say.
template <class Head>
struct ExtraDefaults {
  /// A demand that the head alone breaks.
  static Broken broken_head(const Head&) { return {}; }
  /// A demand that the length breaks, more telling than that of the payload.
  static Fault broken_length(const Head&, const ProgressiveMesh&, const MeshCounts&,
                             std::uint64_t) {
    return Fault::none;
  }
  /// A count of MESH that a model with this head would contradict.
  static Fault contradiction(const Head&, const ProgressiveMesh&, const MeshCounts&) {
    return Fault::none;
  }
  /// A demand that what was read breaks.
  static Broken broken_body(const Head&, const ProgressiveMesh&) { return {}; }
  static void prepare(ProgressiveMesh&) {}  ///< before the body is sized and read
  /// Whether the model may be followed now. [payload/check.h]
  static bool check(const ProgressiveStrips&, Index, FaultSink&) { return true; }
};

struct FacesHead {
  Index mesh = 0, faces = 0, corners = 0, replaced = 0;
};

struct FacesPayload : ExtraDefaults<FacesHead> {
  using Head = FacesHead;
  static constexpr ChunkType kType = kFacesChunk;
  static constexpr Fault kNoSuchMesh = Fault::faces_mesh;

  static bool is_needed(const ProgressiveMesh& mesh) { return !mesh.faces.empty(); }
  static Head head_of(const ProgressiveMesh& mesh, Index index) {
    return {index, mesh.faces.count(), static_cast<Index>(mesh.faces.corners.size()),
            static_cast<Index>(mesh.faces.replaced.size())};
  }

  template <class Io, class H>
  static void head_fields(Io& io, H& h) {
    io.number(h.mesh);
    io.number(h.faces);
    io.number(h.corners);
    io.number(h.replaced);
  }
  template <class Io, class M>
  static void body_fields(Io& io, const Head& h, const MeshCounts& counts, M& mesh) {
    list_fields(io, h, mesh.faces);
    for (auto& a : mesh.faces.attributes) {
      io.run(a, 0, counts.faces);
      io.align();
    }
  }

  static void prepare(ProgressiveMesh& mesh) {
    mesh.faces = {};
    mesh.faces.attributes = mesh.face_attribute_formats;
  }
  static void clear(ProgressiveMesh& mesh) { mesh.faces = {}; }

  /// The lists are all there: it is the attributes that do not fit the faces.
  static Fault broken_length(const Head& head, const ProgressiveMesh& mesh,
                             const MeshCounts& counts, std::uint64_t payload_bytes) {
    const FaceTable no_faces;
    SizeIo size;
    head_fields(size, head);
    list_fields(size, head, no_faces);
    if (mesh.faces.attributes.empty() || payload_bytes < size.size()) return Fault::none;
    const std::uint64_t whole = size_of_fields([&](SizeIo& io) {
      head_fields(io, head);
      body_fields(io, head, counts, mesh);
    });
    return payload_bytes == whole ? Fault::none : Fault::face_elements;
  }
  static Fault contradiction(const Head& head, const ProgressiveMesh& mesh,
                             const MeshCounts& counts) {
    const bool agrees = head.replaced <= mesh.triangles &&
                        std::uint64_t{mesh.triangles} - head.replaced + head.faces == counts.faces;
    return agrees ? Fault::none : Fault::face_count;
  }
  static Broken broken_body(const Head&, const ProgressiveMesh& mesh) {
    return {mesh.faces.empty() ? Fault::faces_empty : Fault::none};
  }
  static bool check(const ProgressiveStrips& strips, Index mesh, FaultSink& faults) {
    return check_faces(strips, mesh, faults);
  }

 private:
  template <class Io, class F>
  static void list_fields(Io& io, const Head& h, F& table) {
    const std::uint64_t bounds = h.faces == 0 ? 0 : std::uint64_t{h.faces} + 1;
    io.run(table.first, 0, bounds);
    io.align();
    io.run(table.corners, 0, h.corners);
    io.align();
    io.run(table.group, 0, h.faces);
    io.align();
    io.run(table.replaced_first, 0, bounds);
    io.align();
    io.run(table.replaced, 0, h.replaced);
    io.align();
  }
};

struct WeldingHead {
  Index mesh = 0, vertices = 0, wedges = 0;
  Index welded = 0, corners = 0, numbered = 0, moved = 0;  ///< lengths of lists
  std::uint8_t skip_bits = 0, more_bits = 0, corner_bits = 0, vertex_bits = 0;
};

struct WeldingPayload : ExtraDefaults<WeldingHead> {
  using Head = WeldingHead;
  static constexpr ChunkType kType = kWeldingChunk;
  static constexpr Fault kNoSuchMesh = Fault::welding_mesh;

  static bool is_needed(const ProgressiveMesh& mesh) { return !mesh.welding.empty(); }
  static Head head_of(const ProgressiveMesh& mesh, Index index) {
    const Welding& w = mesh.welding;
    return {index,
            w.vertices,
            w.wedges,
            static_cast<Index>(w.skip.size()),
            static_cast<Index>(w.corner.size()),
            static_cast<Index>(w.vertex.size()),
            static_cast<Index>(w.moved.size()),
            bits_of(w.skip),
            bits_of(w.more),
            bits_of(w.corner),
            bits_of(w.vertex)};
  }

  template <class Io, class H>
  static void head_fields(Io& io, H& h) {
    io.number(h.mesh);
    io.number(h.vertices);
    io.number(h.wedges);
    io.number(h.welded);
    io.number(h.corners);
    io.number(h.numbered);
    io.number(h.moved);
    io.number(h.skip_bits);
    io.number(h.more_bits);
    io.number(h.corner_bits);
    io.number(h.vertex_bits);
  }
  template <class Io, class M>
  static void body_fields(Io& io, const Head& h, const MeshCounts&, M& mesh) {
    auto& welding = mesh.welding;
    if constexpr (Io::kReads) {
      welding.vertices = h.vertices;
      welding.wedges = h.wedges;
    }
    io.packed(welding.skip, h.skip_bits, h.welded);
    io.align();
    io.packed(welding.more, h.more_bits, h.welded);
    io.align();
    io.packed(welding.corner, h.corner_bits, h.corners);
    io.align();
    io.packed(welding.vertex, h.vertex_bits, h.numbered);
    io.align();
    io.run(welding.moved, 0, h.moved);
    io.align();
    io.run(welding.moved_position, 0, h.moved);
    io.align();
  }

  static void prepare(ProgressiveMesh& mesh) {
    mesh.welding = {};
    mesh.welding.moved_position = mesh.position.format();
  }
  static void clear(ProgressiveMesh& mesh) { mesh.welding = {}; }

  static Broken broken_head(const Head& head) {
    if (std::max({head.skip_bits, head.more_bits, head.corner_bits, head.vertex_bits}) <= 32)
      return {};
    return {Fault::welding_bits};
  }
  /// Numbers of no bits take nothing in the file: how many there are is checked.
  static Fault broken_length(const Head& head, const ProgressiveMesh& mesh,
                             const MeshCounts& counts, std::uint64_t) {
    const WeldingSizes sizes{head.vertices, head.wedges,   head.welded,
                             head.corners,  head.numbered, head.moved};
    const bool fits = is_possible(sizes, counts.wedges, counts.triangles, mesh.faces);
    return fits ? Fault::none : Fault::welding_counts;
  }
  static Broken broken_body(const Head& head, const ProgressiveMesh& mesh) {
    const Head least = head_of(mesh, head.mesh);
    const bool fits = least.skip_bits == head.skip_bits && least.more_bits == head.more_bits &&
                      least.corner_bits == head.corner_bits &&
                      least.vertex_bits == head.vertex_bits;
    return {fits ? Fault::none : Fault::welding_bits};
  }

 private:
  static std::uint8_t bits_of(const std::vector<Index>& list) {
    Index all = 0;
    for (const Index number : list) all |= number;
    return static_cast<std::uint8_t>(std::bit_width(all));
  }
};

struct OrderHead {
  Index mesh = 0;
  std::uint8_t rotation_bits = 0;  ///< of each rotation, at most kMaxRotationBits
};

struct OrderPayload : ExtraDefaults<OrderHead> {
  using Head = OrderHead;
  static constexpr ChunkType kType = kOrderChunk;
  static constexpr Fault kNoSuchMesh = Fault::order_mesh;
  static constexpr unsigned kMaxRotationBits = 8;

  static bool is_needed(const ProgressiveMesh& mesh) { return mesh.order != OriginalOrder{}; }
  static Head head_of(const ProgressiveMesh& mesh, Index index) {
    return {index, rotation_bits(mesh.order.rotation)};
  }

  template <class Io, class H>
  static void head_fields(Io& io, H& h) {
    io.number(h.mesh);
    io.number(h.rotation_bits);
    io.zeros(3);
  }
  template <class Io, class M>
  static void body_fields(Io& io, const Head& h, const MeshCounts& counts, M& mesh) {
    auto& order = mesh.order;
    const auto& welding = mesh.welding;
    const Index vertices = welding.empty() ? counts.vertices : welding.vertices;
    const Index wedges = welding.empty() ? counts.wedges : welding.wedges;
    io.packed(order.vertex, permutation_bits(vertices), vertices);
    io.align();
    if (mesh.orders_wedges()) io.packed(order.wedge, permutation_bits(wedges), wedges);
    io.align();
    io.packed(order.face, permutation_bits(counts.faces), counts.faces);
    io.align();
    io.packed(order.rotation, h.rotation_bits, counts.faces);
    io.align();
  }
  static void clear(ProgressiveMesh& mesh) { mesh.order = {}; }

  static Broken broken_head(const Head& head) {
    if (head.rotation_bits <= kMaxRotationBits) return {};
    return {Fault::order_rotation_bits, std::to_string(head.rotation_bits)};
  }
  static Fault contradiction(const Head&, const ProgressiveMesh& mesh, const MeshCounts& counts) {
    return face_count(mesh) == counts.faces ? Fault::none : Fault::face_count;
  }
  static Broken broken_body(const Head& head, const ProgressiveMesh& mesh) {
    if (head.rotation_bits == rotation_bits(mesh.order.rotation)) return {};
    return {Fault::order_rotation_bits, std::to_string(head.rotation_bits)};
  }
  static bool check(const ProgressiveStrips& strips, Index mesh, FaultSink& faults) {
    return check_order(strips, mesh, faults);
  }

 private:
  static std::uint8_t rotation_bits(const std::vector<std::uint8_t>& rotation) {
    std::uint8_t all = 0;
    for (const std::uint8_t r : rotation) all |= r;
    return static_cast<std::uint8_t>(std::bit_width(all));
  }
};

inline constexpr Index kSha256 = 1;
inline constexpr std::size_t kDigestBytes = 32;

struct DigestHead {
  Index mesh = 0, algorithm = kSha256;
};

struct DigestPayload : ExtraDefaults<DigestHead> {
  using Head = DigestHead;
  static constexpr ChunkType kType = kDigestChunk;
  static constexpr Fault kNoSuchMesh = Fault::digest_mesh;

  static bool is_needed(const ProgressiveMesh& mesh) { return !mesh.digest.empty(); }
  static Head head_of(const ProgressiveMesh&, Index index) { return {index}; }

  template <class Io, class H>
  static void head_fields(Io& io, H& h) {
    io.number(h.mesh);
    io.number(h.algorithm);
  }
  template <class Io, class M>
  static void body_fields(Io& io, const Head&, const MeshCounts&, M& mesh) {
    io.run(mesh.digest, 1, 0, kDigestBytes);
  }
  static void clear(ProgressiveMesh& mesh) { mesh.digest.clear(); }

  static Broken broken_head(const Head& head) {
    if (head.algorithm == kSha256) return {};
    return {Fault::digest_unknown, std::to_string(head.algorithm)};
  }
};

/// All descriptions.
using Extras = std::tuple<FacesPayload, WeldingPayload, OrderPayload, DigestPayload>;

/// Calls `visit` with the description of the type; false when there is none.
template <class Visit>
bool visit_extra(const ChunkType& type, Visit&& visit) {
  const auto visit_if = [&](auto extra) {
    if (extra.kType != type) return false;
    visit(extra);
    return true;
  };
  return std::apply([&](auto... extra) { return (visit_if(extra) || ...); }, Extras{});
}

template <class Io, class Extra>
void extra_fields(Io& io, Extra, const typename Extra::Head& head, const MeshCounts& counts,
                  const ProgressiveMesh& mesh) {
  Extra::head_fields(io, head);
  Extra::body_fields(io, head, counts, mesh);
}

}  // namespace pstrips::inline formats::layout
