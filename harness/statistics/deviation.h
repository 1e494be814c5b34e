// The difference of a value from its expectation, the part that chance explains, and the chi^2 of a channel's blocks.
// Gates (deviations.h) and `agreement` (agreement.h) use this one rule.
//
// A difference over an estimated standard error is Student's t. Its square has the expectation f/(f - 2) and not 1. A
// plain sum of squares therefore rejects right images, the more often the fewer degrees of freedom f there are. Each t
// is first turned into the normal deviate of the same probability (student.h). The squares of n independent deviates
// then sum to chi^2 with n degrees of freedom, for any f.
//
// Rare bright samples that did not come leave no variance behind. Light D in samples of f each is D/f samples. None of
// them comes with probability exp(-D/f). A normal variable's bound is exp(-z^2/2), so z^2 = 2 D/f. With a variance s^2
// beside it, z = D / sqrt(s^2 + f D/2). This is the sub-gamma bound (Boucheron, Lugosi and Massart 2013, section 2.4)
// of a sum whose variance lacks f D/2.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace photonproof::inline harness_statistics {

/// Relative deviation by rounding: a smaller difference proves nothing.
inline constexpr double rounding_deviation = 1e-5;

/// A variance and its degrees of freedom.
struct KnownVariance {
  double variance = 0, freedom = std::numeric_limits<double>::infinity();
};

struct Deviation {
  double difference = 0;                                     ///< Difference from `expected`.
  double standard_error = 0;                                 ///< Standard error of `difference`.
  double freedom = std::numeric_limits<double>::infinity();  ///< Degrees of freedom of the standard error.
  double expected = 0;
  double skewness = 0;     ///< Skewness of `difference`, where it matters.
  double sample = 0;       ///< The amount that one of the brightest samples adds to `difference`.
  bool two_sided = false;  ///< `expected` is as noisy: skewness and missing samples count on both sides.
  /// The signed deviation in standard errors. Above `expected` it is smaller where skewness explains a part. Below it,
  /// it is smaller where bright samples are missing: the standard error comes only from the samples that came.
  double errors() const;
  /// The signed deviation in units of the normal distribution.
  double deviate() const;
  /// The bound that |difference| exceeds by chance with probability `tail`.
  double margin(double tail) const;
};

/// The deviation between two estimates, with the noise of both (Welch and Satterthwaite) and rounding.
Deviation deviation_of(double mean, double reference, const KnownVariance& of_mean, const KnownVariance& of_reference);

/// The level of each of `tests` tests at which one of them fails by chance with probability `alpha` (Sidak 1967).
inline double sidak(double alpha, double tests) { return -std::expm1(std::log1p(-alpha) / tests); }

/// The upper quantile of chi^2.
double chi_square_bound(double degrees, double alpha);

/// Sum of the squared deviates.
double chi_square(std::span<const Deviation> blocks);

struct BlockChiSquare {
  std::size_t channel = 0;  ///< The worst channel.
  double value = 0, bound = 0;
  bool beyond() const { return value > bound; }
};

/// The worst chi^2 of three channels, which may depend on each other, at Sidak's level for three. `independent`: the
/// number of independent blocks a channel (shared_noise.h). Precondition: equally many blocks in each channel.
BlockChiSquare chi_square_of_blocks(const std::array<std::vector<Deviation>, 3>& blocks,
                                    const std::array<double, 3>& independent, double alpha);
/// The same for independent blocks.
BlockChiSquare chi_square_of_blocks(const std::array<std::vector<Deviation>, 3>& blocks, double alpha);

}  // namespace photonproof::inline harness_statistics
