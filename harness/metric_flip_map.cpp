// LDR-FLIP: Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström, Fairchild, "FLIP: A Difference Evaluator for
// Alternating Images", Proc. ACM Comput. Graph. Interact. Tech. 3(2), 2020; with the borders (replicated) and the clamp
// after filtering (to [0,1] linear RGB) of NVIDIA's tool.
//
// Colour: opponent channels -> contrast sensitivity filters -> L*a*b*, Hunt-adjusted -> HyAB distance -> [0,1].
// Features: luminance -> edge and point detectors -> difference of magnitudes.  Error = colour^(1 - feature).
//
// The paper filters YCxCz = (116 y - 16, 500 (x - y), 200 (y - z)), with x, y, z relative to white. Every filter has
// sum 1, so scale and offset commute with it: we filter y, x - y and y - z themselves. The feature detectors' input, (Y
// + 16) / 116, is y. Every filter is a sum of at most two products f(x) g(y), and is run as such.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "harness/metric_filter.h"
#include "harness/metric_flip.h"
#include "scenes/vec.h"

namespace photonproof {
namespace {

using std::numbers::pi;

constexpr double kQc = 0.7, kPc = 0.4, kPt = 0.95;  // of the colour difference
constexpr double kFeatureWidth = 0.082;             // degrees
constexpr double kQf = 0.5;                         // of the feature difference

// --- colour spaces ---------------------------------------------------------------------------------------------------

/// XYZ relative to the white point from linear Rec.709 RGB, and back. Ratios of integers, each row summing to 1.
struct WhiteRelativeXyz {
  Vec3d row_x{10135552.0 / 23359437, 8788810.0 / 23359437, 4435075.0 / 23359437};
  Vec3d row_y{2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897};
  Vec3d row_z{1425312.0 / 80288307, 8788810.0 / 80288307, 70074185.0 / 80288307};
  // The columns of the inverse are the cross products of two rows, over the determinant.
  double determinant = dot(row_x, cross(row_y, row_z));
  Vec3d column_x = cross(row_y, row_z) / determinant;
  Vec3d column_y = cross(row_z, row_x) / determinant;
  Vec3d column_z = cross(row_x, row_y) / determinant;

  constexpr Vec3d from_rgb(const Vec3d& rgb) const { return {dot(row_x, rgb), dot(row_y, rgb), dot(row_z, rgb)}; }
  constexpr Vec3d to_rgb(const Vec3d& xyz) const { return xyz.x * column_x + xyz.y * column_y + xyz.z * column_z; }
};
constexpr WhiteRelativeXyz kXyz;

/// L*a*b* of a linear colour in [0,1], with a* and b* scaled by L*/100 (Hunt: dark colours look less colourful).
Vec3d hunt_adjusted_lab(const Vec3d& rgb) {
  const auto f = [](double t) {
    constexpr double delta = 6.0 / 29;
    return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0 / 29;
  };
  const Vec3d xyz = kXyz.from_rgb(rgb);
  const double fx = f(xyz.x), fy = f(xyz.y), fz = f(xyz.z);
  const double lightness = 116 * fy - 16;
  return {lightness, 0.01 * lightness * 500 * (fx - fy), 0.01 * lightness * 200 * (fy - fz)};
}

double hyab(const Vec3d& a, const Vec3d& b) {
  return std::abs(a.x - b.x) + std::sqrt((a.y - b.y) * (a.y - b.y) + (a.z - b.z) * (a.z - b.z));
}

// --- opponent channels -----------------------------------------------------------------------------------------------

/// y, x - y and y - z, x, y, z being XYZ relative to white.
struct Opponents {
  Plane achromatic, red_green, blue_yellow;
};

Opponents opponents(int width, int height, const std::vector<double>& rgb) {
  Opponents planes{Plane(width, height), Plane(width, height), Plane(width, height)};
  for (std::size_t i = 0; i < planes.achromatic.values.size(); ++i) {
    const Vec3d xyz = kXyz.from_rgb({rgb[3 * i], rgb[3 * i + 1], rgb[3 * i + 2]});
    planes.achromatic.values[i] = xyz.y;
    planes.red_green.values[i] = xyz.x - xyz.y;
    planes.blue_yellow.values[i] = xyz.y - xyz.z;
  }
  return planes;
}

// --- contrast sensitivity --------------------------------------------------------------------------------------------

/// A term a sqrt(pi/b) exp(-pi^2 d^2 / b) of a sensitivity filter, d in degrees: a Gaussian of sigma sqrt(b/2) / pi.
struct SensitivityTerm {
  double a, b;
  double sigma_pixels() const { return std::sqrt(b / 2) / pi * flip_pixels_per_degree; }
};
constexpr SensitivityTerm kAchromatic{1, 0.0047};
constexpr SensitivityTerm kRedGreen{1, 0.0053};
constexpr SensitivityTerm kBlueYellowWide{34.1, 0.04};
constexpr SensitivityTerm kBlueYellowNarrow{13.5, 0.025};

/// Three sigma of the widest term, for all channels.
int sensitivity_radius() { return static_cast<int>(std::ceil(3 * kBlueYellowWide.sigma_pixels())); }

Plane gaussian_blur(const Plane& plane, const SensitivityTerm& term) {
  const Kernel kernel = gaussian_kernel(term.sigma_pixels(), sensitivity_radius());
  return filter_columns(filter_rows(plane, kernel), kernel);
}

/// The sum of a term over the square support: what its Gaussian, scaled to sum to 1, weighs in a sum of terms.
double weight(const SensitivityTerm& term) {
  const double sigma = term.sigma_pixels();
  double line = 0;
  for (int x = -sensitivity_radius(); x <= sensitivity_radius(); ++x) line += std::exp(-x * x / (2 * sigma * sigma));
  return term.a * std::sqrt(pi / term.b) * line * line;
}

Plane blue_yellow_blur(const Plane& plane) {
  const double share = weight(kBlueYellowWide) / (weight(kBlueYellowWide) + weight(kBlueYellowNarrow));
  Plane sum = gaussian_blur(plane, kBlueYellowWide);
  const Plane narrow = gaussian_blur(plane, kBlueYellowNarrow);
  for (std::size_t i = 0; i < sum.values.size(); ++i)
    sum.values[i] = share * sum.values[i] + (1 - share) * narrow.values[i];
  return sum;
}

/// What an observer makes of the image's colours: filtered, clamped to displayable ones, Hunt-adjusted L*a*b*.
std::vector<Vec3d> perceived_colours(const Opponents& image) {
  const Plane achromatic = gaussian_blur(image.achromatic, kAchromatic);
  const Plane red_green = gaussian_blur(image.red_green, kRedGreen);
  const Plane blue_yellow = blue_yellow_blur(image.blue_yellow);
  std::vector<Vec3d> lab(achromatic.values.size());
  for (std::size_t i = 0; i < lab.size(); ++i) {
    const double y = achromatic.values[i];
    const Vec3d rgb = kXyz.to_rgb({y + red_green.values[i], y, y - blue_yellow.values[i]});
    lab[i] = hunt_adjusted_lab({std::clamp(rgb.x, 0.0, 1.0), std::clamp(rgb.y, 0.0, 1.0), std::clamp(rgb.z, 0.0, 1.0)});
  }
  return lab;
}

/// HyAB^qc mapped to [0,1]: the lowest pc of the range takes pt of it. The greatest distance is green to blue.
class ColourError {
 public:
  ColourError()
      : greatest_(std::pow(hyab(hunt_adjusted_lab({0, 1, 0}), hunt_adjusted_lab({0, 0, 1})), kQc)),
        knee_(kPc * greatest_) {}
  double operator()(const Vec3d& a, const Vec3d& b) const {
    const double error = std::pow(hyab(a, b), kQc);
    return error < knee_ ? kPt / knee_ * error : kPt + (error - knee_) / (greatest_ - knee_) * (1 - kPt);
  }

