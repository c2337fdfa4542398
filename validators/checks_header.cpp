#include <algorithm>
#include <cmath>
#include <set>

#include "formats/pstrip/container/chunk_table.h"
#include "formats/pstrip/payload/compact/cells.h"
#include "formats/pstrip/payload/predicates.h"
#include "validators/checks.h"

namespace pstrips::inline validators::checks {
namespace {

using layout::kTotals;
using layout::MeshCounts;
using layout::Total;

std::string versus(std::uint64_t says, std::uint64_t is) {
  return "says " + std::to_string(says) + ", is " + std::to_string(is);
}

Where in_header(std::uint64_t byte) { return {.field = Field::header, .element = byte}; }
Where count_of(std::size_t mesh, std::uint64_t number) {
  return {.field = Field::counts, .mesh = static_cast<Index>(mesh), .element = number};
}
Where in_row(std::size_t row) { return {.field = Field::row, .element = row}; }

/// All of the file's declarations are there.
bool has_header(const Document& doc) { return doc.header && !doc.ended_early; }

/// Every chunk that a row of PIDX stands for, with the row; as far as both are there.
template <class Visit>
void for_each_row(const Document& doc, Visit&& visit) {
  const std::size_t bases = doc.strips.bases.size();
  std::vector<std::size_t> used(doc.mesh_chunks.size());
  const auto chunk = [&](Index mesh, bool base) -> const Chunk& {
    const MeshChunks& chunks = doc.mesh_chunks[mesh];
    return doc.frame.chunks[base ? chunks.find(kBaseChunk) : chunks.packets[used[mesh]++]];
  };
  for (std::size_t i = 0; i < doc.index.size(); ++i) {
    if (i < bases)
      visit(i, doc.strips.bases[i], chunk(static_cast<Index>(i), true));
    else if (i - bases < doc.strips.packets.size())
      visit(i, doc.strips.packets[i - bases], chunk(doc.strips.packets[i - bases].mesh, false));
  }
}

/// The levels of each mesh from base to last packet: where they are declared and what is reached.
template <class Visit>
void for_each_level(const Document& doc, Visit&& visit) {
  const std::size_t bases = doc.strips.bases.size();
  for (Index m = 0; m < bases; ++m) {
    visit(m, std::size_t{0}, doc.strips.bases[m], m);
    for (std::size_t k = 0; k < doc.packets_of[m].size(); ++k)
      visit(m, k + 1, doc.strips.packets[doc.packets_of[m][k]], bases + doc.packets_of[m][k]);
  }
}

Where level_at(const Document& doc, Index mesh, std::size_t level, std::size_t row) {
  if (!doc.xml) return in_row(row);
  if (level == 0) return {.field = Field::base, .mesh = mesh};
  return {.field = Field::packet, .mesh = mesh, .packet = static_cast<Index>(level - 1)};
}

void reached(const Document& doc, Findings& out, Index Packet::*says, Index Shown::*is) {
  for_each_level(doc, [&](Index m, std::size_t level, const Packet& packet, std::size_t row) {
    const bool declared = doc.xml || row < doc.index.size();
    if (!declared || level >= doc.replays[m].levels.size()) return;
    const Index found = doc.replays[m].levels[level].*is;
    if (packet.*says != found) out.add(level_at(doc, m, level, row), versus(packet.*says, found));
  });
}

}  // namespace

void totals_summed(const Document& doc, Findings& out) {
  if (!has_header(doc)) return;
  for (const Total& total : kTotals) {
    const std::uint64_t sum = layout::sum_of(total, doc.declared);
    const std::uint64_t says = *doc.header.*total.total;
    if (says != sum) out.add(in_header(total.byte), total.name + (" " + versus(says, sum)));
  }
}

void counts_of_base(const Document& doc, Findings& out) {
  for (std::size_t m = 0; m < doc.declared.size(); ++m) {
    const MeshCounts& c = doc.declared[m];
    if (c.base_vertices > c.vertices)
      out.add(count_of(m, 7),
              std::to_string(c.base_vertices) + " of " + std::to_string(c.vertices));
    if (c.base_wedges > c.wedges)
      out.add(count_of(m, 8), std::to_string(c.base_wedges) + " of " + std::to_string(c.wedges));
  }
}

void base_end(const Document& doc, Findings& out) {
  if (!has_header(doc)) return;
  std::uint64_t end = 0;
  for (const Chunk& chunk : doc.frame.chunks)
    if (chunk.type == kIndexChunk || chunk.type == kBaseChunk) end = chunk.offset + chunk.bytes();
  if (doc.header->base_end != end) out.add(in_header(80), versus(doc.header->base_end, end));
}

void file_bytes(const Document& doc, Findings& out) {
  noticed<Fault::past_file_bytes>(doc, out);
  if (!has_header(doc) || doc.depth < Depth::model) return;
  const Chunk& last = doc.frame.chunks.back();
  const std::uint64_t end = last.offset + last.bytes();
  if (doc.header->file_bytes != end) out.add(in_header(88), versus(doc.header->file_bytes, end));
}

void decoder_memory_computed(const Document& doc, Findings& out) {
  if (!has_header(doc)) return;
  std::uint64_t largest = 0;
  for (const Chunk& chunk : doc.frame.chunks)
    if (chunk.type == kBaseChunk || chunk.type == kPacketChunk)
      largest = std::max(largest, chunk.bytes());
  const std::uint64_t needed = decoder_memory(doc.strips.meshes, largest);
  if (doc.header->decoder_memory != needed)
    out.add(in_header(64), versus(doc.header->decoder_memory, needed));
}

void conformance_computed(const Document& doc, Findings& out) {
  if (!doc.header) return;
  const std::uint8_t level = conformance_level(*doc.header);
  if (doc.header->conformance != level)
    out.add(in_header(5), versus(doc.header->conformance, level));
}

// ---- MESH ----

void vsplits_fill(const Document& doc, Findings& out) {
  for (std::size_t m = 0; m < doc.declared.size(); ++m) {
    const MeshCounts& c = doc.declared[m];
    if (c.base_vertices > c.vertices || c.vertices > kMaxCount) continue;  // M-011, M-001
    const Index lacking = c.vertices - c.base_vertices;
    if (c.vsplits != lacking) out.add(count_of(m, 5), versus(c.vsplits, lacking));
  }
}

void packets_hold_vsplits(const Document& doc, Findings& out) {
  if (doc.ended_early) return;
  for (std::size_t m = 0; m < doc.declared.size(); ++m) {
    const std::size_t come = doc.strips.meshes[m].vsplits.size();
    if (come != doc.declared[m].vsplits)
      out.add(count_of(m, 5), versus(doc.declared[m].vsplits, come));
  }
}

void packets_not_empty(const Document& doc, Findings& out) {
  for (Index m = 0; m < doc.packets_of.size(); ++m)
    for (std::size_t k = 0; k < doc.packets_of[m].size(); ++k)
      if (doc.strips.packets[doc.packets_of[m][k]].vsplits == 0)
        out.add({.field = Field::packet, .mesh = m, .packet = static_cast<Index>(k)});
}

void strips_fit_map(const Document& doc, Findings& out) {
  for (std::size_t m = 0; m < doc.declared.size(); ++m) {
    const MeshCounts& c = doc.declared[m];
    if (std::max(c.triangles, c.strips) > kMaxCount) continue;  // M-001
    if (c.triangles > c.map_entries) out.add(count_of(m, 2), std::to_string(c.triangles));
    if (c.strips > c.map_entries) out.add(count_of(m, 3), std::to_string(c.strips));
  }
}

void triangle_entries_hold(const Document& doc, Findings& out) {
  for (std::size_t m = 0; m < doc.declared.size(); ++m) {
    const MeshCounts& c = doc.declared[m];
    if (doc.strips.meshes[m].encoding != MapEncoding::triangles || c.triangles > kMaxCount)
      continue;  // M-001
    const std::uint64_t entries = std::uint64_t{3} * c.triangles;
    if (c.map_entries != entries) out.add(count_of(m, 4), versus(c.map_entries, entries));
  }
}

void profile_encodings(const Document& doc, Findings& out) {
  if (doc.strips.profile == Profile::plain) return;
  for (Index m = 0; m < doc.strips.meshes.size(); ++m)
    if (doc.strips.meshes[m].encoding != MapEncoding::triangles)
      out.add({.field = Field::mesh, .mesh = m});
}

void position_grids(const Document& doc, Findings& out) {
  if (doc.strips.profile == Profile::plain) return;
  for (Index m = 0; m < doc.strips.meshes.size(); ++m) {
    const ProgressiveMesh& mesh = doc.strips.meshes[m];
    if (mesh.position.count != 3 || !PositionCells::is_valid(mesh.grid, mesh.position.type))
      out.add({.field = Field::position_format, .mesh = m});
  }
}

void few_attributes(const Document& doc, Findings& out) {
  for (Index m = 0; m < doc.strips.meshes.size(); ++m) {
    const ProgressiveMesh& mesh = doc.strips.meshes[m];
    const Where where{.field = Field::mesh, .mesh = m};
    if (mesh.wedge_attributes.size() > kMaxAttributes)
      out.add(where, std::to_string(mesh.wedge_attributes.size()));
    if (mesh.face_attribute_formats.size() > kMaxAttributes)
      out.add(where, std::to_string(mesh.face_attribute_formats.size()));
  }
}

void mesh_wedges_come(const Document& doc, Findings& out) {
  if (doc.ended_early) return;
  for (std::size_t m = 0; m < doc.declared.size(); ++m) {
    const MeshCounts& c = doc.declared[m];
    // M-002, M-011 and M-001 say so.
    if (doc.strips.meshes[m].single_wedges || c.base_wedges > c.wedges || c.wedges > kMaxCount)
      continue;
    const std::uint64_t come =
        std::uint64_t{c.base_wedges} + doc.strips.meshes[m].wedge_offset_counts.size();
    if (come != c.wedges) out.add(count_of(m, 1), versus(c.wedges, come));
  }
}

void single_wedges_hold(const Document& doc, Findings& out) {
  for (std::size_t m = 0; m < doc.declared.size(); ++m) {
    const MeshCounts& c = doc.declared[m];
    if (!doc.strips.meshes[m].single_wedges) continue;
    if (c.wedges != c.vertices) out.add(count_of(m, 1), versus(c.wedges, c.vertices));
    if (c.base_wedges != c.base_vertices)
      out.add(count_of(m, 8), versus(c.base_wedges, c.base_vertices));
  }
}

void has_group(const Document& doc, Findings& out) {
  for (Index m = 0; m < doc.strips.meshes.size(); ++m)
    if (doc.strips.meshes[m].groups.empty()) out.add({.field = Field::mesh, .mesh = m});
}

void group_entries_summed(const Document& doc, Findings& out) {
  for (std::size_t m = 0; m < doc.declared.size(); ++m) {
    const std::uint64_t sum = sum_of_group_entries(doc.strips.meshes[m]);
    if (sum != doc.declared[m].map_entries)
      out.add(count_of(m, 4), versus(doc.declared[m].map_entries, sum));
  }
}

void counts_representable(const Document& doc, Findings& out) {
  for (std::size_t m = 0; m < doc.declared.size(); ++m) {
    const MeshCounts& c = doc.declared[m];
    const Index counts[] = {c.vertices,    c.wedges,  c.triangles, c.strips,
                            c.map_entries, c.vsplits, c.faces};
    for (std::size_t i = 0; i < std::size(counts); ++i)
      if (counts[i] > kMaxCount) out.add(count_of(m, i), std::to_string(counts[i]));
  }
}

void semantics_differ(const Document& doc, Findings& out) {
  const auto differ = [&](const std::vector<Attribute>& list, Field field, Index m) {
    std::set<std::string_view> seen;
    for (std::size_t i = 0; i < list.size(); ++i)
      if (!seen.insert(list[i].semantic).second)
        out.add({.field = field, .mesh = m, .element = i}, list[i].semantic);
  };
  for (Index m = 0; m < doc.strips.meshes.size(); ++m) {
    differ(doc.strips.meshes[m].wedge_attributes, Field::wedge_format, m);
    differ(doc.strips.meshes[m].face_attribute_formats, Field::face_format, m);
  }
}

void group_materials_exist(const Document& doc, Findings& out) {
  const std::size_t materials = doc.strips.scene.materials.size();
  for (Index m = 0; m < doc.strips.meshes.size(); ++m) {
    const std::vector<Group>& groups = doc.strips.meshes[m].groups;
    for (std::size_t g = 0; g < groups.size(); ++g)
      if (groups[g].material != kNone && groups[g].material >= materials)
        out.add({.field = Field::group, .mesh = m, .element = g},
                std::to_string(groups[g].material) + " of " + std::to_string(materials));
  }
}

// ---- PIDX ----

void rows_counted(const Document& doc, Findings& out) {
  noticed<Fault::index_missing>(doc, out);
  if (doc.xml || doc.depth < Depth::model || doc.ended_early) return;
  const std::uint64_t chunks = std::uint64_t{doc.header->meshes} + doc.header->packets;
  if (doc.index.size() != chunks)
    out.add({.field = Field::index}, versus(doc.index.size(), chunks));
}

void rows_point_to_chunks(const Document& doc, Findings& out) {
  for_each_row(doc, [&](std::size_t i, const Packet&, const Chunk& chunk) {
    const IndexRow& row = doc.index[i];
    if (row.offset != chunk.offset)
      out.add(in_row(i), "offset " + versus(row.offset, chunk.offset));
    if (row.bytes != chunk.bytes()) out.add(in_row(i), "bytes " + versus(row.bytes, chunk.bytes()));
  });
}

void rows_describe_chunks(const Document& doc, Findings& out) {
  for_each_row(doc, [&](std::size_t i, const Packet& packet, const Chunk&) {
    const IndexRow& row = doc.index[i];
    if (row.mesh != packet.mesh) out.add(in_row(i), "mesh " + versus(row.mesh, packet.mesh));
    if (row.vsplits != packet.vsplits)
      out.add(in_row(i), "vsplits " + versus(row.vsplits, packet.vsplits));
  });
}

void row_vertices(const Document& doc, Findings& out) {
  reached(doc, out, &Packet::vertices, &Shown::vertices);
}
void row_triangles(const Document& doc, Findings& out) {
  reached(doc, out, &Packet::triangles, &Shown::triangles);
}
void row_strips(const Document& doc, Findings& out) {
  reached(doc, out, &Packet::strips, &Shown::strips);
}

void errors_finite(const Document& doc, Findings& out) {
  for_each_level(doc, [&](Index m, std::size_t level, const Packet& packet, std::size_t row) {
    for (const float error : {packet.error, packet.one_sided_error})
      if (!std::isfinite(error) || std::signbit(error))
        out.add(level_at(doc, m, level, row), std::to_string(error));
  });
}

void errors_fall(const Document& doc, Findings& out) {
  Packet last;
  for_each_level(doc, [&](Index m, std::size_t level, const Packet& packet, std::size_t row) {
    if (level > 0)
      for (const auto error : {&Packet::error, &Packet::one_sided_error})
        if (packet.*error > last.*error)
          out.add(level_at(doc, m, level, row),
                  std::to_string(packet.*error) + " after " + std::to_string(last.*error));
    last = packet;
  });
}

void one_side_within_both(const Document& doc, Findings& out) {
  for_each_level(doc, [&](Index m, std::size_t level, const Packet& packet, std::size_t row) {
    if (packet.one_sided_error > packet.error)
      out.add(level_at(doc, m, level, row),
              std::to_string(packet.one_sided_error) + " within " + std::to_string(packet.error));
  });
}

}  // namespace pstrips::inline validators::checks
