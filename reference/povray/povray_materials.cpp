#include "reference/povray/povray_materials.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <set>
#include <stdexcept>

#include "reference/optics/coat.h"
#include "reference/povray/povray_pigments.h"
#include "scenes/base/text_numbers.h"

namespace photonproof::inline reference_povray {
namespace {

struct Material {
  std::string explanation;
  std::string texture;   ///< text between the braces
  std::string interior;  ///< empty when there is none
  std::string before{};  ///< declarations that the texture uses
};

constexpr int kIncidences = 120;  // half of the 256 entries that a map may have

/// Cosine of incidence at a step from 0, grazing, to kIncidences, head on. Steps are equal in angle.
double cosine_of_step(int step) {
  return step == kIncidences ? 1 : std::cos(std::numbers::pi * (0.5 - 0.5 * step / kIncidences));
}

/// A texture by the angle of incidence. POV-Ray's pattern `aoi` goes from a half at grazing to 1 head on, or from a
/// half to 0, depending on the side: both are given.
std::string by_incidence_step(const std::function<std::string(int step, bool from_behind)>& texture) {
  std::string entries;
  for (int i = -kIncidences; i <= kIncidences; ++i)
    entries += "[" + format_number(0.5 + 0.5 * i / kIncidences) + " " + texture(std::abs(i), i < 0) + "]";
  return "aoi texture_map{" + entries + "}";
}

std::string by_incidence(const std::function<std::string(double cosine)>& texture) {
  return by_incidence_step([&](int step, bool) { return texture(cosine_of_step(step)); });
}

std::string mirror(const RgbD& reflectance) {
  return "pigment{rgb 0} finish{ambient 0 diffuse 0 reflection{" + sdl_rgb(reflectance) + "}}";
}

/// A filter that multiplies transmitted light by the colour.
std::string filter(const RgbD& t) {
  return "pigment{rgbf <" + format_number(t.x) + "," + format_number(t.y) + "," + format_number(t.z) + ",1>}";
}

/// A diffuse layer: light from lights follows cos^brilliance, light from radiosity ignores the brilliance.
struct CoatLayer {
  RgbD colour{0.0};
  std::string brilliance;
};

/// Layers for the light that enters the coat. POV-Ray's `brilliance` b makes the diffuse light of a light follow cos^b,
/// so the layers are powers of the cosine, some with negative pigments. Radiosity adds all layers as if light came head
/// on. One layer that lights reach only within a hundredth of a degree makes that sum the mean over all directions.
std::vector<CoatLayer> entering_layers(const Coat& coat) {
  std::vector<CoatLayer> layers;
  RgbD rest = coat.mean_crossing();
  const auto powers = crossing_by_powers(coat);
  for (std::size_t k = 0; k < powers.size(); ++k) {
    layers.push_back({powers[k], std::to_string(k + 2)});
    rest += powers[k] * -1.0;
  }
  layers.push_back({rest, "1e7"});
  return layers;
}

/// A coat's texture at a cosine of the eye's. Each layer shows through the next, which covers a thousandth. The last,
/// which POV-Ray evaluates first, is positive: POV-Ray then computes radiosity's light, which it does not do for a
/// negative one.
std::string coat_texture(const Coat& coat, const std::vector<CoatLayer>& layers, double cosine) {
  constexpr double covers = 1.0 / 1024;
  const RgbD shown = coat.base * coat.crossing(cosine);
  std::string text;
  for (std::size_t k = layers.size(); k-- > 0;) {
    const bool lowest = k == layers.size() - 1;
    const RgbD colour =
        layers[k].colour * shown * (std::pow(1 - covers, -static_cast<double>(k)) / (lowest ? 1 : covers));
    const std::string rgb = format_number(colour.x) + "," + format_number(colour.y) + "," + format_number(colour.z);
    text += "texture{pigment{rgbt <" + rgb + "," + format_number(lowest ? 0 : 1 - covers) +
            ">} finish{ambient 0 diffuse 1/Brightness brilliance " + layers[k].brilliance +
            (k == 0 ? " reflection{" + sdl_rgb(coat.mirror(cosine)) + "}" : "") + "}}";
  }
  return text;
}

struct Writer {
  const SceneDescription& scene;
  const std::string& stem;
  const BsdfDescription* self;
  PovUv uv = PovUv::flat;

