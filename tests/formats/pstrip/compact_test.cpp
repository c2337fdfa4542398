// Files of the compact profile: what is written is read again, record by record and bit for bit;
// bytes that nobody wrote are refused or give a mesh within what was announced.

#include "formats/pstrip/payload/compact/compact.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "codecs/compact/record_batches.h"
#include "codecs/simplify/simplify.h"
#include "formats/pstrip/container/binary.h"
#include "formats/pstrip/container/chunk_table.h"
#include "formats/pstrip/payload/check.h"
#include "formats/pstrip/payload/compact/cells.h"
#include "tests/support/meshes.h"
#include "tests/support/seamed_meshes.h"

namespace pstrips {
namespace {

/// Numbers that cells hold exactly.
void round_to(Attribute& attribute, double step) {
  for (std::size_t i = 0; i < attribute.elements(); ++i)
    for (std::size_t c = 0; c < attribute.count; ++c)
      set_component(attribute, i, c, std::round(component(attribute, i, c) / step) * step + 0.0);
}

CollapseSequence collapses_of(const Mesh& mesh, const Triangulation& triangles,
                              std::uint32_t seed) {
  if (seed % 2 == 0) {
    const std::vector<double> positions = positions_as_double(mesh);
    return simplify({.positions = positions,
                     .wedge_vertex = mesh.wedge_vertex,
                     .triangles = triangles.corners,
                     .group = {},
                     .attributes = {}},
                    {.target_triangles = seed});
  }
  // Any two vertices, most of them neighbours.
  std::mt19937 random(seed);
  CollapseSequence out;
  std::vector<Index> now(mesh.vertex_count());
  std::iota(now.begin(), now.end(), Index{0});
  const auto find = [&](Index v) {
    while (now[v] != v) v = now[v];
    return v;
  };
  for (Index tries = 2 * mesh.vertex_count(); tries > 0; --tries) {
    Index kept = find(static_cast<Index>(random() % now.size()));
    Index removed = find(static_cast<Index>(random() % now.size()));
    if (random() % 20 != 0 && !triangles.corners.empty()) {
      const std::size_t corner = random() % triangles.corners.size();
      kept = find(mesh.vertex_of(triangles.corners[corner]));
      removed = find(mesh.vertex_of(triangles.corners[corner / 3 * 3 + (corner + 1) % 3]));
    }
    if (kept == removed) continue;
    out.collapses.push_back({.removed = removed, .kept = kept, .error = 0, .moves = 0});
    now[removed] = kept;
  }
  return out;
}

/// Puts each coarse vertex of a recording where both that it becomes say: the middle, rounded.
void place_in_the_middle(ProgressiveMesh& mesh) {
  mesh.placement = Placement::optimal;
  mesh.parent_position.resize(mesh.vsplits.size() * mesh.position.element_bytes());
  Attribute parents = mesh.position.format();
  parents.data = std::move(mesh.parent_position);
  for (std::size_t i = mesh.vsplits.size(); i-- > 0;) {
    const Index vertex = mesh.base_vertices + static_cast<Index>(i),
                parent = mesh.vsplits[i].parent;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto cell = [&](Index v) {
        return static_cast<std::int64_t>(
            std::round(component(mesh.position, v, c) / double{mesh.grid.step}));
      };
      const std::int64_t after = cell(parent), step = cell(vertex) - after;
      set_component(parents, i, c, component(mesh.position, parent, c));
      if (parent != vertex)
        set_component(mesh.position, parent, c,
                      static_cast<double>(after + (step >> 1)) * double{mesh.grid.step});
    }
  }
  mesh.parent_position = std::move(parents.data);
}

/// A mesh on a grid as a file with a packet for each batch.
ProgressiveStrips strips_of(Mesh mesh, std::uint32_t seed, Placement placement, bool exact = true) {
  constexpr float kStep = 1.0f / 128;
  if (exact) {
    round_to(mesh.position, kStep);
    for (Attribute& a : mesh.wedge_attributes)
      if (a.type == ComponentType::f32) round_to(a, 1.0 / 256);
  }
  const Triangulation triangles = triangulate(mesh);
  BatchRecording made = record_batches(mesh, triangles, collapses_of(mesh, triangles, seed),
                                       {.placement = placement});
  ProgressiveStrips out;
  out.profile = Profile::compact;
  ProgressiveMesh& to = out.meshes.emplace_back(std::move(made.recording.mesh));
  to.grid = {.step = kStep, .origin = {0, 0, 0}, .exact = exact};
  if (placement == Placement::optimal) place_in_the_middle(to);
  const auto level = [&](Packet packet) {
    packet.vertices = to.base_vertices + packet.first_vsplit + packet.vsplits;
    const LevelCounts& counts = made.recording.levels[packet.first_vsplit + packet.vsplits];
    packet.triangles = counts.triangles;
    packet.strips = counts.strips;
    return packet;
  };
  out.bases.push_back(level({}));
  Packet packet;
  for (const Index size : made.batches) {
    packet.vsplits = size;
    out.packets.push_back(level(packet));
    packet.first_vsplit += size;
  }
  packet.vsplits = static_cast<Index>(to.vsplits.size()) - packet.first_vsplit;
  if (packet.vsplits > 0) out.packets.push_back(level(packet));
  return out;
}

void expect_round_trip(const ProgressiveStrips& strips) {
  ASSERT_TRUE(check(strips)) << check(strips).error().message << check(strips).error().path;
  const Result<Bytes> file = write_binary(strips);
  ASSERT_TRUE(file) << file.error().message << " " << file.error().path;
  const Result<ProgressiveStrips> back = read_binary(*file);
  ASSERT_TRUE(back) << back.error().message << " " << back.error().path;
  const ProgressiveMesh &a = strips.meshes[0], &b = back->meshes[0];
  ASSERT_EQ(a.vsplits, b.vsplits);
  ASSERT_EQ(a.wedge_offset_counts, b.wedge_offset_counts);
  ASSERT_EQ(a.map_offsets, b.map_offsets);
  ASSERT_EQ(a.new_corners, b.new_corners);
  ASSERT_EQ(a.reassigned, b.reassigned);
  ASSERT_EQ(a.triangle_group, b.triangle_group);
  ASSERT_EQ(a.position.data, b.position.data);
  ASSERT_EQ(a.wedge_attributes, b.wedge_attributes);
  ASSERT_EQ(*back, strips);
}

constexpr Placement kPlacements[] = {Placement::subset, Placement::optimal};
constexpr Effort kEfforts[] = {Effort::fast, Effort::small};

ProgressiveStrips with_effort(ProgressiveStrips strips, Effort effort) {
  strips.meshes[0].effort = effort;
  return strips;
}

TEST(Compact, OrderlyMeshesComeBack) {
  for (const Mesh& mesh : {test::grid(12), test::torus(16, 9), test::cube(false), test::cube(true),
                           test::triangle_mesh({}, {}), test::seamed_torus(12, 8),
                           test::seamed_cylinder(9, 7), test::cube_sphere(6, 2)})
    for (const Placement placement : kPlacements)
      for (std::uint32_t seed = 0; seed < 5; ++seed) {
        SCOPED_TRACE(seed);
        for (const Effort effort : kEfforts)
          expect_round_trip(with_effort(strips_of(mesh, seed, placement), effort));
        if (HasFatalFailure()) return;
      }
}

TEST(Compact, AnyComplexComesBack) {
  for (std::uint32_t seed = 0; seed < 300; ++seed)
    for (const Mesh& mesh : {test::random_soup(seed, 4 + seed % 40, seed),
                             test::polygon_soup(seed, 4 + seed % 30, seed / 2)})
      for (const Placement placement : kPlacements) {
        SCOPED_TRACE(seed);
        for (const Effort effort : kEfforts)
          expect_round_trip(with_effort(strips_of(mesh, seed, placement), effort));
        if (HasFatalFailure()) return;
      }
}

TEST(Compact, BitsBelowTheCellsComeBack) {
  for (const Mesh& mesh : {test::grid(12), test::torus(16, 9), test::seamed_torus(12, 8)}) {
    ProgressiveStrips strips = strips_of(mesh, 2, Placement::subset, false);
    expect_round_trip(strips);
    Attribute& position = strips.meshes[0].position;
    const float odd[] = {-0.0f,
                         std::numeric_limits<float>::quiet_NaN(),
                         std::numeric_limits<float>::infinity(),
                         1e-40f,
                         3e38f,
                         -7};
    std::memcpy(position.data.data() + position.data.size() - sizeof odd, odd, sizeof odd);
    expect_round_trip(strips);
  }
}

/// Several meshes of one file, packets by turns.
TEST(Compact, MeshesOfAFileComeBack) {
  ProgressiveStrips strips = strips_of(test::torus(16, 9), 0, Placement::subset);
  const ProgressiveStrips other = strips_of(test::seamed_torus(12, 8), 2, Placement::optimal);
  strips.meshes.push_back(other.meshes[0]);
  strips.bases.push_back(other.bases[0]);
  strips.bases[1].mesh = 1;
  std::vector<Packet> packets;
  for (std::size_t k = 0; k < std::max(strips.packets.size(), other.packets.size()); ++k) {
    if (k < other.packets.size()) packets.push_back(other.packets[k]), packets.back().mesh = 1;
    if (k < strips.packets.size()) packets.push_back(strips.packets[k]);
  }
  strips.packets = packets;
  expect_round_trip(strips);
}

TEST(Compact, PrefixesGiveWhatTheirPacketsBrought) {
  const ProgressiveStrips strips = strips_of(test::cube_sphere(6, 2), 4, Placement::subset);
  const Bytes file = write_binary(strips).value();
  std::size_t whole = 0;
  for (std::size_t size = 0; size < file.size(); ++size) {
    const auto back = read_binary(ByteView(file).first(size), {}, ReadMode::prefix);
    if (!back) continue;
    ++whole;
    ASSERT_TRUE(check(*back));
    const ProgressiveMesh &a = strips.meshes[0], &b = back->meshes[0];
    ASSERT_TRUE(std::ranges::equal(b.vsplits, std::span(a.vsplits).first(b.vsplits.size())));
    ASSERT_TRUE(std::ranges::equal(b.position.data,
                                   std::span(a.position.data).first(b.position.data.size())));
  }
  EXPECT_GT(whole, file.size() / 2);
}

/// Changes bytes of payloads and mends the checksums.
Bytes mutated(const Bytes& file, std::mt19937& random) {
  Bytes bad = file;
  std::vector<Chunk> chunks;
  for (const Chunk& chunk : read_chunks(file).chunks)
    if (chunk.type == kBaseChunk || chunk.type == kPacketChunk) chunks.push_back(chunk);
  const Chunk& chunk = chunks[random() % chunks.size()];
  for (std::size_t changes = 1 + random() % 3; changes > 0; --changes) {
    const std::size_t at = chunk.payload_offset() + random() % chunk.payload.size();
    bad[at] ^= static_cast<std::byte>(1 + random() % 255);
  }
  const std::span<std::byte> frame = std::span(bad).subspan(chunk.offset, chunk.bytes());
  const std::uint32_t crc = chunk_crc(frame.first(frame.size() - 4));
  std::memcpy(frame.data() + frame.size() - 4, &crc, 4);
  return bad;
}

TEST(Compact, DamagedFilesAreRefusedOrGiveAMesh) {
  std::mt19937 random(5);
  std::size_t refused = 0, runs = 0;
  for (const Mesh& mesh :
       {test::torus(16, 9), test::cube_sphere(6, 2), test::random_soup(3, 30, 60)})
    for (int way = 0; way < 4; ++way) {
      const ProgressiveStrips strips = strips_of(mesh, 4, kPlacements[way % 2]);
      const Bytes file = write_binary(with_effort(strips, kEfforts[way / 2])).value();
      for (int run = 0; run < 1500; ++run, ++runs) {
        const auto back = read_binary(mutated(file, random), {}, ReadMode::prefix);
        refused += back ? 0 : 1;
        ASSERT_TRUE(!back || check(*back));
      }
    }
  EXPECT_GT(refused, runs * 99 / 100);
}

TEST(Compact, WhatIsNoBatchIsNotWritten) {
  const ProgressiveStrips good = strips_of(test::torus(16, 9), 0, Placement::subset);
  const auto refuses = [&](auto&& change) {
    ProgressiveStrips bad = good;
    change(bad);
    const Result<Bytes> file = write_binary_unchecked(bad);
    return !file && file.error().code == ErrorCode::bad_argument && !file.error().path.empty();
  };
  EXPECT_FALSE(refuses([](ProgressiveStrips&) {}));
  EXPECT_TRUE(refuses([](ProgressiveStrips& s) { s.meshes[0].grid.step = 0; }));
  EXPECT_TRUE(refuses([](ProgressiveStrips& s) {  // off the grid
    set_component(s.meshes[0].position, s.meshes[0].vertices - 1, 1, 0.3);
  }));
  EXPECT_TRUE(refuses([](ProgressiveStrips& s) {  // two batches in one packet
    s.packets[1].first_vsplit = 0;
    s.packets[1].vsplits += s.packets[0].vsplits;
    s.packets.erase(s.packets.begin());
  }));
  EXPECT_TRUE(refuses([](ProgressiveStrips& s) {  // a corner of another vertex
    ProgressiveMesh& mesh = s.meshes[0];
    mesh.map_offsets.back() = mesh.map_offsets.back() == 0 ? 1 : 0;
  }));
}

}  // namespace
}  // namespace pstrips
