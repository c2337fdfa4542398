// What a glTF file holds in buffers besides geometry: animations, skins, the data of extensions.
// It is packed into one small buffer, and the JSON that refers to it is renumbered. The layout
// depends on nothing but the order and size of what is kept, so that reading what was written
// gives the same bytes again.

#include <algorithm>

#include "formats/gltf/document.h"
#include "formats/gltf/extensions/extension.h"
#include "formats/gltf/json.h"

namespace pstrips::inline formats::gltf {
namespace {

/// Accessors of one use share a view: a view must not mix inverse bind matrices with other data.
enum class Use : std::uint8_t { animation, skin, other, vertices, indices, none };
constexpr std::size_t kUses = 5;

struct References {
  const Document& document;
  std::vector<Use> accessor_use;
  std::vector<bool> view_kept;
  struct Place {
    json* value;
    bool is_accessor;
  };
  std::vector<Place> places;
  bool broken = false;

  void accessor(json& value, Use use) {
    if (!add(value, document.accessors.size(), true)) return;
    Use& known = accessor_use[value.get<std::size_t>()];
    known = std::min(known, use);
  }
  void view(json& value) {
    if (add(value, document.views.size(), false)) view_kept[value.get<std::size_t>()] = true;
  }

 private:
  bool add(json& value, std::size_t size, bool is_accessor) {
    if (!value.is_number_unsigned() || value.get<std::uint64_t>() >= size) {
      broken = true;
      return false;
    }
    places.push_back({&value, is_accessor});
    return true;
  }
};

void find_in_list(json& object, const char* key, References& out, const char* member, Use use) {
  const auto list = object.find(key);
  if (list == object.end() || !list->is_array()) return;
  for (json& element : *list)
    if (element.is_object() && element.contains(member)) out.accessor(element[member], use);
}

void find_in_animations(json& root, References& out) {
  const auto animations = root.find("animations");
  if (animations == root.end() || !animations->is_array()) return;
  for (json& animation : *animations) {
    if (!animation.is_object()) continue;
    find_in_list(animation, "samplers", out, "input", Use::animation);
    find_in_list(animation, "samplers", out, "output", Use::animation);
  }
}

/// What is left of geometry: primitives without positions.
void find_in_meshes(json& root, References& out) {
  const auto meshes = root.find("meshes");
  if (meshes == root.end()) return;
  for (json& mesh : *meshes)
    for (json& primitive : mesh["primitives"]) {
      if (!primitive.contains("attributes")) continue;
      for (json& accessor : primitive["attributes"]) out.accessor(accessor, Use::vertices);
      if (primitive.contains("targets"))
        for (json& target : primitive["targets"])
          for (json& accessor : target) out.accessor(accessor, Use::vertices);
      if (primitive.contains("indices")) out.accessor(primitive["indices"], Use::indices);
    }
}

/// References of an extension, as the table says or by the convention that most of them follow.
void find_in_extension(const Extension* extension, const std::string& parent, json& value,
                       References& out) {
  if (value.is_array()) {
    for (json& element : value) find_in_extension(extension, parent, element, out);
    return;
  }
  if (!value.is_object()) return;
  for (auto& [key, member] : value.items()) {
    if (key == "extras") continue;
    if (member.is_structured()) {
      find_in_extension(extension, key, member, out);
      continue;
    }
    auto reference = Reference::none;
    if (extension && extension->reference) reference = extension->reference(parent, key);
    if (reference == Reference::none) reference = conventional_reference(key);
    if (reference == Reference::accessor) out.accessor(member, Use::other);
    if (reference == Reference::view) out.view(member);
  }
}

void find_extensions(json& value, References& out) {
  if (value.is_array())
    for (json& element : value) find_extensions(element, out);
  if (!value.is_object()) return;
  for (auto& [key, member] : value.items()) {
    if (key == "extras" || !member.is_structured()) continue;
    if (key == "extensions" && member.is_object())
      for (auto& [name, extension] : member.items())
        find_in_extension(find_extension(name), "", extension, out);
    else
      find_extensions(member, out);
  }
}

/// More bytes than any memory holds; sums of two such numbers do not wrap.
constexpr std::uint64_t kTooLarge = std::uint64_t{1} << 48;

/// Once the sum is too large it stays so; keep_rest looks at it last.
std::uint64_t append(Document& document, Kept part, std::uint64_t alignment) {
  if (part.bytes > kTooLarge || document.kept_bytes > kTooLarge) {
    document.kept_bytes = 2 * kTooLarge;
    return 0;
  }
  document.kept_bytes = (document.kept_bytes + alignment - 1) / alignment * alignment;
  part.offset = document.kept_bytes;
  document.kept_bytes += part.bytes;
  document.kept.push_back(part);
  return part.offset;
}

json new_view(std::uint64_t offset, std::uint64_t bytes) {
  json view = {{"buffer", 0}, {"byteLength", bytes}};
  if (offset != 0) view["byteOffset"] = offset;
  return view;
}

/// Packs the accessors of one use into a view and places them there.
void pack_accessors(Document& document, const std::vector<Index>& kept,
                    const References& references, Use use, json& accessors, json& views) {
  std::uint64_t start = 0;
  bool empty = true;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const Accessor& accessor = document.accessors[kept[i]];
    const bool zeros = accessor.view == kNone && accessor.sparse.count == 0;
    if (references.accessor_use[kept[i]] != use || zeros || accessor.count == 0) continue;
    const std::uint64_t bytes = std::min(accessor.count, kTooLarge) * accessor.element_bytes();
    const std::uint64_t at = append(document, {true, kept[i], 0, bytes}, 4);
    if (empty) start = at;
    empty = false;
    accessors[i]["bufferView"] = views.size();
    if (at != start) accessors[i]["byteOffset"] = at - start;
  }
  if (!empty) views.push_back(new_view(start, document.kept_bytes - start));
}

}  // namespace

