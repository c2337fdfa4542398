#include "formats/pstrip/payload/part_bits.h"

#include <memory>
#include <numeric>

#include "formats/pstrip/container/parts.h"
#include "formats/pstrip/payload/decoder.h"
#include "formats/pstrip/payload/geometry_layout.h"

namespace pstrips::inline formats {
namespace {

double& part(PartBits& bits, Part p) { return bits[static_cast<std::size_t>(p)]; }

/// What was counted of a payload, in place of what its bytes count to.
void put_in(const PartBits& counted, const Chunk& chunk, PartBits& bits) {
  const double sum = std::accumulate(counted.begin(), counted.end(), 0.0);
  const double all = 8 * static_cast<double>(chunk.bytes());
  if (sum == 0 || sum > all) return;
  bits = counted;
  part(bits, Part::container) += all - sum;
}

}  // namespace

std::vector<PartBits> count_part_bits(const ChunkList& chunks, const Limits& limits) {
  std::vector<PartBits> out(chunks.chunks.size());
  for (const PartSpan& span : list_parts(chunks, limits))
    if (span.chunk < out.size())
      part(out[span.chunk], span.part) += 8 * static_cast<double>(span.bytes);
  PartBits counted{};
  FirstFault faults;
  PayloadDecoder decoder(limits, PayloadChecks::model, faults);
  decoder.use_reader([&](Profile profile, const FileHeader& header) {
    return layout_of(profile).counting_reader(header, counted);
  });
  for (std::size_t i = 0; i < out.size(); ++i) {
    counted.fill(0);
    if (!decoder.decode(chunks.chunks[i])) break;
    put_in(counted, chunks.chunks[i], out[i]);
  }
  return out;
}

}  // namespace pstrips::inline formats
