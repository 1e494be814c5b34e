#include <cmath>
#include <filesystem>
#include <stdexcept>

#include "harness/stress/stress_scene.h"
#include "harness/stress/sweep_rows.h"

namespace photonproof::inline harness_stress {
namespace {

double ten(double k) { return std::pow(10.0, k); }

const std::vector<std::string> from_the_camera{"path", "photonmapper", "bdpt", "volpath"};
const std::vector<std::string> two_ways{"path", "bdpt"};

std::function<StressScene(double)> stage_of(const std::function<BsdfModel(double)>& model) {
  return [=](double k) { return StressScene{stress_scene_with_bsdf(model(k))}; };
}

template <class Glass>
Glass with_ior(double ior) {
  Glass glass;
  glass.ext_ior = 1;
  glass.int_ior = ior;
  return glass;
}

/// Glass of ior 1 + 10^-k is invisible.
Sweep ior_near_one(const char* feature, const std::function<BsdfModel(double)>& model) {
  Sweep sweep{feature, "ior near 1", "an ior of 1 + 10^-k", {4, 5, 6, 7, 8, 9, 12, 20}, 12, stage_of(model)};
  sweep.alike = [](double) {
    SceneDescription scene = stress_scene_with_bsdf(NullDescription{});
    return StressScene{scene};
  };
  return sweep;
}

Sweep lossless(const char* feature, const char* sweep_run, const char* measure, const std::vector<double>& heights,
               double wanted, const std::function<BsdfModel(double)>& model) {
  Sweep sweep{feature, sweep_run, measure,
              heights, wanted,    [=](double k) { return StressScene{ball_in_uniform_sky(model(k))}; }};
  sweep.radiance = 1;
  sweep.engines = from_the_camera;
  return sweep;
}

std::vector<Sweep> indices() {
  const std::vector<double> high{0.5, 1, 1.5, 2, 3, 4, 6, 9};
  Sweep rough = ior_near_one("bsdf roughdielectric", [](double k) {
    auto glass = with_ior<RoughDielectricDescription>(1 + ten(-k));
    glass.alpha_u = glass.alpha_v = 0.2;
    return glass;
  });
  rough.wanted = 6;
  return {
      ior_near_one("bsdf dielectric", [](double k) { return with_ior<DielectricDescription>(1 + ten(-k)); }),
      ior_near_one("bsdf thindielectric", [](double k) { return with_ior<ThinDielectricDescription>(1 + ten(-k)); }),
      rough,
      lossless("bsdf conductor", "high ior", "eta and k of 10^k, next to a perfect mirror from 10^3 on",
               {3, 4, 6, 9, 12, 15, 18, 30}, 30,
               [](double k) {
                 return ConductorDescription{ComplexIor{RgbD(1), RgbD(ten(k))}};
               }),
      lossless("bsdf dielectric", "high ior", "an ior of 10^k", high, 2,
               [](double k) { return with_ior<DielectricDescription>(ten(k)); }),
      lossless("bsdf thindielectric", "high ior", "an ior of 10^k", high, 2,
               [](double k) { return with_ior<ThinDielectricDescription>(ten(k)); }),
      lossless("bsdf dielectric", "low ior", "an ior of 10^-k", high, 2,
               [](double k) { return with_ior<DielectricDescription>(ten(-k)); })};
}

/// A coat that absorbs nothing loses nothing.
std::vector<Sweep> coats() {
  const auto white = [](double ior) {
    auto plastic = with_ior<PlasticDescription>(ior);
    plastic.diffuse_reflectance = RgbD(1);
    return plastic;
  };
  std::vector<Sweep> sweeps{lossless("bsdf plastic", "high ior", "an ior of 10^k", {0.5, 1, 1.5, 2, 2.5}, 2.5,
                                     [=](double k) { return white(ten(k)); }),
                            lossless("bsdf plastic", "ior near 1", "an ior of 1 + 10^-k", {3, 6, 9, 16}, 16,
                                     [=](double k) { return white(1 + ten(-k)); })};
  const auto lacquer = [](double thickness, double absorption) {
    SceneDescription scene = lit_stress_scene();
    const BsdfIndex wood = add_bsdf(scene, DiffuseDescription{RgbD(0.8)});
    LayeredDescription layer;
    layer.base = wood;
    layer.thickness = thickness;
    layer.sigma_a = RgbD(absorption);
    add_shape(scene, SphereDescription{}, standing({0, 1, 0}, 1), add_bsdf(scene, layer));
    return StressScene{scene};
  };
  const auto thickness = [&](const char* sweep_run, const char* measure, double sign) {
    sweeps.push_back({"bsdf layered",
                      sweep_run,
                      measure,
                      {6, 15, 25, 37},
                      37,
                      [=](double k) { return lacquer(ten(sign * k), 0.3 * ten(-sign * k)); },
                      [=](double) { return lacquer(1, 0.3); }});
  };
  thickness("thickness up", "10^k thick, absorbing 10^-k", 1);
  thickness("thickness down", "10^-k thick, absorbing 10^k", -1);
  for (Sweep& sweep : sweeps) sweep.engines = two_ways;
  return sweeps;
}

/// A floor that is opaque, or black, by a share of 10^-k.
std::vector<Sweep> shares() {
  const auto floor_of = [](const auto& model_of) {
    return [=](double k) {
      SceneDescription scene = stress_scene_floor();
      const BsdfIndex black = add_bsdf(scene, DiffuseDescription{RgbD(0.0)});
      scene.shapes[0].bsdf = add_bsdf(scene, model_of(scene, black, ten(-k)));
      scene.emitters.push_back({{}, "", ConstantLightDescription{}});
      return StressScene{scene};
    };
  };
  const auto mask = [](SceneDescription&, BsdfIndex black, double share) {
    return MaskDescription{.opacity = share, .nested = black};
  };
  const auto blend = [](SceneDescription& scene, BsdfIndex black, double share) {
    const BsdfIndex white = add_bsdf(scene, DiffuseDescription{RgbD(1)});
    return BlendDescription{.weight = share, .first = white, .second = black};
  };
  const std::vector<double> heights{0.5, 1, 2, 3, 6, 9, 20, 37};
  std::vector<Sweep> sweeps{
      {"bsdf mask", "opacity to 0", "a black floor of an opacity of 10^-k, in a sky", heights, 37, floor_of(mask)},
      {"bsdf blendbsdf", "weight to 0", "white with 10^-k of black, under a sky", heights, 37, floor_of(blend)}};
  for (Sweep& sweep : sweeps) {
    sweep.radiance = 1;
    sweep.factor = [](double k) { return 1 - ten(-k); };
    sweep.engines = two_ways;
  }
  return sweeps;
}

/// Slopes so steep that they are walls, and so flat that they are invisible.
std::vector<Sweep> bumps(const std::filesystem::path& assets) {
  SceneDescription base;
  for (const NamedScene& named : scenes_of_features(assets))
    if (named.first == "bsdf bumpmap") base = named.second;
  const auto bump_of = [](SceneDescription& scene) -> BumpMapDescription& {
    for (BsdfDescription& bsdf : scene.bsdfs)
      if (auto* bump = std::get_if<BumpMapDescription>(&bsdf.model)) return *bump;
    throw std::logic_error("a stage has no bumps");
  };
  const auto steep = [=](double factor) {
    SceneDescription scene = base;
    bump_of(scene).scale *= factor;
    return StressScene{scene};
  };
  Sweep walls{"bsdf bumpmap",
              "steep",
              "bumps 10^k times as high",
              {7, 9, 12, 15, 18, 20, 25, 30, 36},
              36,
              [=](double k) { return steep(ten(k)); },
              [=](double) { return steep(1e6); }};
  Sweep flat{"bsdf bumpmap",
             "flat",
             "bumps 10^-k times as high",
             {7, 9, 20, 36},
             36,
             [=](double k) { return steep(ten(-k)); },
             [=](double) { return steep(0); }};
  for (Sweep* sweep : {&walls, &flat}) sweep->engines = two_ways;
  return {walls, flat};
}

std::vector<Sweep> roughness() {
  const std::vector<double> heights{5, 6, 7, 9, 12, 20, 37};
  const auto smooth = [](const BsdfModel& model) {
    return [=](double) { return StressScene{stress_scene_with_bsdf(model)}; };
  };
  const auto row = [&](const char* feature, const std::function<BsdfModel(double)>& rough, const BsdfModel& model) {
    return Sweep{feature,         "roughness to 0", "alpha = 10^-k, against the smooth one", heights, 9,
                 stage_of(rough), smooth(model)};
  };
  // Modified Phong loses light with the cosine even where it is a mirror, so it is compared with itself.
  const auto sharp = [](double k) { return PhongDescription{ten(k), RgbD(0.0), RgbD(1.0)}; };
  Sweep phong{"bsdf phong",    "exponent up",   "an exponent of 10^k, against 10^6", {7, 8, 9, 12, 20, 37}, 9,
              stage_of(sharp), smooth(sharp(6))};
  return {row(
              "bsdf roughconductor", [](double k) { return of_roughness<RoughConductorDescription>(ten(-k)); },
              ConductorDescription{}),
          row(
              "bsdf roughdielectric", [](double k) { return of_roughness<RoughDielectricDescription>(ten(-k)); },
              DielectricDescription{}),
          row(
              "bsdf roughplastic", [](double k) { return of_roughness<RoughPlasticDescription>(ten(-k)); },
              PlasticDescription{}),
          phong};
}

/// A ball of this medium in a sky of radiance 1.
SceneDescription ball_of(const HomogeneousDescription& medium) {
  SceneDescription scene = ball_in_uniform_sky(NullDescription{});
  scene.media.push_back({{}, "fog", medium});
  scene.shapes.back().interior = MediumIndex{0};
  return scene;
}

std::vector<Sweep> albedos() {
  Sweep room{"bsdf diffuse",
             "albedo to 1",
             "a closed room of albedo 1 - 10^-k that emits 10^-k",
             {1, 2, 3, 4},
             4,
             [](double k) {
               return StressScene{closed_sphere(ten(-k), 1 - ten(-k)), 10, 10};
             }};
  room.radiance = 1;
  room.takes_long = true;
  Sweep fog{"medium homogeneous",
            "optical depth",
            "10^k through a ball of albedo 1",
            {-30, -9, -6, -3, 0, 1, 1.5, 2, 3, 6, 7, 8},
            6,
            [](double k) {
              return StressScene{ball_of({RgbD(ten(k) / 2), RgbD(1.0), 1, {}}), 10, 10};
            }};
  // The optical depth is 4 through the middle, where paths scatter a few times: at most some 10^-k is lost.
  Sweep pale{
      "medium homogeneous", "albedo to 1", "an albedo of 1 - 10^-k", {3, 4, 5, 6, 7, 9, 12, 16}, 16, [](double k) {
        return StressScene{ball_of({RgbD(2), RgbD(1 - ten(-k)), 1, {}}), 16, 16};
      }};
  for (Sweep* sweep : {&fog, &pale}) sweep->radiance = 1;
  fog.takes_long = true;
  // Light that scatters straight on behaves like unscattered light.
  const auto ball = [](double sigma_t, double albedo, double g) {
    SceneDescription scene = ball_of({RgbD(sigma_t), RgbD(albedo), 1, HenyeyGreensteinDescription{g}});
    scene.emitters.push_back({{}, "", DirectionalLightDescription{{0.3, -1, 0.2}, RgbD(1)}});
    return StressScene{scene, 16, 16};
  };
  Sweep forward{"medium homogeneous",
                "forward",
                "a mean cosine of 1 - 10^-k",
                {4, 5, 6, 7, 8, 9, 12, 15},
                15,
                [=](double k) { return ball(2, 0.5, 1 - ten(-k)); },
                [=](double) { return ball(1, 0, 0); }};
  std::vector<Sweep> sweeps{room, fog, pale, forward};
  for (std::size_t i = 1; i < sweeps.size(); ++i) sweeps[i].engines = {"volpath"};
  return sweeps;
}

/// A checkerboard and a bitmap moved by whole periods of uv.
std::vector<Sweep> textures(const std::filesystem::path& assets) {
  std::vector<Sweep> sweeps;
  for (const NamedScene& named : scenes_of_features(assets)) {
    if (named.first != "texture bitmap" && named.first != "bsdf diffuse") continue;
    const SceneDescription base = named.second;
    const bool bitmap = named.first == "texture bitmap";
    sweeps.push_back({bitmap ? "texture bitmap" : "texture checkerboard",
                      "moved uv",
                      "moved by 2^k of its periods",
                      {4, 8, 12, 16, 20, 23, 26, 30, 60},
                      20,
                      [=](double k) {
                        SceneDescription scene = base;
                        std::visit(
                            [&](auto& pattern) {
                              if constexpr (requires { pattern.to_uv; })
                                pattern.to_uv = Transform::translate({std::exp2(k), std::exp2(k), 0}) * pattern.to_uv;
                            },
                            scene.textures[bitmap ? 1 : 0].pattern);
                        return StressScene{scene};
                      },
                      [=](double) { return StressScene{base}; }});
  }
  return sweeps;
}

}  // namespace

std::vector<Sweep> material_sweeps(const std::filesystem::path& assets) {
  std::vector<Sweep> sweeps = indices();
  for (const std::vector<Sweep>& more : {coats(), shares(), bumps(assets), roughness(), albedos(), textures(assets)})
    sweeps.insert(sweeps.end(), more.begin(), more.end());
  return sweeps;
}

}  // namespace photonproof::inline harness_stress
