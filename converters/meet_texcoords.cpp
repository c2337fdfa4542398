#include "converters/meet_texcoords.h"

#include "core/texture_origin.h"

namespace pstrips::inline converters {
namespace {

double turned_in_f32(double v) { return static_cast<float>(1 - v); }

Attribute meeting(const Attribute& a, TextureOrigin origin) {
  Attribute out{a.semantic, ComponentType::f64, a.count, false, {}};
  out.data.resize(a.elements() * out.element_bytes());
  for (std::size_t i = 0; i < a.elements(); ++i)
    for (std::size_t c = 0; c < a.count; ++c) {
      double value = component(a, i, c);
      if (c == 1 && origin == TextureOrigin::lower_left) value = turned_in_f32(value);
      if (c == 1) value = turned_in_f32(turned_in_f32(value));
      set_component(out, i, c, value);
    }
  return out;
}

}  // namespace

Model with_meeting_texcoords(Model model) {
  for (Mesh& mesh : model.meshes)
    for (Attribute& attribute : mesh.wedge_attributes)
      if (is_texcoord(attribute.semantic))
        attribute = meeting(attribute, model.scene.texture_origin);
  model.scene.texture_origin = TextureOrigin::upper_left;
  return model;
}

}  // namespace pstrips::inline converters
