#pragma once

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>
#include <type_traits>

#include "core/bytes.h"
#include "core/progressive_strips.h"
#include "formats/pstrip/container/binary.h"
#include "formats/pstrip/container/parts.h"
#include "formats/pstrip/payload/check.h"

// For formats/pstrip and validators: the wire layout of each payload, once, for reading, writing,
// sizing and listing. [spec/container.md §5 to §9]
//
// A `…_fields(io, v)` function names the fields of a payload in file order; what happens to them
// is the Io's business: ReadIo fills v, WriteIo writes v, SizeIo adds up the bytes, PartIo notes
// which bytes belong to what. v is const for all but ReadIo.

namespace pstrips::inline formats::layout {

inline constexpr std::size_t kArrayAlignment = 8;
inline constexpr std::size_t kMinStringBytes = 4;
inline constexpr std::size_t kMinFormatBytes = kMinStringBytes + 4;
inline constexpr std::size_t kMinGroupBytes = kMinStringBytes + 12;
inline constexpr std::size_t kMinNodeBytes = kMinStringBytes + 4 + 16 * 8 + 4;
inline constexpr std::size_t kMinMaterialBytes = kMinStringBytes + 9 * 8 + 8;
inline constexpr std::size_t kMinImageBytes = 3 * kMinStringBytes + 4;

// Packed arrays: numbers of `bits` bits each, at most 32, lowest bit first, without gaps.
// [spec/container.md §8.2]

constexpr std::uint64_t packed_bytes(unsigned bits, std::uint64_t n) { return (n * bits + 7) / 8; }

/// What a permutation of n elements needs for each.
constexpr unsigned permutation_bits(Index n) {
  return n == 0 ? 0 : static_cast<unsigned>(std::bit_width(n - 1));
}

/// Precondition: out has packed_bytes() for the numbers, all zero, and each fits.
template <class T>
void pack(const std::vector<T>& numbers, unsigned bits, std::span<std::byte> out) {
  std::uint64_t window = 0;
  unsigned filled = 0;
  std::size_t at = 0;
  for (const T number : numbers) {
    assert(std::bit_width(number) <= static_cast<int>(bits));
    window |= std::uint64_t{number} << filled;
    for (filled += bits; filled >= 8; filled -= 8, window >>= 8)
      out[at++] = static_cast<std::byte>(window & 0xff);
  }
  if (filled > 0) out[at] = static_cast<std::byte>(window);
}

/// Precondition: bytes.size() == packed_bytes(bits, n).
template <class T>
std::vector<T> unpack(ByteView bytes, unsigned bits, std::uint64_t n) {
  std::vector<T> out(n);
  std::uint64_t window = 0;
  unsigned filled = 0;
  std::size_t at = 0;
  for (T& number : out) {
    for (; filled < bits; filled += 8)
      window |= std::to_integer<std::uint64_t>(bytes[at++]) << filled;
    number = static_cast<T>(window & ((std::uint64_t{1} << bits) - 1));
    window >>= bits;
    filled -= bits;
  }
  return out;
}

/// Whether the bits after the last number are zero.
inline bool ends_in_zeros(ByteView bytes, unsigned bits, std::uint64_t n) {
  const auto used = static_cast<unsigned>(n * bits % 8);
  return used == 0 || std::to_integer<unsigned>(bytes.back()) >> used == 0;
}

/// Adds up bytes. Counts from a file are safe here: no product of 32-bit counts and 8-bit sizes
/// leaves 64 bits.
class SizeIo {
 public:
  static constexpr bool kReads = false;

  template <class T>
  void number(const T&) {
    skip(sizeof(T));
  }
  template <class E>
  void choice(const E&, std::uint8_t) {
    skip(1);
  }
  void zeros(std::size_t n) { skip(n); }
  void string(const std::string& s) { skip(4 + s.size()); }
  template <class T>
  const std::vector<T>& list(const std::vector<T>& v, std::size_t) {
    skip(4);
    return v;
  }
  template <class T>
  void run(const std::vector<T>&, std::size_t, std::uint64_t n) {
    skip(n * sizeof(T));
  }
  void run(const Attribute& a, std::size_t, std::uint64_t n) { skip(n * a.element_bytes()); }
  void run(const Bytes&, std::size_t element, std::size_t, std::uint64_t n) { skip(n * element); }
  template <class S, class T>
  void column(const std::vector<S>&, T S::*, std::size_t, std::uint64_t n) {
    skip(n * sizeof(T));
  }
  template <class T>
  void packed(const std::vector<T>&, unsigned bits, std::uint64_t n) {
    skip(packed_bytes(bits, n));
  }
  void rest(const Bytes& bytes) { skip(bytes.size()); }
  void align() { size_ = (size_ + kArrayAlignment - 1) / kArrayAlignment * kArrayAlignment; }
  void part(Part) {}