Result<void> keep_rest(Document& document, std::string_view skeleton) {
  json root = json::parse(skeleton);
  json old_accessors = std::move(root["accessors"]), old_views = std::move(root["bufferViews"]);
  root.erase("accessors");
  root.erase("bufferViews");

  References references{document,
                        std::vector<Use>(document.accessors.size(), Use::none),
                        std::vector<bool>(document.views.size()),
                        {}};
  find_in_animations(root, references);
  find_in_list(root, "skins", references, "inverseBindMatrices", Use::skin);
  find_in_meshes(root, references);
  find_extensions(root, references);
  if (references.broken)
    return fail(ErrorCode::corrupt, "an animation, skin or extension refers to nothing");

  std::vector<Index> kept, new_number(document.accessors.size(), kNone);
  json accessors = json::array(), views = json::array();
  for (Index i = 0; i < document.accessors.size(); ++i) {
    if (references.accessor_use[i] == Use::none) continue;
    new_number[i] = static_cast<Index>(kept.size());
    kept.push_back(i);
    json accessor = std::move(old_accessors[i]);
    for (const char* key : {"bufferView", "byteOffset", "sparse"}) accessor.erase(key);
    accessors.push_back(std::move(accessor));
  }
  for (std::size_t use = 0; use < kUses; ++use)
    pack_accessors(document, kept, references, static_cast<Use>(use), accessors, views);

  std::vector<std::size_t> new_view_number(document.views.size());
  for (Index i = 0; i < document.views.size(); ++i) {
    if (!references.view_kept[i]) continue;
    const std::uint64_t bytes = document.views[i].bytes;
    // EXT_structural_metadata requires its views at multiples of eight.
    const std::uint64_t offset = append(document, {false, i, 0, bytes}, 8);
    json view = std::move(old_views[i]);
    view.erase("byteOffset");
    view.update(new_view(offset, bytes));
    new_view_number[i] = views.size();
    views.push_back(std::move(view));
  }
  if (document.kept_bytes > kTooLarge)
    return fail(ErrorCode::over_limit, "animations, skins and extensions are too large");
  for (const auto& [value, is_accessor] : references.places) {
    const auto i = value->get<std::size_t>();
    *value = is_accessor ? new_number[i] : new_view_number[i];
  }
  if (!accessors.empty()) root["accessors"] = std::move(accessors);
  if (!views.empty()) root["bufferViews"] = std::move(views);
  document.rest = root.dump();
  return {};
}

}  // namespace pstrips::inline formats::gltf
