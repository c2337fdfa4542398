// What the XML reader accepts keeps `check`, and comes back the same through XML and through the
// binary variant. What the validator passes, the reader accepts.

#include "formats/pstrip/container/binary.h"
#include "formats/pstrip/payload/check.h"
#include "formats/pstrip/xml/xml.h"
#include "tests/fuzz/fuzz.h"
#include "tests/support/progressive.h"
#include "validators/validate.h"

using namespace pstrips;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const ByteView document = fuzz::as_file(data, size);
  const Report report = validate(document, {.limits = fuzz::kLimits, .ignore = {}});
  const auto strips = read_xml(document, fuzz::kLimits);
  if (report.errors() == 0 && looks_like_xml(document)) FUZZ_CHECK(strips);
  if (!strips) return 0;
  FUZZ_CHECK(strips->complete);
  FUZZ_CHECK(check(*strips));
  const Bytes written = write_xml(*strips);
  const auto again = read_xml(written);
  FUZZ_CHECK(again);
  // A NaN, which a material may have for a factor, is not equal to itself.
  FUZZ_CHECK(*again == *strips || !(*strips == *strips));
  FUZZ_CHECK(write_xml(*again) == written);
  const auto binary = write_binary(*strips);
  FUZZ_CHECK(binary);
  const auto from_binary = read_binary(*binary);
  FUZZ_CHECK(from_binary);
  FUZZ_CHECK(write_xml(*from_binary) == written);
  return 0;
}

fuzz::Target pstrips::fuzz::target() {
  Target out{.extensions = {".pstripx"},
             .words = {"<",
                       ">",
                       "/>",
                       "</",
                       "<!--",
                       "-->",
                       "<![CDATA[",
                       "]]>",
                       "&amp;",
                       "&#65;",
                       "&#0;",
                       "\\00",
                       "\\",
                       "\"",
                       " ",
                       "<vsplit",
                       "<mesh",
                       "<packet",
                       "<base>",
                       "| ",
                       "R-1 ",
                       "R+2 ",
                       "NaN",
                       "INF",
                       "nan:0x7fc00001",
                       "<?xml",
                       "\xef\xbb\xbf",
                       "parent=",
                       "AAAA",
                       "=",
                       "naive",
                       "offset",
                       "f64",
                       "u8"},
             .seeds = {}};
  for (std::uint32_t seed = 0; seed < 12; ++seed)
    out.seeds.push_back(write_xml(test::random_progressive_of_any_kind(seed)));
  return out;
}
