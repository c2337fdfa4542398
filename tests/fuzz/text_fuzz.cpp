// What the text reader accepts is a consistent mesh whose collapses can be recorded; the
// progressive strips give the mesh back in its order, and their own text gives it back as a set
// unless the writer says what it dropped.

#include "converters/compare.h"
#include "converters/decode.h"
#include "converters/encode.h"
#include "converters/text_collapses.h"
#include "formats/pstrip/payload/check.h"
#include "formats/pstrip/text/text.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/progressive.h"

using namespace pstrips;

namespace {

bool is_like(const Model& a, const Model& b, Equivalence at_worst) {
  return compare(a, b, 100).equivalence <= at_worst;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto text = read_text(fuzz::as_file(data, size), fuzz::kLimits);
  if (!text) return 0;
  FUZZ_CHECK(find_inconsistency(text->mesh).empty());
  Model model;
  model.meshes = {text->mesh};
  const auto strips = encode_with(model, {collapses_of(*text)}, {.keep_order = true});
  FUZZ_CHECK(strips);
  FUZZ_CHECK(check(*strips));
  const auto decoded = decode(*strips);
  FUZZ_CHECK(decoded);
  FUZZ_CHECK(is_like(model, *decoded, Equivalence::exact));

  const auto written = write_text(*strips, fuzz::kLimits);
  if (!written) {
    FUZZ_CHECK(written.error().code == ErrorCode::over_limit);
    return 0;
  }
  const auto again = read_text(written->bytes);
  FUZZ_CHECK(again);
  FUZZ_CHECK(again->collapses.size() == strips->meshes[0].vsplits.size());
  Model read;
  read.meshes = {again->mesh};
  if (written->dropped.empty()) FUZZ_CHECK(is_like(model, read, Equivalence::reordered));
  return 0;
}

fuzz::Target pstrips::fuzz::target() {
  Target out{.extensions = {".pm"},
             .words = {"v ", "vt ", "f ", "s ", "\n", " ", "#", "1/1", "# pstrips text 1.0",
                       "vertices=", "faces=", "vsplits=", "position=f64", "position=f32", "/"},
             .seeds = {}};
  for (std::uint32_t seed = 0; seed < 12; ++seed)
    if (auto file = write_text(test::random_progressive_of_any_kind(seed)))
      out.seeds.push_back(std::move(file->bytes));
  return out;
}
