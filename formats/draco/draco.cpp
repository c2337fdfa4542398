#include "formats/draco/draco.h"

#include <draco/compression/decode.h>

#include <algorithm>
#include <array>
#include <optional>

namespace pstrips::inline formats {
namespace {

constexpr std::uint8_t kPointCloud = 0, kMesh = 1;
constexpr std::uint8_t kSequential = 0;
constexpr std::uint16_t kHasMetadata = 0x8000;
/// About what the library needs for a face or a point before it has read an attribute.
constexpr std::uint64_t kBytesPerElement = 64;

struct Header {
  std::uint16_t version = 0;  ///< major * 256 + minor
  std::uint8_t type = 0, method = 0;
  std::uint16_t flags = 0;
};

/// Fields of a payload; what is missing reads as 0 and is found by the library.
class Fields {
 public:
  explicit Fields(ByteView bytes) : in_(bytes) {}

  std::optional<Header> header() {
    constexpr std::array<char, 5> kMagic = {'D', 'R', 'A', 'C', 'O'};
    for (const char c : kMagic)
      if (in_.u8() != static_cast<std::uint8_t>(c)) return std::nullopt;
    Header out;
    const std::uint8_t major = in_.u8(), minor = in_.u8();
    out.version = static_cast<std::uint16_t>(major * 256 + minor);
    out.type = in_.u8();
    out.method = in_.u8();
    out.flags = in_.u16();
    return in_.error() ? std::nullopt : std::optional(out);
  }
  /// Seven bits a byte, the lowest first.
  std::uint64_t varint() {
    std::uint64_t out = 0;
    for (unsigned shift = 0; shift < 64; shift += 7) {
      const std::uint64_t byte = in_.u8();
      out |= (byte & 0x7f) << shift;
      if ((byte & 0x80) == 0) break;
    }
    return out;
  }
  std::uint64_t count(const Header& header) {
    return header.version < 0x0202 ? in_.u32() : varint();
  }
  void skip_byte() { in_.u8(); }
  /// Names and values of a payload's metadata, and of those within it.
  void skip_metadata() {
    for (std::uint64_t n = varint(); n > 0 && !in_.error(); --n) {
      varint();  // the attribute's id
      skip_entries(0);
    }
    skip_entries(0);
  }
  bool failed() const { return in_.error().has_value(); }

