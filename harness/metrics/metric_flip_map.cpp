// LDR-FLIP: Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild, "FLIP: A Difference Evaluator for
// Alternating Images", Proc. ACM Comput. Graph. Interact. Tech. 3(2), 2020. Borders (replicated) and the clamp after
// filtering (to [0,1] linear RGB) are those of NVIDIA's tool.
//
// Colour: opponent channels -> contrast sensitivity filters -> L*a*b*, Hunt-adjusted -> HyAB distance -> [0,1].
// Features: luminance -> edge and point detectors -> difference of magnitudes.  Error = colour^(1 - feature).
//
// The paper filters YCxCz = (116 y - 16, 500 (x - y), 200 (y - z)), with x, y, z relative to white. Every filter has
// sum 1, so scale and offset commute with it: we filter y, x - y and y - z themselves. The input of the feature
// detectors, (Y + 16) / 116, is y. Every filter is a sum of at most two products f(x) g(y), and runs as such. The
// arithmetic of single pixels is in pixel_loops.cpp.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "harness/metrics/metric_flip.h"
#include "harness/pixels/metric_filter.h"

namespace photonproof::inline harness_metrics {
namespace {

using std::numbers::pi;

constexpr double kFeatureWidth = 0.082;  // degrees
constexpr std::size_t kReach = PairTile::reach;

// --- kernels ---------------------------------------------------------------------------------------------------------

/// A term a sqrt(pi/b) exp(-pi^2 d^2 / b) of a sensitivity filter, d in degrees: a Gaussian of sigma sqrt(b/2) / pi.
struct SensitivityTerm {
  double a, b;
  double sigma_pixels() const { return std::sqrt(b / 2) / pi * flip_pixels_per_degree; }
};
constexpr SensitivityTerm kAchromatic{1, 0.0047};
constexpr SensitivityTerm kRedGreen{1, 0.0053};
constexpr SensitivityTerm kBlueYellowWide{34.1, 0.04};
constexpr SensitivityTerm kBlueYellowNarrow{13.5, 0.025};

struct FlipKernels {
  Taps achromatic, red_green, wide, narrow;
  Taps smooth, edge, point;  // feature detectors: a Gaussian, its first and its second derivative
  double wide_share;         // share of the blue-yellow filter's wide term

  FlipKernels() {
    // The paper's support for all channels is three sigma of the widest term. The narrow terms, with sigmas of 1.03 and
    // 1.10 pixels, have less than 1e-11 beyond 7 pixels.
    const int radius = static_cast<int>(std::ceil(3 * kBlueYellowWide.sigma_pixels()));
    achromatic = gaussian_taps(kAchromatic.sigma_pixels(), 7);
    red_green = gaussian_taps(kRedGreen.sigma_pixels(), 7);
    wide = gaussian_taps(kBlueYellowWide.sigma_pixels(), radius);
    narrow = gaussian_taps(kBlueYellowNarrow.sigma_pixels(), radius);
    wide_share =
        weight(kBlueYellowWide, radius) / (weight(kBlueYellowWide, radius) + weight(kBlueYellowNarrow, radius));

    const double sigma = 0.5 * kFeatureWidth * flip_pixels_per_degree;
    smooth = gaussian_taps(sigma, static_cast<int>(std::ceil(3 * sigma)));
    edge = point = smooth;
    for (int k = 0; k <= smooth.radius; ++k) {
      edge.weight[k] *= -k;
      point.weight[k] *= k * k / (sigma * sigma) - 1;
    }
    // Positive and negative weights are each scaled to a sum of one, like those of the paper's 2D kernels. Those are
    // these weights times a Gaussian of sum 1 across.
    double edge_sum = 0, positive = 0, negative = 0;
    for (int k = 0; k <= smooth.radius; ++k) {
      const double both = (k == 0 ? 1 : 2) * point.weight[k];
      (both > 0 ? positive : negative) += std::abs(both);
      edge_sum += std::abs(edge.weight[k]);
    }
    for (int k = 0; k <= smooth.radius; ++k) {
      edge.weight[k] /= edge_sum;
      point.weight[k] /= point.weight[k] > 0 ? positive : negative;
    }
  }

  /// The sum of a term over the square support: the weight of its Gaussian, scaled to sum to 1, in a sum of terms.
  static double weight(const SensitivityTerm& term, int radius) {
    const double sigma = term.sigma_pixels();
    double line = 0;
    for (int x = -radius; x <= radius; ++x) line += std::exp(-x * x / (2 * sigma * sigma));
    return term.a * std::sqrt(pi / term.b) * line * line;
  }
};

const FlipKernels& kernels() {
  static const FlipKernels made;
  return made;
}

// --- one image -------------------------------------------------------------------------------------------------------

/// A tile's opponent channels with kReach around it, and the filters on them.
class OpponentTile {
 public:
  OpponentTile(const TileColour& rgb, std::size_t width, std::size_t height, TileMemory& memory)
      : width_(width), height_(height), stride_(width + 2 * kReach), memory_(memory) {
    for (double*& plane : planes_) plane = memory.take<double>(stride_ * rows());
    for (std::size_t y = 0; y < rows(); ++y) {
      const auto row = [&](std::size_t c) { return rgb[c].core + y * rgb[c].stride - kReach * rgb[c].stride - kReach; };
      pixel_loops().opponents(row(0), row(1), row(2), stride_, planes_[0] + y * stride_, planes_[1] + y * stride_,
                              planes_[2] + y * stride_);
    }
  }

