#include "formats/ply/ply_kept.h"

#include <algorithm>
#include <numeric>

namespace pstrips::inline formats::ply {
namespace {

constexpr std::string_view kHeaderKey = "ply/header", kElementsKey = "ply/elements";

std::uint64_t mix(std::uint64_t hash, std::span<const std::byte> bytes) {
  for (const std::byte b : bytes)  // FNV-1a
    hash = (hash ^ static_cast<std::uint64_t>(b)) * 0x100000001b3;
  return hash;
}

Bytes pack_columns(const Kept& kept) {
  ByteWriter out;
  out.u64(kept.digest);
  for (std::uint32_t e = 0; e < kept.header.elements.size(); ++e)
    for (std::uint32_t p = 0; p < kept.header.elements[e].properties.size(); ++p) {
      const std::size_t column = kept.header.elements[e].properties[p].kept;
      if (column == Property::kNotKept) continue;
      out.u32(e);
      out.u32(p);
      out.u64(kept.columns[column].rows);
      out.array(std::span(kept.columns[column].data.sizes));
      out.bytes(kept.columns[column].data.values);
    }
  return std::move(out).take();
}

Result<void> unpack_columns(ByteView packed, Kept& kept) {
  ByteReader in(packed);
  kept.digest = in.u64();
  while (in.remaining() != 0) {
    const std::uint32_t e = in.u32(), p = in.u32();
    KeptColumn column;
    column.rows = in.u64();
    auto& elements = kept.header.elements;
    if (in.error() || e >= elements.size() || p >= elements[e].properties.size() ||
        elements[e].properties[p].kept != Property::kNotKept)
      break;
    Property& property = elements[e].properties[p];
    std::uint64_t values = column.rows;
    if (property.is_list()) {
      column.data.sizes = in.array<std::uint32_t>(column.rows);
      values =
          std::accumulate(column.data.sizes.begin(), column.data.sizes.end(), std::uint64_t{0});
    }
    if (values > in.remaining() / size_of(property.type)) break;
    const ByteView bytes = in.take(values * size_of(property.type));
    column.data.values.assign(bytes.begin(), bytes.end());
    property.kept = kept.columns.size();
    kept.columns.push_back(std::move(column));
  }
  if (in.error() || in.remaining() != 0)
    return fail(ErrorCode::corrupt, "kept elements do not match their header", in.position(),
                std::string(kElementsKey));
  return {};
}

}  // namespace

std::uint64_t digest_of(const Mesh& mesh) {
  std::uint64_t hash = mix(0xcbf29ce484222325, mesh.position.data);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto corners = mesh.face(f);
    const auto size = static_cast<Index>(corners.size());
    hash = mix(hash, std::as_bytes(std::span(&size, 1)));
    for (const Index wedge : corners) {
      const Index vertex = mesh.vertex_of(wedge);
      hash = mix(hash, std::as_bytes(std::span(&vertex, 1)));
    }
  }
  return hash;
}

const Foreign* find_foreign(const std::vector<Foreign>& foreign, std::string_view key) {
  const auto found = std::ranges::find(foreign, key, &Foreign::key);
  return found == foreign.end() ? nullptr : &*found;
}

void put_kept(const Kept& kept, std::vector<Foreign>& foreign) {
  const std::string text = format_header(kept.header);
  const ByteView bytes = as_bytes(text);
  foreign.push_back({std::string(kHeaderKey), Bytes(bytes.begin(), bytes.end())});
  const bool any = std::ranges::any_of(kept.header.elements, [](const Element& element) {
    return std::ranges::any_of(element.properties,
                               [](const Property& p) { return p.kept != Property::kNotKept; });
  });
  if (any) foreign.push_back({std::string(kElementsKey), pack_columns(kept)});
}

Result<std::optional<Kept>> get_kept(const std::vector<Foreign>& foreign) {
  const Foreign* const text = find_foreign(foreign, kHeaderKey);
  if (text == nullptr) return std::nullopt;
  Limits limits;
  limits.string_bytes = text->data.size();
  Result<Header> header = parse_header(text->data, limits);
  if (!header || header->body != text->data.size())
    return fail(ErrorCode::corrupt, "kept header is not one", 0, std::string(kHeaderKey));
  Kept kept;
  kept.header = *std::move(header);
  if (const Foreign* const packed = find_foreign(foreign, kElementsKey)) {
    const Result<void> good = unpack_columns(packed->data, kept);
    if (!good) return tl::unexpected<Error>(good.error());
  }
  return kept;
}

}  // namespace pstrips::inline formats::ply