 private:
  void skip_name() { in_.take(in_.u8()); }
  void skip_entries(int depth) {
    if (depth > 64) return;
    for (std::uint64_t n = varint(); n > 0 && !in_.error(); --n) {
      skip_name();
      in_.take(varint());
    }
    for (std::uint64_t n = varint(); n > 0 && !in_.error(); --n) {
      skip_name();
      skip_entries(depth + 1);
    }
  }
  ByteReader in_;
};

Result<void> check_counts(std::uint64_t points, std::uint64_t faces, const Limits& limits) {
  const auto over = [](std::uint64_t figure, std::string_view what, std::uint64_t limit) {
    return fail(ErrorCode::over_limit, over_limit_message(figure, what, limit));
  };
  const std::uint64_t most_points = std::min<std::uint64_t>(limits.wedges, kMaxCount);
  const std::uint64_t most_faces = std::min<std::uint64_t>(limits.corners, kMaxCount) / 3;
  if (points > most_points) return over(points, "Draco points", most_points);
  if (faces > most_faces) return over(faces, "Draco faces", most_faces);
  const std::uint64_t bytes = (points + faces) * kBytesPerElement;
  if (bytes > limits.memory_bytes) return over(bytes, "bytes of memory", limits.memory_bytes);
  return {};
}

/// By what the payload announces.
Result<void> check_room(ByteView payload, const Limits& limits) {
  Fields fields(payload);
  const std::optional<Header> header = fields.header();
  if (!header) return fail(ErrorCode::corrupt, "is no Draco payload", 0);
  if (header->version > 0x0202 || header->version < 0x0100)
    return fail(ErrorCode::unsupported, "Draco bitstream of another version", 5);
  if (header->flags & kHasMetadata) fields.skip_metadata();
  std::uint64_t points = 0, faces = 0;
  if (header->type == kPointCloud) {
    points = ByteReader(payload.subspan(std::min<std::size_t>(payload.size(), 11))).u32();
    if (header->flags & kHasMetadata) points = 0;  // the library reads it
  } else if (header->type != kMesh) {
    return fail(ErrorCode::corrupt, "is neither a Draco mesh nor points", 7);
  } else if (header->method == kSequential) {
    faces = fields.count(*header);
    points = fields.count(*header);
  } else {
    fields.skip_byte();  // how the traversal is coded
    if (header->version < 0x0202) fields.count(*header);
    points = fields.count(*header);
    faces = fields.count(*header);
  }
  if (fields.failed()) return fail(ErrorCode::truncated, "Draco payload ends in its header");
  return check_counts(points, faces, limits);
}

std::optional<ComponentType> type_of(draco::DataType type) {
  switch (type) {
    case draco::DT_INT8:
      return ComponentType::i8;
    case draco::DT_UINT8:
    case draco::DT_BOOL:
      return ComponentType::u8;
    case draco::DT_INT16:
      return ComponentType::i16;
    case draco::DT_UINT16:
      return ComponentType::u16;
    case draco::DT_INT32:
      return ComponentType::i32;
    case draco::DT_UINT32:
      return ComponentType::u32;
    case draco::DT_FLOAT32:
      return ComponentType::f32;
    case draco::DT_FLOAT64:
      return ComponentType::f64;
    default:
      return std::nullopt;
  }
}

DracoMeaning meaning_of(draco::GeometryAttribute::Type type) {
  switch (type) {
    case draco::GeometryAttribute::POSITION:
      return DracoMeaning::position;
    case draco::GeometryAttribute::NORMAL:
      return DracoMeaning::normal;
    case draco::GeometryAttribute::COLOR:
      return DracoMeaning::color;
    case draco::GeometryAttribute::TEX_COORD:
      return DracoMeaning::texcoord;
    default:
      return DracoMeaning::generic;
  }
}

Result<DracoAttribute> read_attribute(const draco::PointAttribute& in, Index points) {
  const auto type = type_of(in.data_type());
  if (!type || in.num_components() < 1)
    return fail(ErrorCode::unsupported, "Draco attribute of a type for which there is no other");
  DracoAttribute out{in.unique_id(), meaning_of(in.attribute_type()), {}};
  out.values = {{}, *type, static_cast<std::uint8_t>(in.num_components()), in.normalized(), {}};
  const std::size_t element = out.values.element_bytes();
  const std::size_t held = in.buffer() ? in.buffer()->data_size() : 0;
  out.values.data.resize(points * element);
  for (Index p = 0; p < points; ++p) {
    const auto value = in.mapped_index(draco::PointIndex(p));
    if (value.value() >= in.size())
      return fail(ErrorCode::corrupt, "Draco attribute with fewer values than points");
    const auto at = static_cast<std::uint64_t>(in.GetBytePos(value));
    if (at > held || element > held - at)
      return fail(ErrorCode::corrupt, "Draco attribute whose values reach past its bytes");
    std::memcpy(out.values.data.data() + p * element, in.buffer()->data() + at, element);
  }
  return out;
}

Result<DracoGeometry> read_geometry(const draco::PointCloud& in, const draco::Mesh* mesh) {
  DracoGeometry out;
  out.points = in.num_points();
  for (int a = 0; a < in.num_attributes(); ++a) {
    auto attribute = read_attribute(*in.attribute(a), out.points);
    if (!attribute) return tl::unexpected(std::move(attribute).error());
    out.attributes.push_back(std::move(*attribute));
  }
  if (!mesh) return out;
  out.triangles.reserve(std::size_t{3} * mesh->num_faces());
  for (std::uint32_t f = 0; f < mesh->num_faces(); ++f)
    for (const draco::PointIndex& corner : mesh->face(draco::FaceIndex(f))) {
      if (corner.value() >= out.points)
        return fail(ErrorCode::corrupt, "Draco face past the points");
      out.triangles.push_back(corner.value());
    }
  return out;
}

Result<DracoGeometry> decode_by_library(ByteView payload) {
  draco::DecoderBuffer buffer;
  buffer.Init(reinterpret_cast<const char*>(payload.data()), payload.size());
  draco::Decoder decoder;
  const auto type = draco::Decoder::GetEncodedGeometryType(&buffer);
  if (!type.ok()) return fail(ErrorCode::corrupt, "Draco: " + type.status().error_msg_string());
  if (type.value() == draco::POINT_CLOUD) {
    auto points = decoder.DecodePointCloudFromBuffer(&buffer);
    if (!points.ok())
      return fail(ErrorCode::corrupt, "Draco: " + points.status().error_msg_string());
    return read_geometry(*points.value(), nullptr);
  }
  auto mesh = decoder.DecodeMeshFromBuffer(&buffer);
  if (!mesh.ok()) return fail(ErrorCode::corrupt, "Draco: " + mesh.status().error_msg_string());
  return read_geometry(*mesh.value(), mesh.value().get());
}

}  // namespace

Result<DracoGeometry> decode_draco(ByteView payload, const Limits& limits) {
  if (const auto room = check_room(payload, limits); !room) return tl::unexpected(room.error());
  try {
    return decode_by_library(payload);
  } catch (const std::bad_alloc&) {
    return fail(ErrorCode::over_limit, "Draco payload that takes more memory than there is");
  } catch (const std::exception&) {
    return fail(ErrorCode::corrupt, "Draco payload of impossible sizes");
  }
}

}  // namespace pstrips::inline formats