 private:
  double greatest_, knee_;
};

// --- features --------------------------------------------------------------------------------------------------------

/// First and second derivative of a Gaussian, positive and negative weights each scaled to a sum of one. The scaling of
/// the paper's 2D kernels, which are these times a Gaussian of sum 1 across.
struct FeatureKernels {
  Kernel across, edge, point;

  FeatureKernels() {
    const double sigma = 0.5 * kFeatureWidth * flip_pixels_per_degree;
    const int radius = static_cast<int>(std::ceil(3 * sigma));
    across = gaussian_kernel(sigma, radius);
    for (std::size_t k = 0; k < across.size(); ++k) {
      const double x = static_cast<double>(k) - radius;
      edge.push_back(-x * across[k]);
      point.push_back((x * x / (sigma * sigma) - 1) * across[k]);
    }
    scale_signs(edge);
    scale_signs(point);
  }

  static void scale_signs(Kernel& kernel) {
    double positive = 0, negative = 0;
    for (const double w : kernel) (w > 0 ? positive : negative) += std::abs(w);
    for (double& w : kernel) w /= w > 0 ? positive : negative;
  }
};

/// Magnitudes, over both directions, of what the detectors find at each pixel.
struct Features {
  std::vector<double> edge, point;
};

std::vector<double> magnitudes(const Plane& a, const Plane& b) {
  std::vector<double> result(a.values.size());
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] = std::sqrt(a.values[i] * a.values[i] + b.values[i] * b.values[i]);
  return result;
}

Features detect_features(const Plane& luminance) {
  static const FeatureKernels kernels;
  const Plane smooth_x = filter_rows(luminance, kernels.across);
  const Plane smooth_y = filter_columns(luminance, kernels.across);
  return {magnitudes(filter_rows(smooth_y, kernels.edge), filter_columns(smooth_x, kernels.edge)),
          magnitudes(filter_rows(smooth_y, kernels.point), filter_columns(smooth_x, kernels.point))};
}

}  // namespace

std::vector<float> flip_errors(int width, int height, const std::vector<double>& reference,
                               const std::vector<double>& test) {
  const Opponents reference_planes = opponents(width, height, reference);
  const Opponents test_planes = opponents(width, height, test);
  const std::vector<Vec3d> reference_colours = perceived_colours(reference_planes);
  const std::vector<Vec3d> test_colours = perceived_colours(test_planes);
  const Features reference_features = detect_features(reference_planes.achromatic);
  const Features test_features = detect_features(test_planes.achromatic);

  const ColourError colour_error;
  std::vector<float> errors(reference_colours.size());
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const double edge = std::abs(reference_features.edge[i] - test_features.edge[i]);
    const double point = std::abs(reference_features.point[i] - test_features.point[i]);
    const double feature = std::pow(std::max(edge, point) / std::numbers::sqrt2, kQf);
    errors[i] = static_cast<float>(std::pow(colour_error(reference_colours[i], test_colours[i]), 1 - feature));
  }
  return errors;
}

}  // namespace photonproof