  std::uint64_t size() const { return size_; }

 private:
  void skip(std::uint64_t n) { size_ += n; }
  std::uint64_t size_ = 0;
};

/// Writes into a buffer of exactly the right size that holds zeros.
class WriteIo {
 public:
  static constexpr bool kReads = false;

  explicit WriteIo(std::span<std::byte> out) : out_(out) {}

  template <class T>
  void number(const T& v) {
    static_assert(std::is_arithmetic_v<T>);
    put(&v, sizeof v);
  }
  template <class E>
  void choice(const E& v, std::uint8_t) {
    number(static_cast<std::uint8_t>(v));
  }
  void zeros(std::size_t n) { at_ += n; }
  void string(const std::string& s) {
    number(static_cast<std::uint32_t>(s.size()));
    put(s.data(), s.size());
  }
  template <class T>
  const std::vector<T>& list(const std::vector<T>& v, std::size_t) {
    number(static_cast<std::uint32_t>(v.size()));
    return v;
  }
  template <class T>
  void run(const std::vector<T>& v, std::size_t first, std::uint64_t n) {
    assert(first + n <= v.size());
    put(v.data() + first, n * sizeof(T));
  }
  void run(const Attribute& a, std::size_t first, std::uint64_t n) {
    run(a.data, a.element_bytes(), first, n);
  }
  void run(const Bytes& data, std::size_t element, std::size_t first, std::uint64_t n) {
    run(data, first * element, n * element);
  }
  template <class S, class T>
  void column(const std::vector<S>& v, T S::*field, std::size_t first, std::uint64_t n) {
    assert(first + n <= v.size());
    for (std::size_t i = first; i < first + n; ++i) number(v[i].*field);
  }
  template <class T>
  void packed(const std::vector<T>& v, unsigned bits, std::uint64_t n) {
    assert(v.size() == n);
    const std::uint64_t size = packed_bytes(bits, n);
    assert(at_ + size <= out_.size());
    pack(v, bits, out_.subspan(at_, size));
    at_ += size;
  }
  void rest(const Bytes& bytes) { put(bytes.data(), bytes.size()); }
  void align() { at_ = (at_ + kArrayAlignment - 1) / kArrayAlignment * kArrayAlignment; }
  void part(Part) {}

 private:
  void put(const void* from, std::size_t n) {
    assert(at_ + n <= out_.size());
    if (n != 0) std::memcpy(out_.data() + at_, from, n);
    at_ += n;
  }
  std::span<std::byte> out_;
  std::size_t at_ = 0;
};

/// Fills structures from a payload. Arrays are appended to what is there: `first` must be the
/// array's size. The first failure sticks, as in ByteReader.
class ReadIo {
 public:
  static constexpr bool kReads = true;

  ReadIo(ByteView payload, std::uint64_t offset, std::uint64_t max_string_bytes)
      : in_(payload, offset), max_string_bytes_(max_string_bytes) {}

