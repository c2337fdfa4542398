#include "tests/support/round_trip.h"

#include "converters/compare.h"
#include "converters/decode.h"
#include "formats/pstrip/container/binary.h"
#include "formats/pstrip/xml/xml.h"
#include "validators/validate.h"

namespace pstrips::test {

std::string round_trip(const Model& model, const EncodeOptions& options, bool xml) {
  auto strips = encode(model, options);
  if (!strips) return "encode: " + strips.error().message;
  Bytes file;
  if (xml) {
    file = write_xml(*strips);
  } else {
    auto bytes = write_binary(*strips);
    if (!bytes) return "write: " + bytes.error().message;
    file = std::move(bytes).value();
  }
  const Report report = validate(file);
  if (report.errors() > 0)
    return "validate: " + std::string(report.findings()[0].code) + " " +
           report.findings()[0].message + " at " + report.findings()[0].path;
  const auto read = xml ? read_xml(file) : read_binary(file);
  if (!read) return "read: " + read.error().message + " at " + read.error().path;
  if (*read != *strips) return "the file read is not the file written";
  const Model back = decode(*read).value();
  if (back.scene != model.scene) return "the scene changed";
  if (options.keep_order) return back.meshes == model.meshes ? "" : "not exact with --keep-order";
  const Comparison c = compare(model, back, 1000);
  if (c.equivalence == Equivalence::different)
    return "different: " + (c.differences.empty() ? std::string() : c.differences[0]);
  return {};
}

}  // namespace pstrips::test
