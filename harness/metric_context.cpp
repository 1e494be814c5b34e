#include "harness/metric_context.h"

#include <algorithm>

#include "harness/display.h"
#include "harness/metric_flip.h"
#include "harness/metric_relmse.h"

namespace photonproof {
namespace {

template <class T, class Make>
const T& once(std::optional<T>& kept, const Make& make) {
  if (!kept) kept.emplace(make());
  return *kept;
}

}  // namespace

const MetricContext::DisplayPair& MetricContext::exposed() const {
  return once(exposed_, [&] {
    return DisplayPair{expose(reference_, options_.exposure), expose(test_, options_.exposure)};
  });
}

const MetricContext::DisplayPair& MetricContext::encoded() const {
  return once(encoded_, [&] { return DisplayPair{encode_srgb(exposed().reference), encode_srgb(exposed().test)}; });
}

const std::vector<float>& MetricContext::flip_map() const {
  return once(flip_map_,
              [&] { return flip_errors(reference_.width, reference_.height, exposed().reference, exposed().test); });
}

const std::vector<float>& MetricContext::flip_sorted() const {
  return once(flip_sorted_, [&] {
    std::vector<float> sorted = flip_map();
    std::sort(sorted.begin(), sorted.end());
    return sorted;
  });
}

const std::vector<double>& MetricContext::relative_errors() const {
  return once(relative_errors_, [&] { return relative_squared_errors(reference_, test_); });
}

}  // namespace photonproof