  template <class T>
  void number(T& v) {
    static_assert(std::is_arithmetic_v<T>);
    const ByteView bytes = in_.take(sizeof v);
    if (bytes.size() == sizeof v) std::memcpy(&v, bytes.data(), sizeof v);
  }
  /// An enumeration or flag: one byte below `values`.
  template <class E>
  void choice(E& v, std::uint8_t values) {
    const std::uint8_t n = in_.u8();
    if (n < values)
      v = static_cast<E>(n);
    else
      in_.fail(ErrorCode::corrupt, "value is none of those defined");
  }
  void zeros(std::size_t n) {
    if (std::ranges::any_of(in_.take(n), [](std::byte b) { return b != std::byte{0}; }))
      in_.fail(ErrorCode::corrupt, "reserved byte is not zero");
  }
  void string(std::string& s) { s = in_.string(max_string_bytes_); }
  template <class T>
  std::vector<T>& list(std::vector<T>& v, std::size_t min_bytes_each) {
    v.resize(in_.count(min_bytes_each));
    return v;
  }
  template <class T>
  void run(std::vector<T>& v, std::size_t first, std::uint64_t n) {
    if (first == 0 && n == 0) return;
    assert(first == v.size());
    const ByteView bytes = take(n, sizeof(T));
    if (bytes.empty()) return;
    v.resize(first + n);
    std::memcpy(v.data() + first, bytes.data(), bytes.size());
  }
  void run(Attribute& a, std::size_t first, std::uint64_t n) {
    run(a.data, a.element_bytes(), first, n);
  }
  void run(Bytes& data, std::size_t element, [[maybe_unused]] std::size_t first, std::uint64_t n) {
    assert(data.size() == first * element);
    const ByteView bytes = take(n, element);
    data.insert(data.end(), bytes.begin(), bytes.end());
  }
  template <class S, class T>
  void column(std::vector<S>& v, T S::*field, std::size_t first, std::uint64_t n) {
    const ByteView bytes = take(n, sizeof(T));
    if (bytes.empty()) return;
    if (v.size() < first + n) v.resize(first + n);
    for (std::size_t i = 0; i < n; ++i)
      std::memcpy(&(v[first + i].*field), bytes.data() + i * sizeof(T), sizeof(T));
  }
  /// Precondition: the payload has been found to be as long as its counts say.
  template <class T>
  void packed(std::vector<T>& v, unsigned bits, std::uint64_t n) {
    const ByteView bytes = in_.take(packed_bytes(bits, n));
    if (in_.error()) return;
    if (!ends_in_zeros(bytes, bits, n))
      in_.fail(ErrorCode::corrupt, "bits after a packed array are not zero");
    v = unpack<T>(bytes, bits, n);
  }
  void rest(Bytes& bytes) {
    const ByteView all = in_.take(in_.remaining());
    bytes.assign(all.begin(), all.end());
  }
  void align() { in_.align(kArrayAlignment); }
  void part(Part) {}

  ByteReader& in() { return in_; }

 private:
  /// Nothing when the bytes are not there; the product is checked by dividing.
  ByteView take(std::uint64_t n, std::size_t element) {
    if (n > in_.remaining() / element) in_.fail(ErrorCode::corrupt, "count exceeds the payload");
    return in_.take(in_.error() ? 0 : n * element);
  }
  ByteReader in_;
  std::uint64_t max_string_bytes_;
};

/// Notes the parts of a payload from its counts alone.
class PartIo : public SizeIo {
 public:
  struct Mark {
    Part part;
    std::uint64_t position;  ///< in the payload
  };
  void part(Part p) { marks_.push_back({p, size()}); }
  const std::vector<Mark>& marks() const { return marks_; }

