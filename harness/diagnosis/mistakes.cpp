#include "harness/diagnosis/mistakes.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <variant>

#include "harness/diagnosis/seen_objects.h"
#include "scenes/description/overloaded.h"

namespace photonproof::inline harness_diagnosis {
namespace {

using Bsdf = decltype(BsdfDescription::model);

SceneDescription with_material(SceneDescription scene, std::size_t shape, Bsdf model) {
  BsdfDescription bsdf;
  bsdf.model = std::move(model);
  scene.bsdfs.push_back(std::move(bsdf));
  scene.shapes[shape].bsdf = {static_cast<std::uint32_t>(scene.bsdfs.size() - 1)};
  return scene;
}

SceneDescription without(SceneDescription scene, std::size_t shape) {
  scene.shapes.erase(scene.shapes.begin() + static_cast<std::ptrdiff_t>(shape));
  return scene;
}

class Mistakes {
 public:
  Mistakes(const SceneDescription& scene, const std::vector<std::string>& names, const std::vector<bool>& visible)
      : scene_(scene), names_(names), visible_(visible) {}

  std::vector<Mistake> run() {
    for (std::size_t i = 0; i < scene_.shapes.size(); ++i) {
      const ShapeDescription& shape = scene_.shapes[i];
      if (shape.radiance) add_light(i);
      if (!visible_[i]) continue;
      add_without_shadow(i);
      if (std::holds_alternative<HeightfieldDescription>(shape.geometry)) add_water(i);
      if (!is_object(scene_, shape)) continue;
      if (look_of(scene_, shape) == Look::mirror) add_mirror(i);
      if (look_of(scene_, shape) == Look::glass) add_glass(i);
      const std::string& name = names_[i];
      add("object-missing", "the " + name + " is missing", "it is not in the scene, or no ray tests it", i,
          without(scene_, i));
    }
    add_missing_objects();
    add_hard_shadows();
    add_swapped_walls();
    add_shared_material();
    return std::move(mistakes_);
  }

 private:
  void add(std::string kind, std::string sentence, std::string cause, std::size_t shape, SceneDescription scene) {
    mistakes_.push_back({std::move(kind), std::move(sentence), std::move(cause), names_[shape], std::move(scene), {}});
    if (visible_[shape]) mistakes_.back().changes = {shape};
  }
  void add_seen(std::string kind, std::string sentence, std::string cause, std::size_t shape, Bsdf model) {
    add(std::move(kind), std::move(sentence), std::move(cause), shape, with_material(scene_, shape, std::move(model)));
    mistakes_.back().only_where_seen = {shape};
  }

  void add_mirror(std::size_t i) {
    const std::string name = "the " + names_[i];
    add_seen("mirror-diffuse", name + " is matt: it shows no reflection", "it is shaded as a diffuse surface", i,
             DiffuseDescription{RgbD(0.7)});
    add_seen("mirror-untinted", name + " is too bright: what it shows is not tinted", "its colour is not multiplied in",
             i, ConductorDescription{});
  }

  void add_glass(std::size_t i) {
    const auto& glass = std::get<DielectricDescription>(scene_.bsdfs[scene_.shapes[i].bsdf.value].model);
    const std::string name = "the " + names_[i];
    DielectricDescription black = glass;
    black.specular_transmittance = RgbD(0.0);
    add_seen("glass-black", name + " is black: no light comes through",
             "no refracted ray is traced, or depth ends inside", i, black);
    DielectricDescription dull = glass;
    dull.specular_reflectance = RgbD(0.0);
    // All of the light goes through, including the part reflected head-on.
    const double share = std::pow((glass.int_ior - glass.ext_ior) / (glass.int_ior + glass.ext_ior), 2);
    if (const auto* colour = std::get_if<RgbD>(&glass.specular_transmittance))
      dull.specular_transmittance = *colour * std::min(1 / (1 - share), 1 / max_component(*colour));
    add("glass-without-reflection", name + " reflects nothing, the lamp's image among it",
        "Fresnel's share of reflected light is left out", i, with_material(scene_, i, dull));
    mistakes_.back().rough = true;  // light transmitted at flat angles still lacks the reflected part
    add_seen("glass-opaque", name + " is opaque", "it is shaded as a diffuse surface", i,
             DiffuseDescription{RgbD(0.7)});
    DielectricDescription thin = glass;
    thin.int_ior = glass.ext_ior * 1.0001;
    add_seen("glass-unrefracted", name + " does not refract", "rays go straight through, or its index is 1", i, thin);
    DielectricDescription swapped = glass;
    std::swap(swapped.int_ior, swapped.ext_ior);
    add_seen("glass-inside-out", name + " refracts the wrong way",
             "the indices of inside and outside are exchanged: eta is inverted, or the normal is", i, swapped);
  }

