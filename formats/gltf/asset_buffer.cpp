#include "formats/gltf/asset_buffer.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace pstrips::inline formats::gltf {
namespace {

int component_type(ComponentType type) {
  switch (type) {
    case ComponentType::i8:
      return 5120;
    case ComponentType::u8:
      return 5121;
    case ComponentType::i16:
      return 5122;
    case ComponentType::u16:
      return 5123;
    case ComponentType::u32:
      return 5125;
    default:
      return 5126;
  }
}

json number(double value) {
  if (value == std::floor(value) && std::abs(value) < 1e15)
    return value == 0 ? json(0) : json(static_cast<std::int64_t>(value));
  return value;
}

/// Adds min and max over the finite values; both are 0 where there is none.
void add_bounds(json& accessor, Attribute attribute) {
  attribute.normalized = false;  // bounds are of the stored numbers
  accessor["min"] = json::array();
  accessor["max"] = json::array();
  for (std::size_t c = 0; c < attribute.count; ++c) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    const bool is_float = attribute.type == ComponentType::f32;
    const std::byte* at = attribute.data.data() + c * size_of(attribute.type);
    for (std::size_t i = 0; i < attribute.elements(); ++i, at += attribute.element_bytes()) {
      float single = 0;
      if (is_float) std::memcpy(&single, at, sizeof single);
      const double value = is_float ? single : component(attribute, i, c);
      if (!std::isfinite(value)) continue;
      low = std::min(low, value);
      high = std::max(high, value);
    }
    accessor["min"].push_back(number(low <= high ? low : 0));
    accessor["max"].push_back(number(low <= high ? high : 0));
  }
}

template <class T>
std::vector<T> narrowed(const std::vector<Index>& indices) {
  std::vector<T> out(indices.size());
  std::ranges::transform(indices, out.begin(), [](Index i) { return static_cast<T>(i); });
  return out;
}

/// Elements at multiples of four bytes, as are the columns of matrices.
Bytes aligned_elements(const Attribute& attribute, std::uint8_t rows, std::size_t& stride) {
  const std::size_t column = size_of(attribute.type) * (rows == 0 ? attribute.count : rows);
  const std::size_t padded = (column + 3) / 4 * 4;
  stride = attribute.element_bytes() / column * padded;
  Bytes out(attribute.elements() * stride);
  const std::size_t columns = attribute.data.size() / column;
  for (std::size_t k = 0; k < columns; ++k)
    std::memcpy(out.data() + k * padded, attribute.data.data() + k * column, column);
  return out;
}

}  // namespace

void AssetBuffer::start_with(ByteView bytes, json views, json accessors) {
  bin_.bytes(bytes);
  bin_.align(4);
  views_ = std::move(views);
  accessors_ = std::move(accessors);
}

std::size_t AssetBuffer::add_view(ByteView bytes) {
  bin_.align(4);
  json view = {{"buffer", 0}, {"byteLength", bytes.size()}};
  if (bin_.size() > 0) view["byteOffset"] = bin_.size();
  bin_.bytes(bytes);
  views_.push_back(std::move(view));
  return views_.size() - 1;
}

std::size_t AssetBuffer::add_attribute(const Fitted& fitted) {
  const Attribute& attribute = fitted.attribute();
  json accessor = {{"componentType", component_type(attribute.type)},
                   {"count", attribute.elements()},
                   {"type", fitted.type}};
  if (attribute.normalized) accessor["normalized"] = true;
  if (fitted.needs_bounds()) add_bounds(accessor, attribute);
  if (attribute.elements() > 0) {
    std::size_t stride = attribute.element_bytes();
    const bool is_aligned = fitted.rows == 0 && stride % 4 == 0;
    const Bytes aligned = is_aligned ? Bytes{} : aligned_elements(attribute, fitted.rows, stride);
    const std::size_t view = add_view(is_aligned ? attribute.data : aligned);
    views_[view]["target"] = 34962;
    if (!is_aligned) views_[view]["byteStride"] = stride;
    accessor["bufferView"] = view;
  }
  accessors_.push_back(std::move(accessor));
  return accessors_.size() - 1;
}

std::size_t AssetBuffer::add_indices(const std::vector<Index>& indices) {
  const Index largest = indices.empty() ? 0 : *std::ranges::max_element(indices);
  const ComponentType type = largest < 0xff     ? ComponentType::u8
                             : largest < 0xffff ? ComponentType::u16
                                                : ComponentType::u32;
  json accessor = {
      {"componentType", component_type(type)}, {"count", indices.size()}, {"type", "SCALAR"}};
  if (!indices.empty()) {
    ByteWriter& stream = index_streams_[type];
    if (stream.size() > 0) accessor["byteOffset"] = stream.size();
    index_accessors_.emplace_back(accessors_.size(), type);
    if (type == ComponentType::u8)
      stream.array<std::uint8_t>(narrowed<std::uint8_t>(indices));
    else if (type == ComponentType::u16)
      stream.array<std::uint16_t>(narrowed<std::uint16_t>(indices));
    else
      stream.array<Index>(indices);
  }
  accessors_.push_back(std::move(accessor));
  return accessors_.size() - 1;
}

void AssetBuffer::add_index_views() {
  std::map<ComponentType, std::size_t> view;
  for (const auto& [type, stream] : index_streams_) {
    view[type] = add_view(stream.view());
    views_[view[type]]["target"] = 34963;
  }
  for (const auto& [accessor, type] : index_accessors_)
    accessors_[accessor]["bufferView"] = view[type];
}

}  // namespace pstrips::inline formats::gltf