 private:
  std::vector<Mark> marks_;
};

template <class F>
std::uint64_t size_of_fields(F&& fields) {
  SizeIo io;
  fields(io);
  return io.size();
}

// ---- PSHD, PIDX ----------------------------------------------------------------------------

template <class Io, class H>
void header_fields(Io& io, H& h) {
  io.number(h.version_major);
  io.number(h.version_minor);
  io.number(h.profile);
  io.number(h.level);
  io.number(h.flags);
  io.number(h.meshes);
  io.number(h.packets);
  io.number(h.vertices);
  io.number(h.wedges);
  io.number(h.triangles);
  io.number(h.strips);
  io.number(h.map_entries);
  io.number(h.faces);
  io.number(h.decoder_memory);
  io.number(h.vsplits);
  io.number(h.base_end);
  io.number(h.file_bytes);
}
inline constexpr std::uint64_t kHeaderBytes = 96;

inline constexpr std::size_t kIndexRowBytes = 40;

template <class Io, class Rows>
void index_fields(Io& io, Rows& rows) {
  std::uint32_t count = static_cast<std::uint32_t>(rows.size());
  io.number(count);
  io.zeros(4);
  if constexpr (Io::kReads) {
    if (count != io.in().remaining() / kIndexRowBytes)
      io.in().fail(ErrorCode::corrupt, "row count contradicts the payload");
    rows.resize(io.in().error() ? 0 : count);
  }
  for (auto& row : rows) {
    io.number(row.offset);
    io.number(row.bytes);
    io.number(row.mesh);
    io.number(row.vsplits);
    io.number(row.vertices);
    io.number(row.triangles);
    io.number(row.strips);
    io.number(row.error);
    io.number(row.one_sided_error);
  }
}

// ---- MESH ----------------------------------------------------------------------------------

struct MeshCounts {
  Index vertices = 0, wedges = 0, triangles = 0, strips = 0, map_entries = 0, vsplits = 0;
  Index faces = 0, base_vertices = 0, base_wedges = 0;
};

template <class Io, class A>
void format_fields(Io& io, A& a) {
  io.string(a.semantic);
  io.choice(a.type, 8);
  io.number(a.count);
  io.choice(a.normalized, 2);
  io.zeros(1);
}

template <class Io, class M, class C>
void mesh_fields(Io& io, M& mesh, C& counts) {
  io.string(mesh.name);
  io.choice(mesh.encoding, 2);
  io.choice(mesh.placement, 2);
  io.choice(mesh.single_wedges, 2);
  io.zeros(1);
  format_fields(io, mesh.position);
  for (auto& a : io.list(mesh.wedge_attributes, kMinFormatBytes)) format_fields(io, a);
  for (auto& a : io.list(mesh.face_attribute_formats, kMinFormatBytes)) format_fields(io, a);
  auto& groups = io.list(mesh.groups, kMinGroupBytes);
  if constexpr (Io::kReads) mesh.group_entries.resize(groups.size());
  for (std::size_t i = 0; i < groups.size(); ++i) {
    io.string(groups[i].name);
    io.number(groups[i].material);
    io.choice(groups[i].kind, 3);
    io.zeros(3);
    io.number(mesh.group_entries[i]);
  }
  io.number(counts.vertices);
  io.number(counts.wedges);
  io.number(counts.triangles);
  io.number(counts.strips);
  io.number(counts.map_entries);
  io.number(counts.vsplits);
  io.number(counts.faces);
  io.number(counts.base_vertices);
  io.number(counts.base_wedges);
}

// ---- BASE, PCKT ----------------------------------------------------------------------------

struct BaseHead {
  Index mesh = 0, vertices = 0, wedges = 0, map_entries = 0;
};

inline constexpr std::uint64_t kBaseHeadBytes = 16;

template <class Io, class H>
void base_head_fields(Io& io, H& h) {
  io.number(h.mesh);
  io.number(h.vertices);
  io.number(h.wedges);
  io.number(h.map_entries);
}

template <class Io, class M>
void base_array_fields(Io& io, const BaseHead& h, M& mesh) {
  io.part(Part::base_positions);
  io.run(mesh.position, 0, h.vertices);
  io.align();
  io.part(Part::base_wedges);
  if (!mesh.single_wedges) io.run(mesh.base_wedge_vertex, 0, h.wedges);
  io.align();
  for (auto& a : mesh.wedge_attributes) {
    io.run(a, 0, h.wedges);
    io.align();
  }
  io.part(Part::base_map);
  io.run(mesh.base_map, 0, h.map_entries);
  io.align();
}

struct PacketHead {
  Index mesh = 0, first_vsplit = 0, vsplits = 0, wedges = 0, reassigned = 0, map_offsets = 0;
};

inline constexpr std::uint64_t kPacketHeadBytes = 24;

template <class Io, class H>
void packet_head_fields(Io& io, H& h) {
  io.number(h.mesh);
  io.number(h.first_vsplit);
  io.number(h.vsplits);
  io.number(h.wedges);
  io.number(h.reassigned);
  io.number(h.map_offsets);
}

/// start  where the packet's part of each of the mesh's lists begins
template <class Io, class M>
void packet_array_fields(Io& io, const PacketHead& h, M& mesh, const PacketStart& start) {
  io.part(Part::parents);
  io.column(mesh.vsplits, &Vsplit::parent, start.vsplit, h.vsplits);
  io.align();
  io.part(Part::counts);
  if (!mesh.single_wedges) {
    io.column(mesh.vsplits, &Vsplit::wedges, start.vsplit, h.vsplits);
    io.align();
    io.column(mesh.vsplits, &Vsplit::reassigned, start.vsplit, h.vsplits);
    io.align();
  }
  // With single wedges there is one new wedge a vsplit: the same list serves both forms.
  io.run(mesh.wedge_offset_counts, start.offset_count, h.wedges);
  io.align();
  io.part(Part::positions);
  io.run(mesh.position, start.vertices, h.vsplits);
  io.align();
  io.part(Part::parent_positions);
  if (mesh.placement == Placement::optimal)
    io.run(mesh.parent_position, mesh.position.element_bytes(), start.vsplit, h.vsplits);
  io.align();
  io.part(Part::wedges);
  for (auto& a : mesh.wedge_attributes) {
    io.run(a, start.wedges, h.wedges);
    io.align();
  }
  io.part(Part::reassigned);
  io.run(mesh.reassigned, start.reassigned, h.reassigned);
  io.align();
  io.part(Part::map_offsets);
  io.run(mesh.map_offsets, start.map_offset, h.map_offsets);
  io.align();
}

// ---- fACE, oRDP, dGST ----------------------------------------------------------------------

struct FacesHead {
  Index mesh = 0, faces = 0, corners = 0, replaced = 0;
};

template <class Io, class H>
void faces_head_fields(Io& io, H& h) {
  io.number(h.mesh);
  io.number(h.faces);
  io.number(h.corners);
  io.number(h.replaced);
}

/// all_faces  of the decoded mesh: elements of each face attribute
template <class Io, class F>
void faces_array_fields(Io& io, const FacesHead& h, F& table, std::uint64_t all_faces) {
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
  for (auto& a : table.attributes) {
    io.run(a, 0, all_faces);
    io.align();
  }
}

struct OrderHead {
  Index mesh = 0;
  std::uint8_t rotation_bits = 0;  ///< of each rotation, at most kMaxRotationBits
};

inline constexpr unsigned kMaxRotationBits = 8;

template <class Io, class H>
void order_head_fields(Io& io, H& h) {
  io.number(h.mesh);
  io.number(h.rotation_bits);
  io.zeros(3);
}

/// What rotation_bits has to be.
inline std::uint8_t rotation_bits(const std::vector<std::uint8_t>& rotation) {
  std::uint8_t all = 0;
  for (const std::uint8_t r : rotation) all |= r;
  return static_cast<std::uint8_t>(std::bit_width(all));
}

template <class Io, class O>
void order_array_fields(Io& io, const OrderHead& h, const MeshCounts& counts, bool single_wedges,
                        O& order) {
  io.packed(order.vertex, permutation_bits(counts.vertices), counts.vertices);
  io.align();
  if (!single_wedges) io.packed(order.wedge, permutation_bits(counts.wedges), counts.wedges);
  io.align();
  io.packed(order.face, permutation_bits(counts.faces), counts.faces);
  io.align();
  io.packed(order.rotation, h.rotation_bits, counts.faces);
  io.align();
}

inline constexpr Index kSha256 = 1;
inline constexpr std::size_t kDigestBytes = 32;

// ---- sCNE, mTRL, iMGE, fRGN ----------------------------------------------------------------

template <class Io, class S>
void scene_fields(Io& io, S& strips) {
  io.string(strips.generator);
  for (auto& node : io.list(strips.scene.nodes, kMinNodeBytes)) {
    io.string(node.name);
    io.number(node.parent);
    for (auto& x : node.matrix) io.number(x);
    for (auto& mesh : io.list(node.meshes, sizeof(Index))) io.number(mesh);
  }
}

/// embedded  one flag an image: an iMGE chunk brings its data
template <class Io, class S, class E>
void material_fields(Io& io, S& scene, E& embedded) {
  for (auto& m : io.list(scene.materials, kMinMaterialBytes)) {
    io.string(m.name);
    for (auto& x : m.base_color) io.number(x);
    for (auto& x : m.emissive) io.number(x);
    io.number(m.metallic);
    io.number(m.roughness);
    io.number(m.base_color_image);
    io.choice(m.double_sided, 2);
    io.zeros(3);
  }
  auto& images = io.list(scene.images, kMinImageBytes);
  if constexpr (Io::kReads) embedded.resize(images.size());
  for (std::size_t i = 0; i < images.size(); ++i) {
    io.string(images[i].name);
    io.string(images[i].uri);
    io.string(images[i].mime_type);
    io.choice(embedded[i], 2);
    io.zeros(3);
  }
}

template <class Io, class N, class D>
void image_fields(Io& io, N& image, D& data) {
  io.number(image);
  io.rest(data);
}

template <class Io, class F>
void foreign_fields(Io& io, F& foreign) {
  io.string(foreign.key);
  io.rest(foreign.data);
}

}  // namespace pstrips::inline formats::layout
