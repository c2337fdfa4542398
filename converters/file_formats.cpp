#include "converters/file_formats.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "converters/file_io.h"
#include "core/text.h"
#include "formats/medit/medit.h"
#include "formats/obj/obj.h"
#include "formats/pstrip/text/text.h"
#include "formats/pstrip/xml/xml.h"

namespace pstrips::inline converters {
namespace {

constexpr Certainty certainty(bool holds, Certainty if_so) {
  return holds ? if_so : Certainty::none;
}

Certainty detect_ply(ByteView file) {
  const std::string_view text = as_text(file);
  return certainty(text.starts_with("ply\n") || text.starts_with("ply\r"), Certainty::signature);
}

// An OBJ has no signature, only lines that begin with its words.
Certainty detect_obj(ByteView file) { return certainty(looks_like_obj(file), Certainty::possible); }

Certainty detect_gltf(ByteView file) {
  const std::string_view text = as_text(file);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return certainty(first != text.npos && text[first] == '{', Certainty::likely);
}

Certainty detect_glb(ByteView file) {
  return certainty(as_text(file).starts_with("glTF"), Certainty::signature);
}

Certainty detect_medit(ByteView file) {
  return certainty(looks_like_medit(file), Certainty::signature);
}

Certainty detect_pstrip(ByteView file) {
  return certainty(as_text(file).starts_with("\x8aPST"), Certainty::signature);
}

Certainty detect_pstripx(ByteView file) {
  return certainty(looks_like_xml(file), Certainty::likely);
}

Certainty detect_pm(ByteView file) { return certainty(looks_like_text(file), Certainty::likely); }

using enum Feature;

constexpr Features kGltfHolds = {faces,           lines,          points,         wedges,
                                 attributes,      several_meshes, nodes,          materials,
                                 embedded_images, asset,          separate_strips};
constexpr Features kStripsHold = {
    faces,      polygons,        lines,          points, levels,    double_positions, wedges,
    attributes, face_attributes, several_meshes, nodes,  materials, embedded_images,  asset};

constexpr std::array kFormats = {
    FileFormatRow{.format = FileFormat::ply,
                  .name = "ply",
                  .title = "Stanford PLY",
                  .holds = {faces, polygons, lines, double_positions, wedges, attributes,
                            face_attributes, text_and_binary},
                  .detect = detect_ply,
                  .read = load_ply,
                  .write_model = make_ply},
    FileFormatRow{.format = FileFormat::obj,
                  .name = "obj",
                  .title = "Wavefront OBJ",
                  .holds = {faces, polygons, lines, points, double_positions, wedges,
                            several_meshes, materials},
                  .companion = ".mtl",
                  .detect = detect_obj,
                  .read = load_obj,
                  .write_model = make_obj},
    FileFormatRow{.format = FileFormat::gltf,
                  .name = "gltf",
                  .title = "glTF 2.0",
                  .holds = kGltfHolds,
                  .companion = ".bin",
                  .detect = detect_gltf,
                  .read = load_gltf,
                  .write_model = make_gltf},
    FileFormatRow{.format = FileFormat::glb,
                  .name = "glb",
                  .title = "glTF 2.0, binary",
                  .holds = kGltfHolds,
                  .detect = detect_glb,
                  .read = load_gltf,
                  .write_model = make_glb},
    FileFormatRow{.format = FileFormat::xyz,
                  .name = "xyz",
                  .title = "points in text",
                  .holds = {double_positions},
                  .read = load_xyz},
    FileFormatRow{.format = FileFormat::medit,
                  .name = "mesh",
                  .title = "MEDIT tetrahedra",
                  .holds = {tetrahedra, double_positions},
                  .detect = detect_medit},
    FileFormatRow{.format = FileFormat::pstrip,
                  .name = "pstrip",
                  .title = "progressive strips",
                  .holds = kStripsHold,
                  .is_validated = true,
                  .detect = detect_pstrip,
                  .read = load_pstrip,
                  .write_strips = make_pstrip},
    FileFormatRow{.format = FileFormat::pstripx,
                  .name = "pstripx",
                  .title = "progressive strips in XML",
                  .holds = kStripsHold,
                  .is_validated = true,
                  .detect = detect_pstripx,
                  .read = load_pstripx,
                  .write_strips = make_pstripx},
    FileFormatRow{.format = FileFormat::pm,
                  .name = "pm",
                  .title = "progressive mesh in text",
                  .holds = {faces, levels, double_positions, wedges},
                  .detect = detect_pm,
                  .read = load_pm,
                  .write_strips = make_pm},
};

constexpr bool is_in_order() {
  for (std::size_t i = 0; i < kFormats.size(); ++i)
    if (static_cast<std::size_t>(kFormats[i].format) != i) return false;
  return true;
}
static_assert(is_in_order(), "a row stands where its enumerator says");

template <class Wanted>
std::string listed(Wanted wanted) {
  std::vector<std::string_view> names;
  for (const FileFormatRow& row : kFormats)
    if (wanted(row)) names.push_back(row.name);
  std::string out;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i > 0) out += i + 1 == names.size() ? " and " : ", ";
    out += names[i];
  }
  return out;
}

}  // namespace

std::span<const FileFormatRow> file_formats() { return kFormats; }

const FileFormatRow& row_of(FileFormat format) {
  return kFormats[static_cast<std::size_t>(format)];
}

std::string_view name_of(FileFormat format) { return row_of(format).name; }

std::optional<FileFormat> format_named(std::string_view name) {
  const auto row = std::ranges::find(kFormats, name, &FileFormatRow::name);
  if (row == kFormats.end()) return std::nullopt;
  return row->format;
}

bool holds(FileFormat format, Feature feature) { return row_of(format).holds.has(feature); }

std::string readable_formats() {
  return listed([](const FileFormatRow& row) { return row.is_readable(); });
}

std::string writable_formats() {
  return listed([](const FileFormatRow& row) { return row.is_writable(); });
}

std::optional<FileFormat> format_of_path(std::string_view path) {
  const std::string extension = lower_case(std::filesystem::path(path).extension().string());
  if (extension.empty()) return std::nullopt;
  return format_named(std::string_view(extension).substr(1));
}

std::optional<FileFormat> detect_format(ByteView file, std::string_view path) {
  auto best = Certainty::none;
  std::optional<FileFormat> format;
  for (const FileFormatRow& row : kFormats)
    if (const Certainty found = row.detect ? row.detect(file) : Certainty::none; found > best) {
      best = found;
      format = row.format;
    }
  if (best == Certainty::signature) return format;
  if (const auto by_path = format_of_path(path)) return by_path;
  return format;
}

}  // namespace pstrips::inline converters
