#include "renderer/planning/scene_facts.h"

#include <algorithm>
#include <array>
#include <bit>
#include <variant>

#include "renderer/light_sampling/scene_lights.h"
#include "renderer/sensor/negative_lobes.h"

namespace photonproof::inline renderer_planning {
namespace {

/// The lobes of a BSDF share [0,1) among them: its ends give every delta lobe of the kinds there are.
bool has_delta_lobe(const Bsdf& bsdf) {
  return std::visit(
      [](const auto& record) {
        const auto is_delta_at = [&](float u_lobe) {
          return record.sample(Vec3f(0, 0, 1), u_lobe, {0.5f, 0.5f}, TransportMode::radiance).delta;
        };
        return is_delta_at(0.0f) || is_delta_at(1 - 0x1p-24f);
      },
      bsdf);
}

/// A textured reflectance counts as one that is not black everywhere.
bool reflects_diffusely(const SceneParts& scene, const Surface& surface) {
  return scene.bsdfs.any_leaf(surface.bsdf, [](const Bsdf& leaf, bool textured) {
    return std::visit(
        [&]<class Record>(const Record& record) {
          if constexpr (Record::is_lambertian)
            return textured || max_component(record.reflectance) > 0;
          else
            return false;
        },
        leaf);
  });
}

/// Whether only the front is lit: rays from behind see nothing of it.
bool is_one_sided(const SceneParts& scene, const Surface& surface) { return scene.bsdfs.is_leaf(surface.bsdf); }

/// Whether some point of `other` may lie in front of the quad. Corners decide for a quad, the nearest point for a
/// sphere; anything else is taken to have one.
bool has_part_in_front(const Quad& quad, const Surface& other) {
  const auto height = [&](const Vec3f& p) { return dot(quad.normal, p - quad.corner); };
  if (const auto* sphere = std::get_if<Sphere>(&other.geometry))
    return dot(Vec3d(quad.normal), sphere->center - Vec3d(quad.corner)) + sphere->radius > 0;
  if (!std::holds_alternative<Quad>(other.geometry)) return true;
  const auto& q = std::get<Quad>(other.geometry);
  const std::array<Vec3f, 4> corners{q.corner, q.corner + q.edge_u, q.corner + q.edge_v,
                                     q.corner + q.edge_u + q.edge_v};
  const float extent = std::max(length(q.corner - quad.corner), length(q.edge_u) + length(q.edge_v));
  return std::any_of(corners.begin(), corners.end(), [&](const Vec3f& p) { return height(p) > 1e-6f * extent; });
}

bool faces(const SceneParts& scene, const Surface& surface, const Surface& other) {
  const auto* quad = std::get_if<Quad>(&surface.geometry);
  return quad == nullptr || !is_one_sided(scene, surface) || has_part_in_front(*quad, other);
}

bool sees_itself(const SceneParts& scene, const Surface& surface) {
  const bool both_sides = !is_one_sided(scene, surface);
  return std::visit([&](const auto& shape) { return shape.sees_itself(both_sides); }, surface.geometry);
}

bool can_interreflect(const SceneParts& scene, const std::vector<const Surface*>& diffuse) {
  constexpr std::size_t pairs_worth_testing = 1000;  // beyond, the answer is hardly ever no
  if (diffuse.size() > pairs_worth_testing) return true;
  for (std::size_t i = 0; i < diffuse.size(); ++i) {
    if (sees_itself(scene, *diffuse[i])) return true;
    for (std::size_t j = 0; j < i; ++j)
      if (faces(scene, *diffuse[i], *diffuse[j]) && faces(scene, *diffuse[j], *diffuse[i])) return true;
  }
  return false;
}

}  // namespace

SceneFacts analyse(const SceneParts& scene) {
  SceneFacts facts;
  facts.primitives = scene.primitives;
  facts.subtracted_by_filter = NegativeLobes(scene.filter, scene.sample_border, scene.width, scene.height).subtracted();
  facts.simple_primitives = scene.simple_primitives;
  facts.bsdf_kinds = static_cast<std::size_t>(std::popcount(scene.bsdf_kinds));
  facts.media = scene.media.media.size();
  facts.lights = scene.lights.size();
  facts.many_lights = scene.light_probabilities.empty() && SceneLights::wants_tree(scene.lights);
  facts.lights_can_be_hit = scene.lights_can_be_hit;
  for (const Light& light : scene.lights) {
    facts.any_delta_light = facts.any_delta_light || is_delta(light);
    facts.any_environment = facts.any_environment || std::holds_alternative<EnvironmentLight>(light);
  }
  std::vector<const Surface*> diffuse;
  for (const Surface& surface : scene.surfaces) {
    facts.any_delta_bsdf = facts.any_delta_bsdf ||
                           scene.bsdfs.any_leaf(surface.bsdf, [](const Bsdf& leaf, bool) { return !has_smooth(leaf); });
    facts.any_delta_lobe = facts.any_delta_lobe || scene.bsdfs.any_leaf(surface.bsdf, [](const Bsdf& leaf, bool) {
      return has_delta_lobe(leaf);
    });
    if (scene.bsdfs.is_specular(surface.bsdf)) ++facts.specular_surfaces;
    facts.any_rough = facts.any_rough ||
                      scene.bsdfs.any_leaf(surface.bsdf, [](const Bsdf& leaf, bool) { return can_be_rough(leaf); });
    facts.any_sharp = facts.any_sharp || scene.bsdfs.any_leaf(surface.bsdf, [&](const Bsdf& leaf, bool textured) {
      return !is_lambertian(leaf) && (textured || !is_all_rough(leaf, scene.rough_limit));
    });
    if (reflects_diffusely(scene, surface)) diffuse.push_back(&surface);
  }
  facts.all_plain = std::ranges::all_of(scene.plain, [](char plain) { return plain != 0; });
  facts.any_diffuse = !diffuse.empty();
  // In a mirror even one plane sees itself.
  facts.diffuse_interreflection =
      facts.any_diffuse && (facts.specular_surfaces > 0 || can_interreflect(scene, diffuse));
  return facts;
}

}  // namespace photonproof::inline renderer_planning
