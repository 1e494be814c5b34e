// The photon mapper against path tracing on every library scene that it renders and on meshes of every kind. Means of
// images and of blocks of 8 x 8 pixels must agree, up to the radius's bias and both sides' noise.
//
// Bias. A gather averages the irradiance over its disc. Where irradiance is smooth the average is off by r^2/8 times
// its Laplacian, at a border or a kink by a multiple of r. Where it is infinite as 1/sqrt(x), as along the edges of
// caustics, it is off by a multiple of sqrt(r) at worst. So from the radius r to half of it a bias b loses between
// (1 - 1/sqrt 2) b and all of b. D is the same photons' result at r less that at r/2. So b is between D and 3.42 D, and
// the truth between L(r) - D and L(r) - 3.42 D. The bounds come from the images alone. A leak, lost light, or a map of
// 98 % does not scale with the radius, so D cannot make up for it.
//
// Noise. Pixels share photons, so blocks are less certain than their pixels' variances suggest. Every image is rendered
// with `seeds` independent seeds, and Student's t on their spread judges the differences.
//
// Both depend on the scene. The tests print their power: the minimum detectable error with probability 0.99, for the
// image's mean and, as a median, for a block.

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>

#include "renderer/integrators/check_supported.h"
#include "renderer/integrators/test_photon_scenes.h"
#include "renderer/integrators/test_scenes.h"
#include "renderer/kernels/camera_rays.h"
#include "renderer/lanes/test_chi_square.h"
#include "renderer/planning/test_compiled.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline renderer_integrators {
namespace {

constexpr int seeds = 24;
constexpr int block = 8;
const double most_of_bias = 1 / (1 - std::sqrt(0.5));

struct Effort {
  int size = 32;
  std::int64_t path_spp = 6, photon_spp = 2, photons = 16'000;  // of a seed
  const char* reference = "path";
  bool without_mirrors = false;  ///< leave out pixels that see mirrors or glass
  IndirectLight indirect = IndirectLight::map;
};

/// Pixels with a corner at which the camera sees a mirror or smooth glass.
std::vector<bool> mirror_pixels(const Scene& scene, int size) {
  std::vector<bool> mirrors(static_cast<std::size_t>(size * size));
  for (int y = 0; y <= size; ++y)
    for (int x = 0; x <= size; ++x) {
      CameraRay<float> ray;
      set_ray<float>(scene.view().camera, {static_cast<float>(x), static_cast<float>(y)}, {0.5f, 0.5f}, ray);
      const Hit hit = ray.valid ? scene.intersect(ray.origin, ray.direction) : Hit{};
      bool found = false;
      if (hit.valid())
        scene.bsdfs.for_each_leaf(scene.surfaces[hit.surface].bsdf,
                                  [&](const Bsdf& leaf, bool) { found = found || !has_smooth(leaf); });
      for (const int j : {std::max(y - 1, 0), std::min(y, size - 1)})
        for (const int i : {std::max(x - 1, 0), std::min(x, size - 1)})
          if (found) mirrors[static_cast<std::size_t>(j * size + i)] = true;
    }
  return mirrors;
}

/// Sums of a quantity over seeds, for every block and channel; the image's own means come last.
class Blocks {
 public:
  /// Pixels in `left_out` count nowhere; if it is empty, all pixels count.
  explicit Blocks(std::vector<bool> left_out) : left_out_(std::move(left_out)) {}
  void add(const Image& image, double weight, std::vector<double>& of_run) const {
    const int across = image.width / block, down = image.height / block;
    const auto values = static_cast<std::size_t>(across * down + 1) * 3;
    of_run.resize(values);
    for (int y = 0; y < down * block; ++y)
      for (int x = 0; x < across * block; ++x) {
        if (!left_out_.empty() && left_out_[static_cast<std::size_t>(y * image.width + x)]) continue;
        for (std::size_t c = 0; c < 3; ++c) {
          const double value = weight * double{image.pixel(x, y)[c]};
          of_run[static_cast<std::size_t>(y / block * across + x / block) * 3 + c] += value / (block * block);
          of_run[values - 3 + c] += value / (block * block * across * down);
        }
      }
  }
  void end_run(const std::vector<double>& of_run) {
    sum_.resize(of_run.size());
    squares_.resize(of_run.size());
    for (std::size_t i = 0; i < of_run.size(); ++i) {
      sum_[i] += of_run[i];
      squares_[i] += of_run[i] * of_run[i];
    }
  }
  std::size_t size() const { return sum_.size(); }
  double mean(std::size_t i) const { return sum_[i] / seeds; }
  double variance_of_mean(std::size_t i) const {
    return std::max(0.0, (squares_[i] - sum_[i] * sum_[i] / seeds) / (seeds - 1)) / seeds;
  }

