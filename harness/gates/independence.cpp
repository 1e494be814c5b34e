#include "harness/gates/independence.h"

#include <algorithm>
#include <cmath>

#include "renderer/integrators/integrator.h"

namespace photonproof::inline harness_gates {
namespace {

bool keeps(const Rendering& reference, const RgbD& mean) {
  const double stated[] = {mean.x, mean.y, mean.z};
  for (std::size_t channel = 0; channel < 3; ++channel) {
    double sum = 0, variance = 0;
    for (std::size_t i = channel; i < reference.mean.rgb.size(); i += 3) {
      sum += double{reference.mean.rgb[i]};
      variance += double{reference.variance->rgb[i]};
    }
    const auto pixels = static_cast<double>(reference.mean.pixels());
    constexpr double standard_errors = 4, digits_stated = 1e-5;
    const double margin = standard_errors * std::sqrt(variance) / pixels + digits_stated * std::abs(stated[channel]);
    if (std::abs(sum / pixels - stated[channel]) > margin) return false;
  }
  return true;
}

}  // namespace

std::optional<std::string> integrator_of(const Engine& engine) {
  if (engine.command.empty() || engine.command.front() != "{photonproof}") return std::nullopt;
  const auto option = std::find(engine.command.begin(), engine.command.end(), "--integrator");
  if (option == engine.command.end() || option + 1 == engine.command.end()) return std::nullopt;
  return *(option + 1);
}

std::string sampling_of(const std::string& integrator) {
  const Integrator* row = find_integrator(integrator);
  return row == nullptr || row->sampling == nullptr ? integrator : row->sampling;
}

bool shares_sampling(const std::string& integrator, const std::string& other) {
  return sampling_of(integrator) == sampling_of(other);
}

std::string regression_only(const Engine& engine, const StoredReference& reference,
                            const std::optional<Expect>& expect) {
  const std::optional<std::string> integrator = integrator_of(engine);
  const Provenance& provenance = reference.provenance;
  if (provenance.given && provenance.given->files.empty() && provenance.estimator == engine.name)
    return "the reference is by " + engine.name + " itself";
  if (!integrator || !shares_sampling(*integrator, provenance.estimator)) return {};
  const bool closed_form = expect && expect->analytic && expect->analytic->mean && provenance.definitions.empty();
  if (closed_form && keeps(reference.rendering, *expect->analytic->mean)) return {};
  return "the reference is by " + provenance.estimator + ", whose sampling is the engine's";
}

}  // namespace photonproof::inline harness_gates
