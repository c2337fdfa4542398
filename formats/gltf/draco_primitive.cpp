#include "formats/gltf/draco_primitive.h"

#include <algorithm>

#include "formats/draco/draco.h"

namespace pstrips::inline formats::gltf {
namespace {

/// The same numbers in the type of an accessor; bits where that is the same.
Bytes in_type_of(const Accessor& accessor, const Attribute& values) {
  if (values.type == accessor.type && values.count == accessor.components) return values.data;
  Attribute out{{}, accessor.type, accessor.components, false, {}};
  out.data.resize(values.elements() * out.element_bytes());
  Attribute in = values.format();
  in.normalized = false;  // stored numbers, not what they stand for
  in.data = values.data;
  for (std::size_t i = 0; i < in.elements(); ++i)
    for (std::size_t c = 0; c < out.count && c < in.count; ++c)
      set_component(out, i, c, component(in, i, c));
  return out.data;
}

class DracoPrimitive {
 public:
  DracoPrimitive(Data& data, const Document& document, const Primitive& in, const Limits& limits,
                 const std::string& path)
      : data_(data), document_(document), in_(in), limits_(limits), path_(path) {}

  Result<void> read() {
    if (in_.mode != Mode::triangles && in_.mode != Mode::strip)
      return refuse("Draco compression of another mode than triangles");
    if (in_.indices == kNone) return refuse("Draco compression without indices");
    if (in_.compressed->view >= document_.views.size())
      return refuse("Draco compression refers to nothing");
    const View& view = document_.views[in_.compressed->view];
    const auto payload = data_.range(in_.compressed->view, 0, view.bytes);
    if (!payload) return tl::unexpected(payload.error());
    auto geometry = decode_draco(*payload, limits_);
    if (!geometry) return fail(geometry.error().code, geometry.error().message, kNoOffset, path_);
    for (const auto& [name, id] : in_.compressed->attributes)
      if (auto put = put_attribute(*geometry, name, id); !put) return put;
    return put_indices(*geometry);
  }

 private:
  tl::unexpected<Error> refuse(std::string message) const {
    return fail(ErrorCode::corrupt, std::move(message), kNoOffset, path_);
  }

  Result<void> put_attribute(const DracoGeometry& geometry, const std::string& name,
                             std::uint32_t id) {
    const auto named =
        std::ranges::find(in_.attributes, name, [](const auto& a) { return a.first; });
    if (named == in_.attributes.end()) return {};
    const Accessor& accessor = document_.accessors[named->second];
    if (accessor.view != kNone) return {};  // its own bytes are as exact as any
    const auto attribute = std::ranges::find(geometry.attributes, id, &DracoAttribute::id);
    if (attribute == geometry.attributes.end()) return refuse("Draco payload without " + name);
    if (accessor.count != geometry.points)
      return refuse("Draco payload of another number of points than its accessors");
    if (accessor.is_matrix()) return refuse("Draco attribute that is a matrix");
    return data_.give(named->second, in_type_of(accessor, attribute->values));
  }

  Result<void> put_indices(const DracoGeometry& geometry) {
    const Accessor& accessor = document_.accessors[in_.indices];
    if (accessor.count != geometry.triangles.size())
      return refuse("Draco payload of another number of corners than its accessor");
    Attribute indices{{}, ComponentType::u32, 1, false, {}};
    const ByteView bytes = std::as_bytes(std::span(geometry.triangles));
    indices.data.assign(bytes.begin(), bytes.end());
    return data_.give(in_.indices, in_type_of(accessor, indices));
  }

  Data& data_;
  const Document& document_;
  const Primitive& in_;
  const Limits& limits_;
  const std::string& path_;
};

}  // namespace

bool needs_draco(const Document& document, const Primitive& in) {
  if (!in.compressed) return false;
  const auto is_empty = [&](Index accessor) { return document.accessors[accessor].view == kNone; };
  return (in.indices != kNone && is_empty(in.indices)) ||
         std::ranges::any_of(in.attributes, [&](const auto& a) { return is_empty(a.second); });
}

Result<void> read_draco(Data& data, const Document& document, const Primitive& primitive,
                        const Limits& limits, const std::string& path) {
  return DracoPrimitive(data, document, primitive, limits, path).read();
}

}  // namespace pstrips::inline formats::gltf
