// Radiance fields of volumetric primitives, as Mitsuba's integrator `volprim_rf_basic` (Condor et al. 2024, "Don't
// Splat your Gaussians"). A ray enters ellipsoids one after the other. Each is a Gaussian whose standard deviations are
// its scales. Its weight is its opacity times the Gaussian's largest value along the ray, at most `most_opaque`, even
// where another ellipsoid or surface lies before that place. Its colour is the sum of its harmonics in the ray's
// direction plus 1/2, at least 0. Weights of w_1, w_2, ... blend to the sum of c_i w_i (1 - w_1) ... (1 - w_(i-1)).
// Rays end at other surfaces, which are black as the sky is. Ellipsoids around the ray's origin are not entered.

#include "renderer/integrators/radiance_field.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/integrators/harmonics.h"
#include "renderer/scalar/scalar_passes.h"
#include "renderer/scalar/scalar_tracer.h"
#include "scenes/base/srgb.h"

namespace photonproof::inline renderer_integrators {
namespace {

namespace field_dimension {
constexpr std::uint32_t in_pixel = 0, lens = 1;
}  // namespace field_dimension

constexpr float most_opaque = 0.9999f;
constexpr float faint = 0.01f;  ///< a ray ends where no more than this part of what follows would be seen

std::size_t most_coefficients(const std::vector<Surface>& surfaces) {
  std::size_t most = 1;
  for (const Surface& surface : surfaces)
    if (const Ellipsoids* ellipsoids = ellipsoids_of(surface.geometry))
      most = std::max(most, ellipsoids->cloud->coefficients);
  return most;
}

class FieldTracer : ScalarTracer {
 public:
  FieldTracer(const Scene& scene, const RadianceFieldDescription& method, int grid)
      : ScalarTracer(scene, method, std::int64_t{scene.width} * scene.height),
        harmonics_(most_coefficients(scene.surfaces)),
        srgb_(method.srgb_primitives),
        grid_(grid) {
    for (const Surface& surface : scene.surfaces) clouds_.push_back(ellipsoids_of(surface.geometry));
  }

  Rgb sample(int x, int y, const PathSampler& draws, ScalarWork& work) const {
    const std::optional<Ray> ray =
        camera_.ray(x, y, draws, grid_, field_dimension::in_pixel, draws.two(field_dimension::lens), work.part);
    if (!ray) return Rgb(0.0f);
    ++work.rays.camera;
    const Rgb colour = blend(*ray, work);
    if (!srgb_) return colour;
    const auto linear = [](float v) { return static_cast<float>(decode_srgb(double{v})); };
    return {linear(colour.x), linear(colour.y), linear(colour.z)};
  }

 private:
  Rgb blend(const Ray& ray, ScalarWork& work) const {
    const Tracer* tracer = scene_interface_.view().tracer;
    if (tracer == nullptr) return Rgb(0.0f);  // the scene has no ellipsoids
    Harmonics::Values harmonics;
    harmonics_.evaluate(ray.direction, harmonics);
    Rgb colour(0.0f);
    float left = 1;
    std::uint32_t depth = 0;
    CloudEntries entries;
    do {
      if (depth > 0) ++work.rays.bounce;
      tracer->take_entries(ray.origin, ray.direction, entries);
      for (const CloudEntry& entry : entries.found()) {
        if (camera_.beyond_far_plane(ray.origin + ray.direction * entry.t)) return colour;
        const Ellipsoids& ellipsoids = *clouds_[entry.surface];
        const float weight = weight_of(ellipsoids, entry.ellipsoid, ray);
        colour += colour_of(*ellipsoids.cloud, entry.ellipsoid, harmonics) * (left * weight);
        left *= 1 - weight;
        if (!(left > faint) || !within(++depth + 1)) return colour;
      }
    } while (entries.advance());
    return colour;
  }

  static float weight_of(const Ellipsoids& ellipsoids, std::uint32_t i, const Ray& ray) {
    const double distance2 = ellipsoids.places[i].distance2_to_line(Vec3d(ray.origin), Vec3d(ray.direction));
    return std::min(ellipsoids.cloud->opacities[i] * static_cast<float>(std::exp(-0.5 * distance2)), most_opaque);
  }

  static Rgb colour_of(const EllipsoidCloud& cloud, std::uint32_t i, const Harmonics::Values& harmonics) {
    const Rgb* coefficient = &cloud.harmonics[i * cloud.coefficients];
    Rgb sum(0.5f);
    for (std::size_t k = 0; k < cloud.coefficients; ++k) sum += coefficient[k] * harmonics[k];
    return {std::max(sum.x, 0.0f), std::max(sum.y, 0.0f), std::max(sum.z, 0.0f)};
  }

  Harmonics harmonics_;
  bool srgb_;
  int grid_;
  std::vector<const Ellipsoids*> clouds_;  ///< of each surface; null for others
};

}  // namespace

void plan_radiance_field(const IntegratorDescription& description, Planner& planner) {
  const int most = description.limits().max_depth;
  planner.run("ellipsoids", "blended in the order in which rays enter them, " +
                                (most < 0 ? std::string("all of them") : "at most " + std::to_string(most)));
  planner.rays_one_by_one();
  planner.no_light_paths();
}

void render_radiance_field(const Scene& scene, const RenderPlan& plan, const RenderJob& job, Film& film,
                           RenderStats& stats) {
  const FieldTracer tracer(scene, std::get<RadianceFieldDescription>(plan.method.method), job.grid);
  render_samples(
      scene, job, radiance_field_stream, "blending", film, stats,
      [&](int x, int y, const PathSampler& draws, ScalarWork& work) { return tracer.sample(x, y, draws, work); });
}

}  // namespace photonproof::inline renderer_integrators