 private:
  std::vector<bool> left_out_;
  std::vector<double> sum_, squares_;
};

struct Comparison {
  explicit Comparison(const std::vector<bool>& left_out)
      : reference(left_out), less_no_bias(left_out), less_most_bias(left_out), at_radius(left_out) {}
  Blocks reference;
  Blocks less_no_bias;  ///< the image less the least bias that the radius explains: the image at half the radius
  Blocks less_most_bias;
  Blocks at_radius;
};

Comparison compare(const SceneDescription& description, const Effort& effort) {
  const Scene scene = test::compiled(description, effort.size, effort.size);
  const auto render = [&](const IntegratorDescription& method, const RenderJob& job, RenderStats& stats) {
    Film film(effort.size, effort.size);
    test::render(scene, method, job, film, stats);
    return film.develop().mean;
  };
  const auto method = [&](const char* name) {
    IntegratorDescription of_scene = with_integrator(description.integrator, name);
    // Directly visible lights would cause most of the noise.
    std::visit([](auto& limits) { limits.hide_emitters = true; }, of_scene.method);
    return of_scene;
  };
  RenderStats stats;
  RenderJob job;
  job.sampler = SamplerKind::independent;
  // The radii are half of those that a render of 200,000 photons chooses: the bounds of above hold for narrow discs.
  IntegratorDescription photons = method("photonmapper");
  job.budget.spp = 1;
  job.budget.photons = 200'000;
  render(photons, job, stats);
  const auto radius = [&](const char* name) { return stats.counts.contains(name) ? stats.counts.at(name) : 0; };
  auto& settings = std::get<PhotonMapperDescription>(photons.method);
  settings.indirect = effort.indirect;
  settings.global_radius = radius("radius_global") / 2;
  settings.caustic_radius = radius("radius_caustic") / 2;
  IntegratorDescription at_half = photons;
  auto& halved = std::get<PhotonMapperDescription>(at_half.method);
  halved.global_radius /= 2;
  halved.caustic_radius /= 2;

  Comparison out(effort.without_mirrors ? mirror_pixels(scene, effort.size) : std::vector<bool>());
  for (int seed = 1; seed <= seeds; ++seed) {
    job.seed = static_cast<std::uint64_t>(seed);
    job.budget.photons.reset();
    job.budget.spp = effort.path_spp;
    std::vector<double> reference, least, most, own;
    out.reference.add(render(method(effort.reference), job, stats), 1, reference);
    out.reference.end_run(reference);

    job.seed += 1000;
    job.budget.spp = effort.photon_spp;
    job.budget.photons = effort.photons;
    const Image whole = render(photons, job, stats);
    const Image half = render(at_half, job, stats);
    out.at_radius.add(whole, 1, own);
    out.at_radius.end_run(own);
    out.less_no_bias.add(half, 1, least);
    out.less_no_bias.end_run(least);
    out.less_most_bias.add(whole, 1 - most_of_bias, most);
    out.less_most_bias.add(half, most_of_bias, most);
    out.less_most_bias.end_run(most);
  }
  return out;
}

/// Minimum detectable relative error of the image's mean.
double judge(const Comparison& c, const char* name) {
  const std::size_t values = c.reference.size();
  const boost::math::students_t t(seeds - 1);
  // Bounds for the image's means and for the blocks, each with half of the level.
  const auto bound_of = [&](std::size_t tests) {
    return boost::math::quantile(boost::math::complement(t, test::sidak_level(static_cast<int>(2 * tests)) / 2));
  };
  const double bound_of_mean = bound_of(3), bound_of_block = bound_of(values - 3);
  const double sure = boost::math::quantile(t, 0.99);
  double worst = 0, mean_power = 0;  // worst: in bounds
  std::size_t worst_at = 0;
  std::vector<double> powers;
  for (std::size_t i = 0; i < values; ++i) {
    const double bound = i + 3 < values ? bound_of_block : bound_of_mean;
    const double truth = c.reference.mean(i);
    const double rounding = 1e-5 * truth;
    const auto deviation = [&](const Blocks& photons) {
      const double variance = c.reference.variance_of_mean(i) + photons.variance_of_mean(i) + rounding * rounding;
      return variance > 0 ? (photons.mean(i) - truth) / std::sqrt(variance) : 0;
    };
    const double least = deviation(c.less_no_bias), most = deviation(c.less_most_bias);
    const double off = least * most < 0 ? 0 : std::min(std::abs(least), std::abs(most));
    if (off / bound > worst) {
      worst = off / bound;
      worst_at = i;
    }
    EXPECT_LE(off, bound) << name << ", value " << i << " of " << values << ": " << truth << ", photon mapper "
                          << c.at_radius.mean(i) << ", from which its radius takes to " << c.less_no_bias.mean(i)
                          << " ... " << c.less_most_bias.mean(i);
    if (!(truth > 0)) continue;
    const double noise = std::sqrt(c.reference.variance_of_mean(i) +
                                   std::max(c.less_no_bias.variance_of_mean(i), c.less_most_bias.variance_of_mean(i)));
    const double power = (std::abs(c.less_most_bias.mean(i) - c.less_no_bias.mean(i)) + (bound + sure) * noise) / truth;
    if (i + 3 >= values)
      mean_power = std::max(mean_power, power);
    else
      powers.push_back(power);
  }
  std::sort(powers.begin(), powers.end());
  const double mean = c.reference.mean(values - 2);
  std::printf(
      "%s: mean %+.2f %% at the default radius; would see %.2f %% of the mean, %.1f %% of a block; worst at %.2f "
      "of its bound (value %zu)\n",
      name, mean > 0 ? 100 * (c.at_radius.mean(values - 2) / mean - 1) : 0.0, 100 * mean_power,
      powers.empty() ? 0 : 100 * powers[powers.size() / 2], worst, worst_at);
  return mean_power;
}

std::vector<std::string> library() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(PHOTONPROOF_SOURCE_DIR "/scenes/library")) {
    const SceneDescription scene = parse_scene_file((entry.path() / "scene.xml").string());
    try {
      check_supported(scene, with_integrator(scene.integrator, "photonmapper"));
    } catch (const InputError&) {
      continue;
    }
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

class PhotonAgreement : public testing::TestWithParam<std::string> {};

TEST_P(PhotonAgreement, shows_what_path_tracing_shows) {
  Effort effort;
  // Only light paths find light from a direction or a small light through glass.
  if (GetParam() == "ball-lens" || GetParam() == "water-caustic") effort.reference = "ptracer";
  if (GetParam() == "caustic-glass" || GetParam() == "mirror-light") effort.reference = "bdpt";
  // Light paths find the caustics of points on the board and on the Phong balls. Only photons find caustics that mirror
  // and glass show.
  if (GetParam() == "whitted" || GetParam() == "whitted-orthographic") {
    effort = {.path_spp = 48, .photon_spp = 4, .photons = 96'000, .reference = "bdpt", .without_mirrors = true};
  }
  ParseOptions options;
  // Camera paths rarely find the light that the lacquered ball reflects onto the ground; light paths always do.
  if (GetParam() == "daylight") {
    effort = {.path_spp = 24, .photons = 64'000, .reference = "bdpt"};
    options.defines = {{"sun_aperture", "5"}};
  }
  // Between infinite planes, the few photons that return from afar carry much light: at two million photons the map's
  // image is uncertain by 4 %. Planes only six times as wide as their distance avoid this.
  if (GetParam() == "parallel-planes") {
    options.defines = {{"half_size", "3"}};
    effort.photons = 96'000;
  }
  // Paths have many edges among thousands of triangles: a tenth of the others' effort costs as much.
  if (GetParam() == "course-2" || GetParam() == "course-3") {
    effort.path_spp = 2;
    effort.photon_spp = 1;
    effort.photons = 4'000;
  }
  judge(
      compare(parse_scene_file(PHOTONPROOF_SOURCE_DIR "/scenes/library/" + GetParam() + "/scene.xml", options), effort),
      GetParam().c_str());
}

INSTANTIATE_TEST_SUITE_P(library, PhotonAgreement, testing::ValuesIn(library()), [](const auto& test) {
  std::string name = test.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

struct MeshCase {
  const char* name;
  SceneDescription (*scene)(int size);
};
void PrintTo(const MeshCase& c, std::ostream* out) { *out << c.name; }

class PhotonsOnMeshes : public testing::TestWithParam<MeshCase> {};

TEST_P(PhotonsOnMeshes, show_what_path_tracing_shows) {
  Effort effort;
  effort.path_spp = 24;
  effort.photons = 70'000;
  EXPECT_LE(judge(compare(GetParam().scene(effort.size), effort), GetParam().name), 0.1);
}

INSTANTIATE_TEST_SUITE_P(
    meshes, PhotonsOnMeshes,
    testing::Values(MeshCase{"slab", test::slab_from_below}, MeshCase{"twosided_slab", test::twosided_slab_from_below},
                    MeshCase{"sphere", test::mesh_sphere}, MeshCase{"boxes", test::mesh_boxes},
                    MeshCase{"textured", test::textured_mesh}, MeshCase{"heightfield", test::heightfield},
                    MeshCase{"instances", test::sheared_instances},
                    MeshCase{"cylinder_and_disk", test::cylinder_and_disk}, MeshCase{"bumped", test::bumped_mesh},
                    MeshCase{"normal_mapped", test::normal_mapped_mesh}),
    [](const auto& test) { return test.param.name; });

// One or many further bounces, in rooms that are closed, open under a sky, or hold glass, mirrors and rough metal.
class FurtherAgreement : public testing::TestWithParam<std::string> {
 protected:
  static void expect_agreement(IndirectLight indirect) {
    Effort effort{.path_spp = 96, .photon_spp = 32, .photons = 64'000, .indirect = indirect};
    judge(compare(parse_scene_file(PHOTONPROOF_SOURCE_DIR "/scenes/library/" + GetParam() + "/scene.xml"), effort),
          GetParam().c_str());
  }
};

TEST_P(FurtherAgreement, of_final_gather_and_path_tracing) { expect_agreement(IndirectLight::gather); }
TEST_P(FurtherAgreement, of_paths_beside_a_caustic_map_and_path_tracing) { expect_agreement(IndirectLight::path); }

INSTANTIATE_TEST_SUITE_P(library, FurtherAgreement, testing::Values("cornell", "cornell-spheres", "roughness"),
                         [](const auto& test) {
                           std::string name = test.param;
                           std::replace(name.begin(), name.end(), '-', '_');
                           return name;
                         });

// The slab from below against path as the radius goes to 0. At 0.01, half of the slab's thickness, a disc without tests
// could not reach the slab's lit side; at 0.2 it reaches ten times as far. At 0.01 a gather finds two photons of its
// pass's. The noise of 1e5 gathers is 0.25 %, as is the path tracer's.
TEST(photon_agreement, of_the_slab_is_within_one_percent_at_every_radius) {
  const SceneDescription slab = test::slab_from_below(32);
  const double path = test::image_mean(test::render(slab, "path", test::job_with(2048)).image.mean);
  for (const double radius : {0.01, 0.05, 0.2}) {
    SceneDescription photons = slab;
    PhotonMapperDescription settings;
    settings.max_depth = -1;
    settings.hide_emitters = true;
    settings.global_radius = radius;
    photons.integrator.method = settings;
    const double mean =
        test::image_mean(test::render(photons, "photonmapper", test::job_with(96, 2'000'000)).image.mean);
    std::printf("slab from below, radius %g: %+.2f %%\n", radius, 100 * (mean / path - 1));
    EXPECT_NEAR(mean / path, 1, 0.01) << radius;
  }
}

}  // namespace
}  // namespace photonproof::inline renderer_integrators
