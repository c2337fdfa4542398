#pragma once

#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/base64.h"
#include "formats/gltf/container.h"
#include "formats/gltf/gltf.h"

namespace pstrips::test {

inline Bytes load(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string text(std::istreambuf_iterator<char>(file), {});
  const ByteView bytes = as_bytes(text);
  return Bytes(bytes.begin(), bytes.end());
}

/// Reads what stands in the folder of `model`.
inline ReadFile beside(const std::filesystem::path& model) {
  return [folder = model.parent_path()](const std::string& path) -> Result<Bytes> {
    if (!std::filesystem::is_regular_file(folder / path))
      return fail(ErrorCode::io, "no such file", kNoOffset, path);
    return load(folder / path);
  };
}

/// Reads what a writer made beside its main file.
inline ReadFile among(const std::vector<std::pair<std::string, Bytes>>& files) {
  return [&files](const std::string& path) -> Result<Bytes> {
    for (const auto& [name, content] : files)
      if (name == path) return content;
    return fail(ErrorCode::io, "no such file", kNoOffset, path);
  };
}

template <class T>
Bytes bytes_of(std::initializer_list<T> values) {
  const auto bytes = std::as_bytes(std::span(values.begin(), values.size()));
  return Bytes(bytes.begin(), bytes.end());
}

template <class T>
std::vector<T> values_of(ByteView bytes) {
  std::vector<T> out(bytes.size() / sizeof(T));
  if (!out.empty()) std::memcpy(out.data(), bytes.data(), out.size() * sizeof(T));
  return out;
}

/// A glTF file in the making: buffer views from bytes, accessors over them, and JSON.
class Asset {
 public:
  /// A view of its own; `extra` is JSON like R"(,"byteStride":8)".
  int view(ByteView bytes, const std::string& extra = "") {
    buffer_.resize((buffer_.size() + 3) / 4 * 4);
    list(views_, R"({"buffer":0,"byteOffset":)" + std::to_string(buffer_.size()) +
                     R"(,"byteLength":)" + std::to_string(bytes.size()) + extra + "}");
    buffer_.insert(buffer_.end(), bytes.begin(), bytes.end());
    return view_count_++;
  }
  /// `extra` may name a bufferView, else there is none.
  int accessor(int component_type, std::size_t count, const std::string& type,
               const std::string& extra = "") {
    list(accessors_, R"({"componentType":)" + std::to_string(component_type) + R"(,"count":)" +
                         std::to_string(count) + R"(,"type":")" + type + '"' + extra + "}");
    return accessor_count_++;
  }
  int floats(const std::string& type, std::size_t count, std::initializer_list<float> values) {
    const int v = view(bytes_of(values));
    return accessor(5126, count, type, R"(,"bufferView":)" + std::to_string(v));
  }
  int shorts(std::initializer_list<std::uint16_t> values) {
    const int v = view(bytes_of(values));
    return accessor(5123, values.size(), "SCALAR", R"(,"bufferView":)" + std::to_string(v));
  }
  /// `members` of the root object besides buffers, views and accessors.
  std::string json(const std::string& members, bool embed = true) const {
    std::string out = R"({"asset":{"version":"2.0"})";
    if (!buffer_.empty()) {
      out += R"(,"buffers":[{"byteLength":)" + std::to_string(buffer_.size());
      if (embed) out += R"(,"uri":"data:;base64,)" + base64(buffer_) + '"';
      out += "}]";
    }
    if (!views_.empty()) out += R"(,"bufferViews":[)" + views_ + "]";
    if (!accessors_.empty()) out += R"(,"accessors":[)" + accessors_ + "]";
    return out + (members.empty() ? "" : ",") + members + "}";
  }
  Bytes glb(const std::string& members) const {
    return gltf::join(json(members, false), buffer_, {}).value();
  }

 private:
  static void list(std::string& to, const std::string& element) {
    to += (to.empty() ? "" : ",") + element;
  }
  Bytes buffer_;
  std::string views_, accessors_;
  int view_count_ = 0, accessor_count_ = 0;
};

inline Result<Model> read_text(const std::string& json, const Limits& limits = {},
                               std::vector<std::string>* dropped = nullptr) {
  return read_gltf(as_bytes(json), {}, limits, dropped);
}

}  // namespace pstrips::test
