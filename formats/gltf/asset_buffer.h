#pragma once

#include <map>
#include <utility>
#include <vector>

#include "core/bytes.h"
#include "formats/gltf/fit.h"
#include "formats/gltf/json.h"

namespace pstrips::inline formats::gltf {

/// The one buffer of an asset that is written, with the views and accessors into it.
class AssetBuffer {
 public:
  void reserve(std::size_t bytes) { bin_.reserve(bytes); }
  /// Takes over what a reader kept: bytes, and the lists of views and accessors into them.
  void start_with(ByteView bytes, json views, json accessors);

  /// The number of the new view or accessor.
  std::size_t add_view(ByteView bytes);
  std::size_t add_attribute(const Fitted& fitted);
  /// In the smallest type whose largest value is not used. [glTF 2.0 §3.7.2.1]
  std::size_t add_indices(const std::vector<Index>& indices);
  /// Puts the indices behind all else. To be called once, last.
  void add_index_views();

  std::size_t size() const { return bin_.size(); }
  Bytes take_bytes() { return std::move(bin_).take(); }
  json take_views() { return std::move(views_); }
  json take_accessors() { return std::move(accessors_); }

 private:
  ByteWriter bin_;
  json views_ = json::array(), accessors_ = json::array();
  std::map<ComponentType, ByteWriter> index_streams_;
  std::vector<std::pair<std::size_t, ComponentType>> index_accessors_;
};

}  // namespace pstrips::inline formats::gltf
