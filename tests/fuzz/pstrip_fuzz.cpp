// What the binary reader accepts keeps every promise of its contract: `check` holds, it decodes
// without harm, and writing and reading gives the same again. Prefix mode, the stream decoder and
// the validator agree with it. Every input is tried a second time with its CRCs mended, since
// a mutation would hardly get past them otherwise.

#include "converters/decode.h"
#include "converters/stream_decoder.h"
#include "formats/pstrip/container/binary.h"
#include "formats/pstrip/container/chunks.h"
#include "formats/pstrip/payload/check.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/progressive.h"
#include "validators/validate.h"

using namespace pstrips;

namespace {

Bytes with_right_crcs(ByteView file) {
  Bytes out = fuzz::copy(file);
  for (const Chunk& chunk : read_chunks(file).chunks) {
    const std::uint32_t crc = chunk.computed_crc;
    std::memcpy(out.data() + chunk.payload_offset() + chunk.payload.size(), &crc, sizeof crc);
  }
  return out;
}

// A NaN, which packets may have for an error, is not equal to itself.
bool is_same(const ProgressiveStrips& a, const ProgressiveStrips& b) {
  return a == b || (!(a == a) && a.complete == b.complete && a.packets.size() == b.packets.size() &&
                    (!a.complete || write_binary(a) == write_binary(b)));
}

void check_decodes(const ProgressiveStrips& strips) {
  FUZZ_CHECK(check(strips));
  for (const std::size_t packets : {std::size_t{0}, strips.packets.size()}) {
    const auto model = decode(strips, packets);
    if (!model) continue;  // records may be safe to follow and still make no mesh
    for (const Mesh& mesh : model->meshes) FUZZ_CHECK(find_inconsistency(mesh).empty());
  }
}

void check_round_trip(const ProgressiveStrips& strips) {
  const auto written = write_binary(strips);
  FUZZ_CHECK(written);
  const auto again = read_binary(*written);
  FUZZ_CHECK(again);
  FUZZ_CHECK(is_same(strips, *again));
}

// Fed in pieces of growing size: the pieces must not matter.
void check_stream(ByteView file, const Result<ProgressiveStrips>& prefix) {
  StreamDecoder decoder(fuzz::kLimits);
  bool refused = false;
  for (std::size_t at = 0, size = 1; at < file.size() && !refused; at += size++) {
    size = std::min(size, file.size() - at);
    refused = !decoder.feed(file.subspan(at, size));
    if (!refused && decoder.has_base()) decoder.update();
  }
  if (!prefix) return;
  FUZZ_CHECK(!refused);
  FUZZ_CHECK(is_same(*prefix, decoder.strips()));
}

void check_file(ByteView file) {
  const Report report = validate(file, {.limits = fuzz::kLimits, .ignore = {}});
  const auto whole = read_binary(file, fuzz::kLimits);
  const auto prefix = read_binary(file, fuzz::kLimits, ReadMode::prefix);
  if (report.errors() == 0 && !file.empty() && file[0] == kSignature[0]) FUZZ_CHECK(whole);
  if (whole) {
    FUZZ_CHECK(whole->complete);
    FUZZ_CHECK(prefix && is_same(*prefix, *whole));
    check_round_trip(*whole);
  }
  if (prefix) check_decodes(*prefix);
  check_stream(file, prefix);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const ByteView file = fuzz::as_file(data, size);
  check_file(file);
  check_file(with_right_crcs(file));
  return 0;
}

fuzz::Target pstrips::fuzz::target() {
  Target out{.extensions = {".pstrip"}, .words = {}, .seeds = {}};
  for (std::uint32_t seed = 0; seed < 12; ++seed)
    if (auto file = write_binary(test::random_progressive_of_any_kind(seed)))
      out.seeds.push_back(*std::move(file));
  return out;
}
