// Encodes a tetrahedron, writes and reads the file, and wants the same mesh back; the file is kept.

#include <pstrips/pstrips.h>

#include <cstdio>
#include <cstring>
#include <fstream>

int main(int argc, char** argv) {
  const float positions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  pstrips::Model model;
  pstrips::Mesh& mesh = model.meshes.emplace_back();
  mesh.position.data.resize(sizeof positions);
  std::memcpy(mesh.position.data.data(), positions, sizeof positions);
  mesh.corners = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
  mesh.groups.resize(1);

  const auto strips = pstrips::encode(model, {.keep_order = true});
  if (!strips) return std::printf("encode: %s\n", strips.error().message.c_str()), 1;
  const auto file = pstrips::write_binary(*strips);
  if (!file) return std::printf("write: %s\n", file.error().message.c_str()), 1;
  const auto read = pstrips::read_binary(*file);
  if (!read) return std::printf("read: %s\n", read.error().message.c_str()), 1;
  const bool same = pstrips::decode(*read)->meshes == model.meshes;
  if (argc > 1)
    std::ofstream(argv[1], std::ios::binary)
        .write(reinterpret_cast<const char*>(file->data()),
               static_cast<std::streamsize>(file->size()));
  std::printf("%zu bytes, %s\n", file->size(), same ? "exact" : "different");
  return same ? 0 : 1;
}
