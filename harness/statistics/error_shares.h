// Where a metric of the whole image has its error from: the metric of each tile alone, as a part of their sum.
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

/// The tiles with the largest parts of a metric's error, worst first: one at least where there is an error, three at
/// most, the further ones only with more than twice an even share. Their score is the part; their sentence reads "44 %
/// of the error in 8 x 8 px at (24, 16), where the image is -12 %".
/// What a tile is worth to a metric, its row says (TileShares, metric_rows.h):
/// - Of metrics over windows (ssim, flip) a tile's values are those of the windows around its pixels, as in the whole
///   image but for flip's widest filters. ms_ssim, undefined on so few pixels, is looked for by ssim, its first scale.
/// - A trimmed mean or a quantile is looked for by the mean, a root by the mean below it. max_abs and flip_max have no
///   parts: the tile that holds the greatest.
/// Images count as their mean error; four at most are looked at. Preconditions: `metric` is in the table, sizes are
/// equal, values finite.
std::vector<FailingTile> largest_error_shares(const std::string& metric, const Image& reference,
                                              std::span<const Image* const> images, MetricOptions options);

}  // namespace photonproof::inline harness_statistics
