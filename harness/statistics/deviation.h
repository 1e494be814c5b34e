// How far a value is off, what chance could have made of it, and the chi^2 of a channel's blocks: one rule for gates
// (deviations.h) and for `agreement` (agreement.h).
//
// A difference over an estimated standard error is Student's t: its square has the expectation f/(f - 2) and not 1, so
// that a plain sum of squares rejects right images, the more often the fewer degrees of freedom they leave. Each t is
// turned into the normal deviate of the same probability first (student.h); the squares of n independent ones then sum
// to chi^2 with n degrees of freedom, whatever theirs were.
//
// Rare bright samples that did not come leave no variance behind. Light D that comes in samples of f each is D/f
// samples, of which none comes with probability exp(-D/f); exp(-z^2/2) is a normal variable's bound, so z^2 = 2 D/f.
// With a variance s^2 beside it, z = D / sqrt(s^2 + f D/2): the sub-gamma bound (Boucheron, Lugosi and Massart 2013,
// section 2.4) of a sum whose variance is short of f D/2.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace photonproof::inline harness_statistics {

/// Relative deviations by rounding: no difference this small proves anything.
inline constexpr double rounding_deviation = 1e-5;

/// A variance, and the degrees of freedom that it is known with.
struct KnownVariance {
  double variance = 0, freedom = std::numeric_limits<double>::infinity();
};

struct Deviation {
  double difference = 0;                                     ///< from what is expected
  double standard_error = 0;                                 ///< of `difference`
  double freedom = std::numeric_limits<double>::infinity();  ///< of the standard error
  double expected = 0;
  double skewness = 0;     ///< of `difference`, where that matters
  double sample = 0;       ///< what one of the brightest samples adds to `difference`
  bool two_sided = false;  ///< what is expected has such noise, too: skewness and missing samples count on both sides
  /// In standard errors, signed. Less above what is expected where skewness explains a part. Less below it where bright
  /// samples are missing: the standard error, known from those that came, says nothing of them.
  double errors() const;
  /// In units of the normal distribution, signed.
  double deviate() const;
  /// What |difference| exceeds by chance with probability `tail`.
  double margin(double tail) const;
};

/// Of two estimates, their noise taken together (Welch and Satterthwaite), and rounding.
Deviation deviation_of(double mean, double reference, const KnownVariance& of_mean, const KnownVariance& of_reference);

/// The level at which each of `tests` may fail so that one of them does with probability `alpha` (Sidak 1967).
inline double sidak(double alpha, double tests) { return -std::expm1(std::log1p(-alpha) / tests); }

/// The upper quantile of chi^2.
double chi_square_bound(double degrees, double alpha);

/// Sum of the squared deviates.
double chi_square(std::span<const Deviation> blocks);

struct BlockChiSquare {
  std::size_t channel = 0;  ///< the worst
  double value = 0, bound = 0;
  bool beyond() const { return value > bound; }
};

/// Of three channels that need not be independent, by Sidak's level for three. `independent`: by channel, as how many
/// independent blocks the sum spreads (shared_noise.h). Precondition: equally many blocks in each.
BlockChiSquare chi_square_of_blocks(const std::array<std::vector<Deviation>, 3>& blocks,
                                    const std::array<double, 3>& independent, double alpha);
/// Of independent ones.
BlockChiSquare chi_square_of_blocks(const std::array<std::vector<Deviation>, 3>& blocks, double alpha);

}  // namespace photonproof::inline harness_statistics
