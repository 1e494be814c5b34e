// Locates the error of a whole-image metric: the metric of each tile alone, as a share of their sum.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "harness/metrics/metrics.h"
#include "reports/record/results.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_statistics {

/// At most eight tiles a side, of at least 8 pixels, so that neither large images nor small ones give many or tiny
/// parts.
int share_tile_side(int width, int height);

/// The tiles with the largest shares of a metric's error, worst first: at least one where there is an error, at most
/// three. The second and third have more than twice an even share. `score` is the share; the sentence reads "44 % of
/// the error in 8 x 8 px at (24, 16), where the image is -12 %". The metric's row gives a tile's value (TileShares,
/// metric_rows.h).
/// * For metrics over windows (ssim, flip) a tile's values are those of the windows around its pixels. They equal the
///   whole image's, except at flip's widest filters. ms_ssim, undefined on so few pixels, uses ssim, its first scale.
/// * A trimmed mean or a quantile uses the mean; a root uses the mean under it. The metrics max_abs and flip_max have
///   no shares. Their result is the tile that holds the maximum.
///
/// Several images count by their mean error; at most four are used. Preconditions: `metric` is in the table, sizes are
/// equal, values finite.
std::vector<FailingTile> largest_error_shares(const std::string& metric, const Image& reference,
                                              std::span<const Image* const> images, MetricOptions options);

}  // namespace photonproof::inline harness_statistics