  void add_water(std::size_t i) {
    const std::string name = "the " + names_[i];
    SceneDescription flat = scene_;
    std::get<HeightfieldDescription>(flat.shapes[i].geometry).amplitude *= 1e-4;
    add("water-flat", name + " is flat: it has no waves",
        "the surface is not displaced, or its normals are the plane's", i, flat);
    mistakes_.back().faint = true;
    add("water-missing", name + " is missing", "it is not in the scene, or no ray tests it", i, without(scene_, i));
    for (const double factor : {0.5, 2.0}) {
      SceneDescription other = scene_;
      auto& field = std::get<HeightfieldDescription>(other.shapes[i].geometry);
      if (!std::holds_alternative<HeightfieldNoise>(field.height)) continue;
      auto& noise = std::get<HeightfieldNoise>(field.height);
      noise.frequency_x *= factor;
      noise.frequency_y *= factor;
      add("water-waves", name + (factor > 1 ? "'s waves are too narrow" : "'s waves are too wide"),
          "the noise has another frequency", i, other);
    }
  }

  /// For one of several objects, or for thin glass such as water. A single object without a shadow is
  /// "shadows-missing".
  void add_without_shadow(std::size_t i) {
    const bool is_water = std::holds_alternative<HeightfieldDescription>(scene_.shapes[i].geometry) &&
                          look_of(scene_, scene_.shapes[i]) == Look::glass;
    std::size_t objects = 0;
    for (const ShapeDescription& shape : scene_.shapes) objects += is_object(scene_, shape) ? 1 : 0;
    if (!is_water && (!is_object(scene_, scene_.shapes[i]) || objects < 2)) return;
    mistakes_.push_back({"shadow-missing",
                         "the " + names_[i] + " casts no shadow",
                         "shadow rays pass it, as if nothing were there",
                         names_[i],
                         without(scene_, i),
                         {},
                         true});
  }

  void add_light(std::size_t i) {
    add_light_parts(i);
    std::size_t lights = scene_.emitters.size();
    for (const ShapeDescription& shape : scene_.shapes) lights += shape.radiance.has_value() ? 1 : 0;
    if (lights < 2) return;
    SceneDescription dark = scene_;
    dark.shapes[i].radiance.reset();
    add("lamp-missing", "the " + names_[i] + " gives no light", "only some of the lamps are sampled", i, dark);
  }

  /// For all visible objects, where there are several.
  void add_missing_objects() {
    std::vector<std::size_t> objects;
    std::string names;
    for (std::size_t i = 0; i < scene_.shapes.size(); ++i)
      if (visible_[i] && is_object(scene_, scene_.shapes[i])) objects.push_back(i);
    if (objects.size() < 2) return;
    for (std::size_t k = 0; k < objects.size(); ++k)
      names += (k == 0 ? "" : k + 1 == objects.size() ? " and " : ", ") + ("the " + names_[objects[k]]);
    mistakes_.push_back({"objects-missing",
                         names + " are missing",
                         "no ray finds them: the first hit is taken and not the nearest, or they are not in the scene",
                         "",
                         without_objects(scene_),
                         {}});
    mistakes_.back().changes = objects;
  }

  /// A quarter of a light, at one of its corners, with the power of the whole light.
  void add_light_parts(std::size_t i) {
    const ShapeDescription& light = scene_.shapes[i];
    if (!std::holds_alternative<RectangleDescription>(light.geometry) || !std::holds_alternative<RgbD>(*light.radiance))
      return;
    for (const double x : {-0.5, 0.5})
      for (const double y : {-0.5, 0.5}) {
        SceneDescription part = scene_;
        part.shapes[i].to_world = light.to_world * Transform::translate({x, y, 0}) * Transform::scale({0.5, 0.5, 1});
        part.shapes[i].radiance = std::get<RgbD>(*light.radiance) / 0.25;
        mistakes_.push_back({"lamp-part",
                             "light comes from a quarter of the " + names_[i] + " only, at one of its corners",
                             "places on it are drawn from 0 to 1 where its sides reach from -1 to 1",
                             names_[i],
                             std::move(part),
                             {},
                             true});
        mistakes_.back().rare = true;
      }
  }