  /// The colours as an observer perceives them: filtered, clamped to displayable ones, Hunt-adjusted L*a*b*.
  void perceive(const LabPlanes& lab) {
    const TileMemory::Frame frame(memory_);
    const FlipKernels& k = kernels();
    const double* y = down(across(planes_[0], k.achromatic), k.achromatic);
    const double* xy = down(across(planes_[1], k.red_green), k.red_green);
    double *across_wide = band(), *across_narrow = band();
    pixel_loops().filter_twice(across_span(planes_[2]), {k.wide, across_wide, width_},
                               {k.narrow, across_narrow, width_});
    const double *wide = down(across_wide, k.wide), *narrow = down(across_narrow, k.narrow);
    pixel_loops().perceived(y, xy, wide, narrow, k.wide_share, width_ * height_, lab);
  }

  /// Magnitudes over both directions of the detectors' responses at each pixel.
  void detect(const FeaturePlanes& features) {
    const TileMemory::Frame frame(memory_);
    const FlipKernels& k = kernels();
    double *across_edge = band(), *across_point = band();
    pixel_loops().filter_odd_even(across_span(planes_[0]), {k.edge, across_edge, width_},
                                  {k.point, across_point, width_});
    double *edge_y = tile(), *point_y = tile();
    pixel_loops().filter_odd_even(down_span(across(planes_[0], k.smooth)), {k.edge, edge_y, width_},
                                  {k.point, point_y, width_});
    pixel_loops().magnitude(down(across_edge, k.smooth), edge_y, width_ * height_, features.edge);
    pixel_loops().magnitude(down(across_point, k.smooth), point_y, width_ * height_, features.point);
  }

 private:
  std::size_t rows() const { return height_ + 2 * kReach; }
  double* band() { return memory_.take<double>(width_ * rows()); }  // the tile's columns, of all rows
  double* tile() { return memory_.take<double>(width_ * height_); }
  FilterSpan across_span(const double* plane) const { return {plane + kReach, stride_, 1, width_, rows()}; }
  FilterSpan down_span(const double* filtered) const {
    return {filtered + kReach * width_, width_, static_cast<std::ptrdiff_t>(width_), width_, height_};
  }
  const double* across(const double* plane, const Taps& taps) {
    double* out = band();
    pixel_loops().filter(across_span(plane), {taps, out, width_});
    return out;
  }
  const double* down(const double* filtered, const Taps& taps) {
    double* out = tile();
    pixel_loops().filter(down_span(filtered), {taps, out, width_});
    return out;
  }

  std::size_t width_, height_, stride_;
  TileMemory& memory_;
  std::array<double*, 3> planes_;  // y, x - y and y - z, x, y, z being XYZ relative to white
};

/// The largest possible HyAB distance, from green to blue, to the power qc.
double greatest_distance() {
  const double r[] = {0, 0}, g[] = {1, 0}, b[] = {0, 1};
  double y[2], xy[2], yz[2], lightness[2], red_green[2], blue_yellow[2];
  pixel_loops().opponents(r, g, b, 2, y, xy, yz);
  pixel_loops().perceived(y, xy, yz, yz, 0.5, 2, {lightness, red_green, blue_yellow});
  const double hyab =
      std::abs(lightness[0] - lightness[1]) + std::hypot(red_green[0] - red_green[1], blue_yellow[0] - blue_yellow[1]);
  return std::pow(hyab, 0.7);
}

}  // namespace

void flip_errors(const TileColour& reference, const TileColour& test, std::size_t width, std::size_t height,
                 TileMemory& memory, std::uint32_t* steps) {
  static const double greatest = greatest_distance();
  const TileMemory::Frame frame(memory);
  const std::size_t pixels = width * height;
  LabPlanes lab[2];
  FeaturePlanes features[2];
  for (std::size_t which = 0; which < 2; ++which) {
    lab[which] = {memory.take<double>(pixels), memory.take<double>(pixels), memory.take<double>(pixels)};
    features[which] = {memory.take<double>(pixels), memory.take<double>(pixels)};
    const TileMemory::Frame image_frame(memory);
    OpponentTile image(which == 0 ? reference : test, width, height, memory);
    image.perceive(lab[which]);
    image.detect(features[which]);
  }
  pixel_loops().flip_error(lab[0], lab[1], features[0], features[1], greatest, pixels, steps);
}

}  // namespace photonproof::inline harness_metrics