  Material operator()(const DiffuseDescription& diffuse) const {
    return {"diffuse: radiance is pigment times irradiance over pi, with POV-Ray's diffuse and no ambient",
            pigment_sdl(scene, diffuse.reflectance, stem, uv) + " finish{ambient 0 diffuse 1/Brightness emission 0}",
            ""};
  }
  Material operator()(const ConductorDescription& conductor) const {
    const RgbD factor = constant(conductor.specular_reflectance);
    if (!conductor.ior)
      return {"conductor without an index: reflects the same share at every angle", mirror(factor), ""};
    const ComplexIor& ior = *conductor.ior;
    return {"conductor: Fresnel's reflectance of its complex index, a table by the angle of incidence",
            by_incidence([&](double cosine) {
              const RgbD f{fresnel_reflectance(cosine, {ior.eta.x, ior.k.x}),
                           fresnel_reflectance(cosine, {ior.eta.y, ior.k.y}),
                           fresnel_reflectance(cosine, {ior.eta.z, ior.k.z})};
              return mirror(f * factor);
            }),
            ""};
  }
  Material operator()(const DielectricDescription& glass) const {
    const double index = glass.int_ior / glass.ext_ior;
    const RgbD reflected = constant(glass.specular_reflectance);
    if (!(reflected == RgbD(1.0)))
      return {
          "dielectric that reflects other than Fresnel's share: that, and what passes, by a table of the angle on "
          "either side",
          by_incidence_step([&](int step, bool from_behind) {
            const double cosine = cosine_of_step(step), into = from_behind ? 1 / index : index;
            const bool passes = cosine > 1e-9 && 1 - cosine * cosine < into * into;
            const double share = passes ? fresnel_reflectance(cosine, into) : 1;
            return filter(constant(glass.specular_transmittance) * (1 - share)) +
                   " finish{ambient 0 diffuse 0 reflection{" + sdl_rgb(reflected * share) + "}}";
          }),
          "ior " + format_number(index)};
    // A filter multiplies what passes a surface by the pigment, once a crossing and not on total internal reflection:
    // just what specular_transmittance does.
    return {
        "dielectric: Fresnel reflection, the rest refracted and filtered by specular_transmittance at each crossing; "
        "ior is interior over exterior",
        filter(constant(glass.specular_transmittance)) +
            " finish{ambient 0 diffuse 0 reflection{0,1 fresnel on} conserve_energy}",
        "ior " + format_number(glass.int_ior / glass.ext_ior)};
  }
  Material operator()(const ThinDielectricDescription& pane) const {
    const double index = pane.int_ior / pane.ext_ior;
    return {
        "pane: both boundaries at once reflect 2F / (1 + F) and pass the rest straight on; a table by the angle of "
        "incidence",
        by_incidence([&](double cosine) {
          const double once = cosine < 1e-9 ? 1 : fresnel_reflectance(cosine, {index, 0});
          const double both = 2 * once / (1 + once);
          return filter(constant(pane.specular_transmittance) * (1 - both)) +
                 " finish{ambient 0 diffuse 0 reflection{" + sdl_rgb(constant(pane.specular_reflectance) * both) + "}}";
        }),
        ""};
  }
  Material operator()(const BlendDescription& blend) const {
    const double weight = std::get<double>(blend.weight);
    std::string before;
    const auto part = [&](BsdfIndex index) {
      const BsdfDescription& of = scene.bsdfs[index.value];
      const Material m = std::visit(Writer{scene, stem, &of, uv}, of.model);
      if (!m.before.empty()) before += (before.empty() ? "" : "\n") + m.before;
      return m.texture;
    };
    const std::string first = part(blend.first), second = part(blend.second);
    return {"blend: the mean of two textures by their weights",
            "average texture_map{[" + format_number(1 - weight) + " " + first + "][" + format_number(weight) + " " +
                second + "]}",
            "", before};
  }
  Material operator()(const PlasticDescription&) const { return coated_material(); }
  Material operator()(const LayeredDescription&) const { return coated_material(); }
  Material coated_material() const {
    // Layers instead of `average`, whose negative entries radiosity leaves out.
    const Coat coat = *coat_on(scene, *self);
    const std::vector<CoatLayer> layers = entering_layers(coat);
    const std::string name = "Coat_" + std::to_string(self - scene.bsdfs.data()) + "_";
    std::string before;
    for (int step = 0; step <= kIncidences; ++step)
      before +=
          "#declare " + name + std::to_string(step) + " = " + coat_texture(coat, layers, cosine_of_step(step)) + "\n";
    before.pop_back();
    return {
        "a diffuse base under a clear coat: light enters by a sum of powers of its cosine (brilliance); it leaves and "
        "is mirrored by a table of the eye's",
        by_incidence_step([&](int step, bool) { return name + std::to_string(step); }), "", before};
  }
  template <class Other>
  Material operator()(const Other&) const {
    throw std::logic_error("lower_scene lets no such bsdf through");
  }
};

std::size_t number_of(const PovScene& scene, const BsdfDescription& side) {
  return static_cast<std::size_t>(&side - scene.description->bsdfs.data());
}

/// Name of a side's texture. Textured sides have another one where u and v follow from a place on a round shape.
std::string name_of(const PovScene& scene, const BsdfDescription& side, PovUv uv) {
  const std::string name = "Bsdf_" + std::to_string(number_of(scene, side));
  if (uv == PovUv::flat || !is_textured(*scene.description, side)) return name;
  return name + (uv == PovUv::sphere ? "_sphere" : uv == PovUv::disk ? "_disk" : "_cylinder");
}

std::string interior_of(const PovScene& scene, const PovSurface& surface, const PovPlan& plan) {
  std::string inside;
  if (is_glass(surface)) inside = "Interior_" + std::to_string(number_of(scene, *surface.sides.front));
  if (surface.absorption) inside += " media{absorption " + sdl_rgb(*surface.absorption * (1 / plan.scale)) + "}";
  return inside.empty() ? "" : " hollow interior{" + inside + "}";
}

}  // namespace

namespace {

/// Functions of u and v for the textures that depend on them.
void write_maps(const PovScene& scene, const PovPlan& plan, SdlWriter& out) {
  const SceneDescription& description = *scene.description;
  std::set<TextureIndex> used;
  const auto add = [&](const Colour& colour) {
    if (const auto* texture = std::get_if<TextureIndex>(&colour)) used.insert(*texture);
  };
  const std::function<void(const BsdfDescription&)> add_side = [&](const BsdfDescription& side) {
    if (const auto* diffuse = std::get_if<DiffuseDescription>(&side.model)) add(diffuse->reflectance);
    for (const BsdfIndex part : nested_bsdfs(side)) add_side(description.bsdfs[part.value]);
  };
  for (const PovSurface& surface : scene.surfaces) {
    if (surface.uv_kind == PovUv::flat) continue;
    for (const BsdfDescription* side : {surface.sides.front, surface.sides.back})
      if (side) add_side(*side);
    if (surface.shape->radiance) add(*surface.shape->radiance);
  }
  for (const EmitterDescription& emitter : description.emitters)
    if (const auto* spot = std::get_if<SpotLightDescription>(&emitter.light); spot && spot->texture)
      add(*spot->texture);
  for (const TextureIndex texture : used) out.line(map_declaration(description, texture, plan.stem));
}

}  // namespace

void write_materials(const PovScene& scene, const PovPlan& plan, SdlWriter& out) {
  std::set<std::pair<std::size_t, PovUv>> used;
  for (const PovSurface& surface : scene.surfaces)
    for (const BsdfDescription* side : {surface.sides.front, surface.sides.back})
      if (side)
        used.insert({number_of(scene, *side), is_textured(*scene.description, *side) ? surface.uv_kind : PovUv::flat});
  write_maps(scene, plan, out);
  out.explain("one-sided surfaces are black from behind: their interior_texture");
  out.line("#declare Black = texture{pigment{rgb 0} finish{ambient 0 diffuse 0 emission 0}}");
  out.line("#declare Clear = texture{pigment{rgbt 1} finish{ambient 0 diffuse 0 emission 0}}");
  for (const auto& [i, uv] : used) {
    const BsdfDescription& bsdf = scene.description->bsdfs[i];
    const Material m = std::visit(Writer{*scene.description, plan.stem, &bsdf, uv}, bsdf.model);
    out.explain("bsdf '" + bsdf.id + "' of " + scene.description->where(bsdf.loc) + ": " + m.explanation);
    if (!m.before.empty()) out.line(m.before);
    out.line("#declare " + name_of(scene, bsdf, uv) + " = texture{" + m.texture + "}");
    if (!m.interior.empty()) out.line("#declare Interior_" + std::to_string(i) + " = interior{" + m.interior + "}");
  }
}

std::string placed_texture(const PovScene& scene, const PovSurface& surface, const BsdfDescription& side,
                           const PovPlan& plan) {
  std::string texture = name_of(scene, side, surface.uv_kind);
  if (is_textured(*scene.description, side)) texture += matrix_sdl(surface.uv, plan.scale);
  if (surface.sides.opacity >= 1) return texture;
  return "average texture_map{[" + format_number(surface.sides.opacity) + " " + texture + "][" +
         format_number(1 - surface.sides.opacity) + " Clear]}";
}

std::string material_of(const PovScene& scene, const PovSurface& surface, const PovPlan& plan) {
  if (surface.sides.nothing) return " texture{Clear}" + interior_of(scene, surface, plan);
  return " texture{" + placed_texture(scene, surface, *surface.sides.front, plan) + "}" + back_of(scene, surface, plan);
}

std::string light_texture(const PovScene& scene, const PovSurface& surface, const PovPlan& plan) {
  const double shown = plan.shows_lights ? plan.exposure : 0;
  if (surface.emission == PovSurface::Emission::picture)
    return " texture{" + pigment_sdl(*scene.description, *surface.shape->radiance, plan.stem, surface.uv_kind) +
           " finish{ambient 0 diffuse 0 emission " + format_number(shown) + "}" + matrix_sdl(surface.uv, plan.scale) +
           "}";
  // POV-Ray multiplies emission by the pigment, so it is divided by it here; a channel that reflects nothing gets a
  // pigment too small to be seen.
  const RgbD& reflectance = surface.optics.diffuse.mean;
  const RgbD radiance = constant(*surface.shape->radiance) * shown;
  const bool black = max_component(reflectance) <= 0;
  const double least = 1e-9;
  const RgbD pigment =
      black ? RgbD(1.0)
            : RgbD{std::max(reflectance.x, least), std::max(reflectance.y, least), std::max(reflectance.z, least)};
  return " texture{pigment{" + sdl_rgb(pigment) + "} finish{ambient 0 diffuse " + (black ? "0" : "1/Brightness") +
         " emission " + sdl_rgb(radiance / pigment) + "}}";
}

std::string back_of(const PovScene& scene, const PovSurface& surface, const PovPlan& plan) {
  if (is_glass(surface)) return interior_of(scene, surface, plan);
  if (surface.clear_back) return " interior_texture{Clear} interior{ior 1}";
  if (surface.sides.back)
    return " interior_texture{" + placed_texture(scene, surface, *surface.sides.back, plan) + "}" +
           interior_of(scene, surface, plan);
  const bool pane = std::holds_alternative<ThinDielectricDescription>(surface.sides.front->model);
  if (pane) return interior_of(scene, surface, plan);
  // A masked surface is as thin from behind as it is from the front.
  const std::string black = surface.sides.opacity >= 1
                                ? "Black"
                                : "average texture_map{[" + format_number(surface.sides.opacity) + " Black][" +
                                      format_number(1 - surface.sides.opacity) + " Clear]}";
  return " interior_texture{" + black + "}" + interior_of(scene, surface, plan);
}

}  // namespace photonproof::inline reference_povray
