#include "reference/povray/povray_plan.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "reference/optics/sky_lights.h"
#include "reference/povray/povray_lights.h"
#include "reference/povray/povray_shades.h"
#include "reference/povray/sdl_text.h"
#include "reference/povray/unrepresentable.h"
#include "scenes/description/overloaded.h"

namespace photonproof::inline reference_povray {
namespace {

constexpr int kMostBounces = 20;              // POV-Ray 3.7's limit for recursion_limit
constexpr int kBouncesTheCacheIsGoodFor = 4;  // `corridor`: +3 % to four, +61 % to seven, +117 % to all

/// Whether any of `to` is in front of `from`. Where `from` is curved the answer is yes.
bool any_in_front(const PovSurface& from, const PovSurface& to) {
  const auto* face = std::get_if<PovParallelogram>(&from.geometry);
  if (!face) return true;
  const Vec3d n = face->normal();
  const PovExtent other = extent(to);
  const double touch = 1e-9 * std::sqrt(face->area());
  return std::any_of(other.points.begin(), other.points.end(),
                     [&](const Vec3d& p) { return dot(n, p - face->corner) + other.reach > touch; });
}

bool sees_itself(const PovSurface& surface) {
  return std::visit(Overloaded{[](const PovMesh&) { return true; },  // undecided: assume yes
                               [](const PovSphere& sphere) { return sphere.inward; },
                               [](const PovRound& round) {
                                 return round.kind == PovRound::Kind::cylinder;  // through its open ends
                               },
                               [](const PovParallelogram&) { return false; }, [](const PovBox&) { return false; }},
                    surface.geometry);
}

int max_depth(const SceneDescription& scene) { return scene.integrator.limits().max_depth; }

struct Facts {
  bool diffuse = false, specular = false;
  bool spots = false;        ///< Lights written as points.
  bool surrounding = false;  ///< Lights left to radiosity.
  bool indirect = false;  ///< Light can go from diffuse surface to diffuse surface, or comes from a surrounding light.
  bool many_lights = false;  ///< The result of has_many_lights.
  double albedo = 0;         ///< The largest of any diffuse surface.
  double mean_albedo = 0;    ///< The mean of the diffuse surfaces by area, in the channel where it is largest.
};

Facts find_facts(const PovScene& scene) {
  Facts facts;
  for (const EmitterDescription& emitter : scene.description->emitters) facts.spots |= !is_sky(emitter);
  facts.spots |= scene.sky_as_lights || scene.sun;
  facts.surrounding = scene.sky && !scene.sky_as_lights;
  facts.many_lights = has_many_lights(scene);
  RgbD albedo_area(0.0);
  double diffuse_area = 0;
  for (const PovSurface& surface : scene.surfaces) {
    facts.specular |= is_specular(surface);
    facts.spots |= surface.emission == PovSurface::Emission::spots;
    facts.surrounding |= surface.emission == PovSurface::Emission::radiosity;
    if (!is_diffuse(surface)) continue;
    facts.diffuse = true;
    facts.indirect |= scene.sky && !scene.sky_as_lights;
    facts.albedo = std::max(facts.albedo, surface.optics.diffuse.greatest);
    // A surface that stands for a plane counts only the area near the rest of the scene.
    const double counted = surface.endless ? std::numbers::pi * scene.radius * scene.radius : area(surface);
    albedo_area += surface.optics.diffuse.mean * counted;
    diffuse_area += counted;
  }
  if (diffuse_area > 0) facts.mean_albedo = max_component(albedo_area) / diffuse_area;
  for (const PovSurface& from : scene.surfaces) {
    if (!is_diffuse(from)) continue;
    for (const PovSurface& to : scene.surfaces) {
      const bool relays = is_diffuse(to) || is_specular(to) || to.emission == PovSurface::Emission::radiosity;
      facts.indirect |= relays && may_see(from, to);
    }
  }
  return facts;
}

/// The power of two nearest to `x` on a logarithmic scale: multiplying by it rounds nothing.
double power_of_two(double x) { return std::exp2(std::round(std::log2(x))); }

/// Half floats keep 11 bits between 6e-5 and 65504. An estimate of the mean radiance puts it near 1, to an order of
/// magnitude: all flux spread evenly over all diffuse surfaces, bounced at the largest albedo.
double choose_exposure(const PovScene& scene, const Facts& facts) {
  double flux = 0, diffuse_area = 0, brightest = 0, surrounding = 0;
  for (const PovSurface& surface : scene.surfaces) {
    if (is_diffuse(surface) && !surface.endless) diffuse_area += area(surface);
    if (surface.emission == PovSurface::Emission::none) continue;
    const double radiance = range_of(*scene.description, *surface.shape->radiance).greatest;
    brightest = std::max(brightest, radiance);
    if (surface.emission == PovSurface::Emission::radiosity) surrounding = std::max(surrounding, radiance);
    if (surface.emission == PovSurface::Emission::spots) flux += std::numbers::pi * radiance * area(surface);
  }
  double irradiance = 0;
  for (const EmitterDescription& emitter : scene.description->emitters) {
    if (const auto* point = std::get_if<PointLightDescription>(&emitter.light))
      flux += 4 * std::numbers::pi * max_component(point->intensity);
    if (const auto* spot = std::get_if<SpotLightDescription>(&emitter.light))
      flux += 4 * std::numbers::pi * max_component(spot->intensity);
    if (const auto* ies = std::get_if<IesLightDescription>(&emitter.light))
      flux += 4 * std::numbers::pi * max_component(ies->intensity) * greatest_candela(*ies->profile);
    if (const auto* parallel = std::get_if<DirectionalLightDescription>(&emitter.light))
      irradiance += max_component(parallel->irradiance);
  }
  if (scene.sun)
    for (const SkyLight& light : sun_lights(*scene.sun, 2, 1)) irradiance += max_component(light.irradiance);
  if (scene.sky) surrounding = std::max(surrounding, max_component(mean_radiance(*scene.sky)));
  const double albedo = std::min(facts.albedo, 0.95);
  double radiance = surrounding / (1 - albedo);
  if (diffuse_area > 0) radiance += albedo / (1 - albedo) * flux / (std::numbers::pi * diffuse_area);
  radiance += albedo * irradiance / std::numbers::pi;
  if (!(radiance > 0)) radiance = brightest;
  if (!(radiance > 0) || !std::isfinite(radiance)) return 1;
  const double highest = 16384;  // for what is seen directly; a quarter of the largest half float
  return power_of_two(brightest > 0 ? std::min(1 / radiance, highest / brightest) : 1 / radiance);
}

/// Bounces after which about `fraction` of the light is missing in a closed room: albedo^(n+1) <= fraction.
int bounces_for(double albedo, double fraction) {
  if (albedo <= 0) return 1;
  if (albedo >= 1) return kMostBounces;
  return std::clamp(static_cast<int>(std::ceil(std::log(fraction) / std::log(albedo))) - 1, 1, kMostBounces);
}

/// The declared loss: that of a closed room with the mean albedo, and an upper bound for all scenes, both as shares of
/// the flux on all surfaces. An image may lose more: 1.03 % in `integrating-sphere`, which looks away from the light,
/// with a bound of 0.92 %.
std::string truncation_loss(const Facts& facts, int bounces) {
  const double about = std::pow(facts.mean_albedo, bounces + 1);
  const double most = std::pow(std::min(facts.albedo, 1.0), bounces + 1);
  const std::string start =
      "radiosity ends after " + std::to_string(bounces) + " bounces: of the light on all surfaces ";
  const std::string end = "; more where little arrives directly";
  if (facts.mean_albedo == facts.albedo)
    return start + rounded(100 * most) + " % is missing at most (albedo to the power bounces + 1)" + end;
  return start + "about " + rounded(100 * about) + " % is missing, never more than " + rounded(100 * most) +
         " % (mean and largest albedo to the power bounces + 1)" + end;
}

void plan_radiosity(PovPlan& plan, const Facts& facts, int depth) {
  // Edges before the first bounce: surface to light and eye to surface, or eye to surface for light radiosity finds.
  const int edges = facts.surrounding ? 1 : 2;
  if (!facts.spots && !facts.surrounding) {
    plan.skipped.emplace_back("radiosity: there is no light");
  } else if (!facts.indirect) {
    plan.skipped.emplace_back("radiosity: no two diffuse surfaces see each other");
  } else if (depth >= 0 && depth <= edges) {
    plan.skipped.emplace_back("radiosity: max_depth " + std::to_string(depth) + " allows no bounce");
  } else {
    plan.radiosity = true;
    plan.brightness = 2;
    // Rays see twins where there are lights, and only twins can end a path by chance.
    plan.paths = plan.preset.paths && plan.point_lights && !facts.surrounding;
    plan.recursion_limit = plan.paths ? kMostBounces : bounces_for(facts.mean_albedo, plan.preset.truncation);
    const bool ends_early = depth >= 0 && depth - edges <= plan.recursion_limit;
    if (ends_early) plan.recursion_limit = depth - edges;  // where the scene asks for it
    if (facts.many_lights && !plan.paths) {
      plan.preset.radiosity_count /= 8;  // for what they see; kLightsForRays
    } else if (plan.recursion_limit > 12 && !plan.paths) {
      // The fourth and later bounces come out low, by 1.5 % and more each, unless the cache is dense; half the rays pay
      // for it. `concentric-spheres` then has -0.48 % in 6.8 s instead of -1.01 % in 10 s, `cornell` -0.18 % in 5.2 s
      // instead of 0.17 % in 8.3 s.
      plan.preset.radiosity_count /= 2;
      plan.preset.low_error_factor = 0.3;
      plan.preset.pretrace_end *= 2;
    }
    if (!ends_early) plan.losses.push_back(truncation_loss(facts, plan.recursion_limit));
    if (plan.preset.paths && !plan.paths)
      plan.skipped.emplace_back("paths: light from all around is left to radiosity's cache");
    if (!plan.paths && plan.recursion_limit > kBouncesTheCacheIsGoodFor)
      plan.losses.push_back(
          "radiosity's cache reaches twice as far with every bounce: too bright where most light arrives after more "
          "than " +
          std::to_string(kBouncesTheCacheIsGoodFor) + (facts.surrounding ? "" : "; quality 4 follows paths instead"));
  }
}

}  // namespace

bool may_see(const PovSurface& from, const PovSurface& to) {
  if (&from == &to) return sees_itself(from);
  return any_in_front(from, to) && any_in_front(to, from);
}

PovPlan make_plan(const PovScene& scene, const PovrayOptions& options) {
  PovPlan plan;
  plan.preset = povray_preset(options.quality);
  plan.stem = options.stem;
  const Facts facts = find_facts(scene);
  plan.scale = power_of_two(64 / scene.radius);
  plan.exposure = choose_exposure(scene, facts);

  const SceneDescription& description = *scene.description;
  const int depth = max_depth(description);
  if (depth >= 0 && facts.spots && facts.surrounding)
    throw Unrepresentable(description.where(description.integrator.loc),
                          "max_depth in a scene lit both by a light around it and by others: POV-Ray counts their "
                          "bounces differently");
  if (depth >= 2 && depth < 4 && facts.specular)
    throw Unrepresentable(description.where(description.integrator.loc),
                          "max_depth " + std::to_string(depth) +
                              " with mirrors or glass: POV-Ray does not count specular bounces as part of a path");
  plan.point_lights = facts.spots && depth != 0 && depth != 1;
  plan_radiosity(plan, facts, depth);

  if (!facts.specular) {
    plan.skipped.emplace_back("photons: nothing is specular");
  } else if (!plan.point_lights) {
    plan.skipped.emplace_back("photons: no light is small; radiosity's rays find the light through specular surfaces");
  } else if (!facts.diffuse) {
    plan.skipped.emplace_back("photons: no diffuse surface to receive them");
  } else {
    plan.photons = true;
    plan.losses.emplace_back(
        "caustics are a density of photons over a disc: blurred by its radius, and 0.5 to 1.5 % low in flux");
  }
  const auto is_smooth = [](const PovSurface& surface) {
    const auto* mesh = std::get_if<PovMesh>(&surface.geometry);
    return mesh && mesh->smooth && is_glass(surface);
  };
  if (plan.photons && std::ranges::any_of(scene.surfaces, is_smooth))
    plan.losses.emplace_back(
        "photons take a mesh's interpolated normals for its own: caustics of few facets are too dark, by a tenth of a "
        "ball's of 168");
  if (plan.radiosity && plan.point_lights && lights_for_one(scene) > 1)
    plan.losses.push_back("radiosity's rays see every " + std::to_string(lights_for_one(scene)) +
                          "th of the lights, as bright as so many: a coarser pattern of indirect light");
  if (scene.sun)
    plan.losses.emplace_back("the sun's disc is not drawn: it lights, and neither camera nor mirrors see it");
  if (depth >= 0 && facts.specular)
    plan.losses.push_back("max_depth " + std::to_string(depth) + " is applied to diffuse bounces only");
  return plan;
}

}  // namespace photonproof::inline reference_povray