  /// Lights of a tenth of their size with the same power.
  void add_hard_shadows() {
    SceneDescription small = scene_;
    bool any = false;
    for (ShapeDescription& shape : small.shapes) {
      if (!shape.radiance || !std::holds_alternative<RgbD>(*shape.radiance)) continue;
      if (!std::holds_alternative<RectangleDescription>(shape.geometry)) continue;
      constexpr double by = 0.1;
      shape.to_world = shape.to_world * Transform::scale({by, by, 1});
      shape.radiance = std::get<RgbD>(*shape.radiance) / (by * by);
      any = true;
    }
    if (!any) return;
    mistakes_.push_back({"hard-shadows",
                         "shadow edges hard",
                         "the lamp is sampled at one point: no soft shadows",
                         "",
                         small,
                         {},
                         true});
  }

  void add_swapped_walls() {
    for (std::size_t a = 0; a < scene_.shapes.size(); ++a)
      for (std::size_t b = a + 1; b < scene_.shapes.size(); ++b) {
        const auto is_side = [&](std::size_t i) { return names_[i] == "left wall" || names_[i] == "right wall"; };
        if (!is_side(a) || !is_side(b) || scene_.shapes[a].bsdf == scene_.shapes[b].bsdf) continue;
        SceneDescription swapped = scene_;
        std::swap(swapped.shapes[a].bsdf, swapped.shapes[b].bsdf);
        mistakes_.push_back({"walls-swapped",
                             "the colours of the left and the right wall are exchanged",
                             "left and right are mixed up in the scene, or x points the wrong way",
                             "",
                             swapped,
                             {}});
        mistakes_.back().changes = {a, b};
      }
  }

  /// The material of the first diffuse surface on all others.
  void add_shared_material() {
    std::optional<BsdfIndex> shared;
    bool differ = false;
    SceneDescription alike = scene_;
    std::vector<std::size_t> changed;
    for (std::size_t i = 0; i < scene_.shapes.size(); ++i) {
      const ShapeDescription& shape = scene_.shapes[i];
      if (shape.radiance || look_of(scene_, shape) != Look::diffuse) continue;
      if (!shared) shared = shape.bsdf;
      if (shape.bsdf == *shared) continue;
      differ = true;
      alike.shapes[i].bsdf = *shared;
      if (visible_[i]) changed.push_back(i);
    }
    if (!differ) return;
    mistakes_.push_back({"materials-shared",
                         "all walls have one colour",
                         "one material, the first, is used for all of them",
                         "",
                         std::move(alike),
                         {}});
    mistakes_.back().changes = std::move(changed);
  }

  const SceneDescription& scene_;
  const std::vector<std::string>& names_;
  const std::vector<bool>& visible_;
  std::vector<Mistake> mistakes_;
};

}  // namespace

bool is_object(const SceneDescription& scene, const ShapeDescription& shape) {
  if (shape.radiance) return false;
  return std::visit(
      Overloaded{[](const SphereDescription&) { return true; }, [](const CubeDescription&) { return true; },
                 [](const DiskDescription&) { return true; }, [](const CylinderDescription&) { return true; },
                 [](const MeshDescription&) { return true; }, [](const CurvesDescription&) { return true; },
                 [](const SdfGridDescription&) { return true; }, [](const EllipsoidsDescription&) { return true; },
                 [&](const RectangleDescription&) { return look_of(scene, shape) != Look::diffuse; },
                 [](const HeightfieldDescription&) { return false; }, [](const PlaneDescription&) { return false; },
                 [](const InstanceDescription&) { return false; }},
      shape.geometry);
}

SceneDescription without_objects(const SceneDescription& scene) {
  SceneDescription empty = scene;
  std::erase_if(empty.shapes, [&](const ShapeDescription& shape) { return is_object(scene, shape); });
  return empty;
}

std::vector<Mistake> mistakes_of(const SceneDescription& scene, const std::vector<std::string>& names,
                                 const std::vector<bool>& visible) {
  return Mistakes(scene, names, visible).run();
}

}  // namespace photonproof::inline harness_diagnosis
