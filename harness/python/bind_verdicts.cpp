#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <cmath>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "harness/gates/gate_look.h"
#include "harness/metrics/metric_bounds.h"
#include "harness/metrics/metrics.h"
#include "harness/python/arrays.h"
#include "harness/python/bindings.h"
#include "harness/statistics/agreement.h"
#include "harness/statistics/batch_means.h"
#include "reference/store/provenance.h"
#include "reports/record/gate_metrics.h"
#include "scenes/base/input_error.h"

namespace nb = nanobind;

namespace photonproof::inline harness_python {
namespace {

/// Throws InputError where the images cannot be compared.
void check_pair(const Image& reference, const Image& test) {
  const std::vector<ImageDefect> defects = find_defects(reference, test);
  if (!defects.empty()) throw InputError("images", defects.front().sentence);
}

/// Throws InputError where a variance has another size than its image, or a value that is none.
void check_variance(const char* whose, const Rendering& rendering) {
  if (!rendering.variance) throw InputError(whose, "has no variance, which agreement needs");
  if (rendering.variance->width != rendering.mean.width || rendering.variance->height != rendering.mean.height)
    throw InputError(whose, "has a variance of another size than its image");
  for (const float value : rendering.variance->rgb)
    if (!(std::isfinite(value) && value >= 0)) throw InputError(whose, "has a variance that is negative or not finite");
}

void check_alpha(double alpha) {
  if (!(alpha > 0 && alpha <= 0.5)) throw InputError("alpha", "must be above 0 and at most 0.5");
}

nb::dict dict_of(const StatisticalVerdict& verdict) {
  nb::dict dict;
  dict["pass"] = verdict.pass;
  dict["observed"] = verdict.observed;
  dict["bound"] = verdict.bound;
  dict["n"] = verdict.n;
  dict["alpha"] = verdict.alpha;
  dict["sentence"] = verdict.sentence;
  return dict;
}

/// An image with the variance of its pixels, as Python has it.
using Stated = std::tuple<Pixels, std::optional<Pixels>, Metadata>;

Rendering rendering_as(const Stated& stated) {
  return rendering_of(std::get<0>(stated), std::get<1>(stated), std::get<2>(stated));
}

Values agreement(const Stated& stated_reference, const Stated& stated_test, double alpha, bool shared_noise) {
  check_alpha(alpha);
  const Rendering reference = rendering_as(stated_reference), test = rendering_as(stated_test);
  Agreement found;
  {
    const nb::gil_scoped_release released;
    check_pair(reference.mean, test.mean);
    check_variance("the first image", reference);
    check_variance("the second image", test);
    found = test_agreement(reference, test, alpha, shared_noise);
  }
  nb::dict dict;
  dict["inconclusive"] = found.inconclusive;
  dict["shared_noise"] = found.shared_noise;
  dict["would_see"] = found.would_see;
  dict["pixels"] = dict_of(found.pixels);
  dict["blocks"] = dict_of(found.blocks);
  dict["whole"] = dict_of(found.whole);
  dict["power"] = found.power_sentence();
  return dict;
}

/// Mean of the images and variance of that mean.
Parts mean_of_images(const std::vector<Pixels>& images) {
  if (images.size() < 2) throw InputError("images", "a variance needs two images or more");
  Rendering rendering;
  {
    const nb::gil_scoped_release released;
    BatchMeans means(static_cast<int>(images.front().shape(1)), static_cast<int>(images.front().shape(0)), 1);
    for (std::size_t i = 0; i < images.size(); ++i) means.add(image_of(images[i]), "image " + std::to_string(i));
    rendering = means.rendering();
  }
  return arrays_of(std::move(rendering));
}

/// The reference of a gate. `provenance` is the text of its file; without one, the variance is that of `batches`
/// images, or stated by somebody (0). An image without a variance may have any noise.
StoredReference reference_of(const Stated& stated, const std::optional<std::string>& provenance,
                             const std::string& name, std::size_t batches) {
  StoredReference reference;
  reference.rendering = rendering_as(stated);
  if (provenance) {
    reference.provenance = parse_provenance(*provenance, name);
  } else if (batches > 0) {
    reference.provenance.given.emplace();
    reference.provenance.given->noise = noise_of_images;
    reference.provenance.given->images = batches;
  } else {
    reference.provenance.given.emplace();
    reference.provenance.given->noise = reference.rendering.variance ? stated_noise : unknown_noise;
  }
  if (!reference.rendering.variance)
    reference.rendering.variance.emplace(reference.rendering.mean.width, reference.rendering.mean.height);
  check_variance("the reference", reference.rendering);
  return reference;
}

/// The row of a bound that a metric of `compare` has; the gates' own metrics have none.
void check_metric(const std::string& metric) {
  if (!weighs_noise(metric)) metric_named("metric", metric);
}

nb::dict dict_of(const Judgement& judgement) {
  nb::dict dict;
  dict["verdict"] = judgement.verdict ? to_string(*judgement.verdict) : "inconclusive";
  dict["sentence"] = judgement.sentence;
  dict["observed"] = judgement.observed.value;
  dict["interval"] =
      judgement.observed.interval
          ? nb::object(nb::make_tuple(judgement.observed.interval->low, judgement.observed.interval->high))
          : nb::none();
  dict["would_see"] = judgement.would_see;
  dict["would_see_in_a_block"] = judgement.would_see_in_a_block;
  nb::list tiles;
  for (const FailingTile& tile : judgement.tiles)
    tiles.append(nb::make_tuple(tile.x, tile.y, tile.width, tile.height, tile.score, tile.sentence));
  dict["tiles"] = tiles;
  return dict;
}

struct Bounds {
  double bound, block_bound, alpha;
};

Gate gate_of(const std::string& metric, const Bounds& bounds, int looks, std::optional<double> spp, bool unbiased) {
  check_metric(metric);
  check_alpha(bounds.alpha);
  if (looks < 1 || looks > 12) throw InputError("looks", "must be from 1 to 12");
  Gate gate;
  gate.name = gate.metric = metric;
  gate.bound = bounds.bound;
  gate.block_bound = bounds.block_bound;
  gate.alpha = bounds.alpha;
  gate.looks = looks;
  gate.unbiased = unbiased;
  if (spp) gate.budget = {"spp", *spp};
  return gate;
}

Values judge(const std::vector<Pixels>& arrays, const Stated& stated_reference,
             const std::optional<std::string>& provenance, const std::string& name, std::size_t batches,
             const std::string& metric, double bound, double block_bound, double alpha, int looks,
             std::optional<double> spp, bool unbiased, double exposure) {
  const Gate gate = gate_of(metric, {bound, block_bound, alpha}, looks, spp, unbiased);
  const StoredReference reference = reference_of(stated_reference, provenance, name, batches);
  ParameterValues viewing;
  viewing.exposure = exposure;
  if (arrays.size() < static_cast<std::size_t>(least_images))
    throw InputError("images", "a gate needs " + std::to_string(least_images) + " images or more");
  Judgement judgement;
  {
    const nb::gil_scoped_release released;
    std::vector<Image> images;
    std::vector<const Image*> pointers;
    for (const Pixels& pixels : arrays) images.push_back(image_of(pixels));
    for (const Image& image : images) {
      check_pair(reference.rendering.mean, image);
      pointers.push_back(&image);
    }
    judgement = look_at(gate, reference, viewing, pointers);
  }
  return dict_of(judgement);
}

}  // namespace

void bind_verdicts(nb::module_& module) {
  using namespace nb::literals;
  module.def("agreement", &agreement, "reference"_a, "test"_a, "alpha"_a, "shared_noise"_a);
  module.def("mean_of_images", &mean_of_images, "images"_a);
  module.def("judge", &judge, "images"_a, "reference"_a, nb::kw_only(), "provenance"_a.none(), "name"_a, "batches"_a,
             "metric"_a, "bound"_a, "block_bound"_a, "alpha"_a, "looks"_a, "spp"_a.none(), "unbiased"_a, "exposure"_a);
}

}  // namespace photonproof::inline harness_python
