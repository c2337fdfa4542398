#include "formats/gltf/extensions/extension.h"

namespace pstrips::inline formats::gltf {

// Both names mean the same bytes. Read where the view's buffer has none.
namespace {

void read_view(const Cursor& object, View& view) {
  View::Compressed& out = view.compressed.emplace();
  out.buffer = static_cast<Index>(std::min<std::uint64_t>(object.whole("buffer"), kNone));
  out.offset = object.whole("byteOffset");
  out.bytes = object.whole("byteLength");
  out.stride = object.whole("byteStride");
  out.count = object.whole("count");
  out.mode = object.text("mode");
  out.filter = object.text("filter");
}

}  // namespace

constinit const Extension kExtMeshopt = {.name = "EXT_meshopt_compression",
                                         .fate = Fate::held,
                                         .may_be_required = true,
                                         .read_view = read_view};
constinit const Extension kKhrMeshopt = {.name = "KHR_meshopt_compression",
                                         .fate = Fate::held,
                                         .may_be_required = true,
                                         .read_view = read_view};

}  // namespace pstrips::inline formats::gltf
