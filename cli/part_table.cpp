#include "cli/part_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <ostream>

#include "cli/table.h"
#include "formats/pstrip/container/chunk_table.h"
#include "formats/pstrip/payload/part_bits.h"

namespace pstrips::cli {
namespace {

std::string key_of(std::size_t group) {
  return std::string(name_of(static_cast<PartGroup>(group)).key);
}

double a_vertex(double bits, std::uint64_t vertices) {
  return vertices == 0 ? 0 : bits / static_cast<double>(vertices);
}

// Bits are sums of logarithms: what is beyond a thousandth means nothing.
double rounded(double bits) { return std::round(bits * 1000) / 1000; }

}  // namespace

PartTable::PartTable(const ChunkList& chunks, const Limits& limits) {
  const std::vector<PartBits> bits = count_part_bits(chunks, limits);
  packets_.emplace_back();
  ends_.push_back(0);
  for (std::size_t i = 0; i < bits.size(); ++i) {
    const Chunk& chunk = chunks.chunks[i];
    const std::uint64_t end = chunk.offset + chunk.bytes();
    if (chunk.type == kBaseChunk) ends_.front() = end;
    if (chunk.type == kPacketChunk) {
      ends_.push_back(end);
      packets_.emplace_back();
    }
    const bool is_geometry = chunk.type == kBaseChunk || chunk.type == kPacketChunk;
    for (std::size_t part = 0; part < bits[i].size(); ++part) {
      const auto group = static_cast<std::size_t>(group_of(static_cast<Part>(part)));
      all_[group] += bits[i][part];
      if (is_geometry) packets_.back()[group] += bits[i][part];
    }
  }
  for (double& of : all_) of = rounded(of);
  for (Bits& packet : packets_)
    for (double& of : packet) of = rounded(of);
}

void PartTable::print(std::ostream& out, const Inspection& file) const {
  Table table({"part", "bits", "bits per vertex", "% of file"});
  const double bits = std::max(std::accumulate(all_.begin(), all_.end(), 0.0), 1.0);
  const auto add = [&](std::string_view label, double of) {
    table.add({std::string(label), grouped(static_cast<std::uint64_t>(std::llround(of))),
               fmt::format("{:.2f}", a_vertex(of, file.vertices)),
               fmt::format("{:.1f}", 100 * of / bits)});
  };
  for (std::size_t g = 0; g < kPartGroups; ++g)
    add(name_of(static_cast<PartGroup>(g)).label, all_[g]);
  add("all", bits);
  table.print(out);
  if (packets_.size() == file.levels.size()) print_packets(out, file);
}

void PartTable::print_packets(std::ostream& out, const Inspection& file) const {
  std::vector<std::size_t> groups;
  for (std::size_t g = 0; g < kPartGroups; ++g)
    if (std::ranges::any_of(packets_, [&](const Bits& bits) { return bits[g] != 0; }))
      groups.push_back(g);
  std::vector<std::string> header = {"packet", "new vertices"};
  for (const std::size_t g : groups) header.push_back(key_of(g));
  Table table(std::move(header));
  std::uint64_t before = 0;
  for (std::size_t i = 0; i < packets_.size(); ++i) {
    const std::uint64_t vertices = file.levels[i].vertices - before;
    before = file.levels[i].vertices;
    std::vector<std::string> row = {std::to_string(i), grouped(vertices)};
    for (const std::size_t g : groups)
      row.push_back(fmt::format("{:.2f}", a_vertex(packets_[i][g], vertices)));
    table.add(std::move(row));
  }
  out << "\nbits per new vertex\n";
  table.print(out);
}

}  // namespace pstrips::cli
