#include "formats/gltf/accessors.h"

#include <algorithm>

#include "formats/gltf/container.h"
#include "formats/gltf/meshopt.h"

namespace pstrips::inline formats::gltf {
namespace {

std::string pointer(std::string_view list, std::uint64_t i) {
  return "/" + std::string(list) + "/" + std::to_string(i);
}

template <class T>
Index load(const std::byte* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

Index load_index(ComponentType type, const std::byte* at) {
  if (type == ComponentType::u8) return load<std::uint8_t>(at);
  return type == ComponentType::u16 ? load<std::uint16_t>(at) : load<std::uint32_t>(at);
}

template <class T>
void load_all(const Bytes& bytes, std::vector<Index>& out) {
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = load<T>(bytes.data() + k * sizeof(T));
}

bool is_index_type(ComponentType type) {
  return type == ComponentType::u8 || type == ComponentType::u16 || type == ComponentType::u32;
}

}  // namespace

Data::Data(Document& document, std::optional<ByteView> bin, const ReadFile& read_file,
           Budget& budget)
    : document_(document),
      bin_(bin),
      read_file_(read_file),
      budget_(budget),
      loaded_(document.buffers.size()) {}

bool Data::has_bytes(Index i) const { return document_.buffers[i].has_uri || (i == 0 && bin_); }

Result<ByteView> Data::buffer(Index i) {
  Buffer& buffer = document_.buffers[i];
  const auto located = [&](Error error) {
    if (error.path.empty()) error.path = pointer("buffers", i);
    return tl::unexpected(std::move(error));
  };
  ByteView bytes;
  if (!buffer.has_uri) {
    if (!has_bytes(i))
      return fail(ErrorCode::corrupt, "buffer without bytes", kNoOffset, pointer("buffers", i));
    bytes = *bin_;
  } else {
    if (!loaded_[i]) {
      if (is_data_uri(buffer.uri)) {
        if (!budget_.take(buffer.uri.size()))
          return located({ErrorCode::over_limit, budget_.refusal(buffer.uri.size())});
        Result<DataUri> uri = decode_data_uri(buffer.uri);
        if (!uri) return located(std::move(uri).error());
        loaded_[i] = std::move(uri->data);
        buffer.uri = {};
      } else {
        const Result<std::string> path = decode_relative_uri(buffer.uri);
        if (!path) return located(path.error());
        if (!read_file_) return located({ErrorCode::io, "no access to files beside the model"});
        Result<Bytes> file = read_file_(*path);
        if (!file) return tl::unexpected(std::move(file).error());
        if (!budget_.take(file->size()))
          return located({ErrorCode::over_limit, budget_.refusal(file->size())});
        loaded_[i] = std::move(*file);
      }
    }
    bytes = *loaded_[i];
  }
  if (bytes.size() < buffer.bytes)
    return located({ErrorCode::truncated, "buffer is shorter than its byteLength"});
  return bytes.first(buffer.bytes);
}

Result<ByteView> Data::range(Index i, std::uint64_t offset, std::uint64_t bytes) {
  const View& view = document_.views[i];
  const std::uint64_t buffer_bytes = document_.buffers[view.buffer].bytes;
  if (view.offset > buffer_bytes || view.bytes > buffer_bytes - view.offset)
    return fail(ErrorCode::corrupt, "view reaches past its buffer", kNoOffset,
                pointer("bufferViews", i));
  if (offset > view.bytes || bytes > view.bytes - offset)
    return fail(ErrorCode::corrupt, "data reaches past its view", kNoOffset,
                pointer("bufferViews", i));
  if (bytes == 0) return ByteView{};
  const bool is_decoded = view.compressed && !has_bytes(view.buffer);
  const Result<ByteView> all = is_decoded ? decoded_view(i) : buffer(view.buffer);
  if (!all) return all;
  return all->subspan(is_decoded ? offset : view.offset + offset, bytes);
}

/// As long as the view.
Result<ByteView> Data::decoded_view(Index i) {
  if (const auto known = decoded_views_.find(i); known != decoded_views_.end())
    return ByteView(known->second);
  const View& view = document_.views[i];
  const View::Compressed& in = *view.compressed;
  const std::string path = pointer("bufferViews", i);
  if (in.buffer >= document_.buffers.size())
    return fail(ErrorCode::corrupt, "meshopt compression refers to nothing", kNoOffset, path);
  if (decoded_bytes(in) < view.bytes)
    return fail(ErrorCode::corrupt, "meshopt compression of less than its view", kNoOffset, path);
  const std::uint64_t buffer_bytes = document_.buffers[in.buffer].bytes;
  if (in.offset > buffer_bytes || in.bytes > buffer_bytes - in.offset)
    return fail(ErrorCode::corrupt, "meshopt compression reaches past its buffer", kNoOffset, path);
  const Result<ByteView> all = buffer(in.buffer);
  if (!all) return all;
  if (!budget_.take(decoded_bytes(in)))
    return fail(ErrorCode::over_limit, budget_.refusal(decoded_bytes(in)), kNoOffset, path);
  Result<Bytes> decoded = decode_meshopt(in, all->subspan(in.offset, in.bytes));
  if (!decoded) return fail(decoded.error().code, decoded.error().message, kNoOffset, path);
  return ByteView(decoded_views_.emplace(i, std::move(*decoded)).first->second);
}

Result<void> Data::give(Index accessor, Bytes elements) {
  if (!budget_.take(elements.size()))
    return fail(ErrorCode::over_limit, budget_.refusal(elements.size()));
  given_.insert_or_assign(accessor, std::move(elements));
  return {};
}

Result<void> Data::copy_elements(const Accessor& accessor, Bytes& out) {
  const std::size_t element = accessor.element_bytes();
  const std::uint64_t given = document_.views[accessor.view].stride;
  const std::uint64_t stride = given == 0 ? element : given;
  if (stride < element || stride > 65536)
    return fail(ErrorCode::corrupt, "stride does not fit the element", kNoOffset,
                pointer("bufferViews", accessor.view));
  const std::uint64_t bytes = (accessor.count - 1) * stride + element;
  const Result<ByteView> in = range(accessor.view, accessor.offset, bytes);
  if (!in) return tl::unexpected(in.error());
  if (!budget_.take(accessor.count * element))
    return fail(ErrorCode::over_limit, budget_.refusal(accessor.count * element));
  out.resize(accessor.count * element);
  if (stride == element) {
    std::memcpy(out.data(), in->data(), out.size());
    return {};
  }
  for (std::size_t i = 0; i < accessor.count; ++i)
    std::memcpy(out.data() + i * element, in->data() + i * stride, element);
  return {};
}

Result<void> Data::put_sparse_values(const Accessor& accessor, Bytes& out) {
  const Accessor::Sparse& sparse = accessor.sparse;
  if (sparse.count == 0) return {};
  if (!is_index_type(sparse.index_type))
    return fail(ErrorCode::corrupt, "sparse indices are not unsigned integers");
  const std::size_t index_bytes = size_of(sparse.index_type), element = accessor.element_bytes();
  const auto indices = range(sparse.index_view, sparse.index_offset, sparse.count * index_bytes);
  if (!indices) return tl::unexpected(indices.error());
  const auto values = range(sparse.value_view, sparse.value_offset, sparse.count * element);
  if (!values) return tl::unexpected(values.error());
  std::uint64_t next = 0;
  for (std::size_t i = 0; i < sparse.count; ++i) {
    const Index at = load_index(sparse.index_type, indices->data() + i * index_bytes);
    if (at >= accessor.count) return fail(ErrorCode::corrupt, "sparse index past the elements");
    if (at < next) return fail(ErrorCode::corrupt, "sparse indices do not ascend");
    next = std::uint64_t{at} + 1;
    std::memcpy(out.data() + at * element, values->data() + i * element, element);
  }
  return {};
}

Result<Bytes> Data::elements(Index i) {
  if (const auto given = given_.find(i); given != given_.end()) return given->second;
  const Accessor& accessor = document_.accessors[i];
  Bytes out;
  const auto located = [&](Error error) {
    if (error.path.empty()) error.path = pointer("accessors", i);
    return tl::unexpected(std::move(error));
  };
  if (accessor.count == 0) return out;
  if (accessor.count > kMaxCount)
    return located(
        {ErrorCode::over_limit, over_limit_message(accessor.count, "elements", kMaxCount)});
  const std::uint64_t bytes = accessor.count * accessor.element_bytes();
  if (accessor.view == kNone) {
    if (!budget_.take_zeros(bytes))
      return located({ErrorCode::over_limit, "too many elements without bytes"});
    out.resize(bytes);
  } else if (const auto copied = copy_elements(accessor, out); !copied) {
    return located(copied.error());
  }
  if (const auto put = put_sparse_values(accessor, out); !put) return located(put.error());
  return out;
}

Result<Bytes> read_attribute(Data& data, const Document& document, Index i) {
  Result<Bytes> out = data.elements(i);
  const Accessor& accessor = document.accessors[i];
  const std::size_t column = accessor.column_bytes(), padded = accessor.padded_column_bytes();
  if (!out || !accessor.is_matrix() || column == padded) return out;
  const std::size_t columns = out->size() / padded;
  for (std::size_t k = 1; k < columns; ++k)
    std::memmove(out->data() + k * column, out->data() + k * padded, column);
  out->resize(columns * column);
  return out;
}

Result<std::vector<Index>> read_indices(Data& data, const Document& document, Index i,
                                        std::uint64_t vertices) {
  const Accessor& accessor = document.accessors[i];
  if (accessor.components != 1 || !is_index_type(accessor.type))
    return fail(ErrorCode::corrupt, "indices are not unsigned integers", kNoOffset,
                pointer("accessors", i));
  const Result<Bytes> bytes = data.elements(i);
  if (!bytes) return tl::unexpected(bytes.error());
  std::vector<Index> out(bytes->size() / size_of(accessor.type));
  if (accessor.type == ComponentType::u8)
    load_all<std::uint8_t>(*bytes, out);
  else if (accessor.type == ComponentType::u16)
    load_all<std::uint16_t>(*bytes, out);
  else
    load_all<std::uint32_t>(*bytes, out);
  const auto wrong = std::ranges::find_if(out, [&](Index index) { return index >= vertices; });
  if (wrong != out.end())
    return fail(ErrorCode::corrupt,
                "index " + std::to_string(wrong - out.begin()) + " is past the vertices", kNoOffset,
                pointer("accessors", i));
  return out;
}

}  // namespace pstrips::inline formats::gltf
