#include "cli/picture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "converters/placement.h"
#include "core/texture_origin.h"

namespace pstrips::cli {
namespace {

constexpr std::uint32_t kSamples = 2;  // a pixel, along each axis
constexpr std::array<float, 3> kGrey{0.6f, 0.6f, 0.62f};
constexpr double kMargin = 1.02;

Camera camera_of(const View& view, const Point& centre, double radius) {
  const double turn = view.turn * std::numbers::pi / 180, tilt = view.tilt * std::numbers::pi / 180;
  const Point toward{std::sin(turn) * std::cos(tilt), std::sin(tilt),
                     std::cos(turn) * std::cos(tilt)};
  const Point right{std::cos(turn), 0, -std::sin(turn)};
  return {right, cross(toward, right), toward, centre, radius};
}

/// A texture for each material, and one for groups that have none.
class Textures {
 public:
  Textures(const Scene& scene, std::uint32_t size, const Limits& limits) {
    all_.push_back({1, 1, {kGrey}});
    for (const Material& material : scene.materials) add(scene, material, size, limits);
  }
  Index of(Index material) const { return material == kNone ? 0 : material + 1; }
  std::span<const Texture> all() const { return all_; }

 private:
  void add(const Scene& scene, const Material& material, std::uint32_t size, const Limits& limits) {
    std::optional<Texture> image;
    if (const Index i = material.image(MapRole::base_color); i != kNone)
      image = decode_texture(scene.images[i].data, limits);
    if (!image) image = Texture{1, 1, {{1, 1, 1}}};
    // Finer texels than pixels would only flicker.
    while (image->width > size && image->width % 2 == 0 && image->height % 2 == 0)
      image = image->halved();
    for (auto& texel : image->texels)
      for (std::size_t c = 0; c < texel.size(); ++c)
        texel[c] *= static_cast<float>(std::clamp(material.base_color[c], 0.0, 1.0));
    all_.push_back(std::move(*image));
  }

  std::vector<Texture> all_;
};

/// All meshes as one.
RenderMesh triangles_of(const Model& model, const Textures& textures) {
  RenderMesh out;
  for (const Mesh& mesh : model.meshes) {
    std::vector<Index> group_texture;
    for (const Group& group : mesh.groups) group_texture.push_back(textures.of(group.material));
    const RenderMesh part = render_mesh(mesh, group_texture);
    out.corners.insert(out.corners.end(), part.corners.begin(), part.corners.end());
    out.texture.insert(out.texture.end(), part.texture.begin(), part.texture.end());
  }
  return out;
}

struct Sphere {
  Point centre{};
  double radius = 0;
};

/// Around the box of all vertices.
Sphere sphere_around(const Model& model) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  Point low{kFar, kFar, kFar}, high{-kFar, -kFar, -kFar};
  for (const Mesh& mesh : model.meshes) {
    const std::vector<double> positions = positions_as_double(mesh);
    for (std::size_t i = 0; i < positions.size(); i += 3) {
      const Point p{positions[i], positions[i + 1], positions[i + 2]};
      if (!is_finite(p)) continue;
      for (std::size_t c = 0; c < 3; ++c) {
        low[c] = std::min(low[c], p[c]);
        high[c] = std::max(high[c], p[c]);
      }
    }
  }
  return {(low + high) * 0.5, length(high - low) / 2};
}

/// The mean of the samples of each pixel.
RgbaImage image_of(const Picture& picture, const Point& toward) {
  RgbaImage out{picture.size / kSamples, picture.size / kSamples, {}};
  for (std::uint32_t y = 0; y < out.height; ++y)
    for (std::uint32_t x = 0; x < out.width; ++x) {
      std::array<float, 3> sum{};
      float covered = 0;
      for (std::uint32_t s = 0; s < kSamples * kSamples; ++s) {
        const std::size_t row = y * kSamples + s / kSamples, column = x * kSamples + s % kSamples;
        const Pixel& pixel = picture.pixels[row * picture.size + column];
        if (!pixel.is_covered()) continue;
        ++covered;
        const std::array<float, 3> colour = lit(pixel, pixel.vertex_normal, toward);
        for (std::size_t c = 0; c < 3; ++c) sum[c] += colour[c];
      }
      for (const float part : sum) out.pixels.push_back(srgb_of(covered > 0 ? part / covered : 0));
      out.pixels.push_back(
          static_cast<std::uint8_t>(std::lround(255 * covered / (kSamples * kSamples))));
    }
  return out;
}

Result<Model> placed(const Model& model, const Limits& limits) {
  std::vector<std::string> converted, dropped;
  auto out = place_meshes(model, limits, converted, dropped);
  if (!out) return tl::unexpected(out.error());
  return with_texture_origin(*out ? *std::move(*out) : model, TextureOrigin::upper_left);
}

}  // namespace

Result<RgbaImage> draw(const Model& model, const Model& box_of, const View& view,
                       const Limits& limits) {
  const auto shown = placed(model, limits);
  if (!shown) return tl::unexpected(shown.error());
  Sphere sphere = sphere_around(*shown);
  if (&box_of != &model) {
    const auto whole = placed(box_of, limits);
    if (!whole) return tl::unexpected(whole.error());
    sphere = sphere_around(*whole);
  }
  const Textures textures(shown->scene, view.size, limits);
  const RenderMesh triangles = triangles_of(*shown, textures);
  if (triangles.triangle_count() == 0 || !(sphere.radius > 0) || !std::isfinite(sphere.radius))
    return fail(ErrorCode::unsupported, "has no triangles to draw");
  const Camera camera = camera_of(view, sphere.centre, kMargin * sphere.radius);
  return image_of(render(triangles, textures.all(), camera, view.size * kSamples), camera.toward);
}

}  // namespace pstrips::cli
