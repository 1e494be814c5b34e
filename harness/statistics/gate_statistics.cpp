#include "harness/statistics/gate_statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "harness/statistics/student.h"
#include "scenes/base/percent_text.h"

namespace photonproof::inline harness_statistics {
namespace {

constexpr double missed = 0.01;     // Probability of missing a deviation of the promised size.
constexpr double most_of_it = 0.6;  // Share of the image's blocks above which a deviation is called the whole image's.
constexpr std::array channel_letters{"R", "G", "B"};

/// The part of a look's alpha for each test: blocks, all blocks together, the whole image, and pixels. Pixels are not
/// judged where an error is allowed. `tail_of` is the two-sided tail of one of n tests at level alpha.
double part_of(double alpha, const AllowedError& allowed) { return alpha / (allowed.is_none() ? 4 : 3); }

double tail_of(double alpha, std::size_t n) { return sidak(alpha, static_cast<double>(n)) / 2; }

/// The value that a block's deviation is relative to. 0 where the channel is black.
double scale_of(const Deviation& block, const Deviation& whole) {
  return std::max(std::abs(block.expected), std::abs(whole.expected));
}

bool beyond(const Deviation& d, double tail) {
  // The normal quantile is the smallest of all: most deviations are under it and need no t.
  const double errors = std::abs(d.errors());
  return errors > t_quantile(tail, std::numeric_limits<double>::infinity()) && errors > t_quantile(tail, d.freedom);
}

/// The largest of the channels' relative deviations, with the interval it was judged by.
Estimate worst_whole(const std::array<Deviation, 3>& channels, double tail) {
  Estimate worst;
  for (const Deviation& whole : channels) {
    if (whole.expected == 0) continue;
    const double value = whole.difference / whole.expected, margin = whole.margin(tail) / std::abs(whole.expected);
    if (!worst.interval || std::abs(value) > std::abs(worst.value))
      worst = {value, Interval{value - margin, value + margin}};
  }
  return worst;
}

struct PixelTest {
  std::size_t beyond = 0;
  double worst = 0;  ///< deviate
  std::size_t index = 0, channel = 0;
};

PixelTest test_pixels(const Deviations& d, double tail) {
  PixelTest test;
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < d.pixels[c].size(); ++i) {
      if (!beyond(d.pixels[c][i], tail)) continue;
      ++test.beyond;
      const double deviate = std::abs(d.pixels[c][i].deviate());
      if (deviate < test.worst) continue;
      test = {test.beyond, deviate, i, c};
    }
  return test;
}

std::string places_text(const std::vector<FailingTile>& tiles) {
  std::string text = tiles.front().sentence;
  if (tiles.size() > 1) text += fmt::format("; {} more {}", tiles.size() - 1, tiles.size() == 2 ? "place" : "places");
  return text;
}

/// The channel with the largest deviation in standard errors.
std::size_t worst_channel(const Deviations& d) {
  std::size_t worst = 0;
  for (std::size_t c = 1; c < 3; ++c)
    if (std::abs(d.whole[c].errors()) > std::abs(d.whole[worst].errors())) worst = c;
  return worst;
}

/// Whether noise explains the rest of a channel's blocks after subtracting `explained` from each.
bool is_explained(const Deviations& d, std::size_t channel, double alpha,
                  const std::function<double(const Deviation& block)>& explained) {
  std::vector<Deviation> left = d.blocks[channel];
  for (Deviation& block : left) block.difference -= explained(block);
  return chi_square(left) <= chi_square_bound(static_cast<double>(left.size()), alpha);
}

std::string block_text(const Deviations& d, std::size_t b, std::size_t channel) {
  const Deviation& block = d.blocks[channel][b];
  return fmt::format("{} at ({}, {})", relative_text(block.difference, block.expected), d.places[b].x0, d.places[b].y0);
}

/// The spread of a whole image's deviation over it, which tells a light's power from a material or a background.
std::string spread_text(const Deviations& d, double alpha) {
  const std::size_t c = worst_channel(d);
  const Deviation& whole = d.whole[c];
  const double factor = whole.expected != 0 ? whole.difference / whole.expected : 0;
  if (is_explained(d, c, alpha, [&](const Deviation& block) { return factor * block.expected; }))
    return "one factor everywhere, as by the power of all light, the exposure or the film";
  if (is_explained(d, c, alpha, [&](const Deviation&) { return whole.difference; }))
    return fmt::format("one amount everywhere, {:+.2g} in {}, as by light from all sides", whole.difference,
                       channel_letters[c]);
  const auto relative = [&](std::size_t b) {
    return d.blocks[c][b].difference / std::max(std::abs(d.blocks[c][b].expected), 1e-3 * std::abs(whole.expected));
  };
  std::size_t least = 0, most = 0;
  for (std::size_t b = 1; b < d.places.size(); ++b) {
    if (relative(b) < relative(least)) least = b;
    if (relative(b) > relative(most)) most = b;
  }
  return fmt::format("unevenly, from {} to {} in {}", block_text(d, least, c), block_text(d, most, c),
                     channel_letters[c]);
}

std::string whole_text(const Deviations& d, double alpha) {
  std::string text = "the whole image is off:";
  for (std::size_t c = 0; c < 3; ++c)
    text += fmt::format(" {} {}", channel_letters[c], relative_text(d.whole[c].difference, d.whole[c].expected));
  return text + "; " + spread_text(d, alpha);
}

constexpr double noticed = 2;          // deviations from which a block is counted where all blocks fail together
constexpr std::size_t most_named = 3;  // blocks named at most

/// Blocks that only fail together, none by itself: names the worst and states whether most deviate in one direction.
void name_blocks(const Deviations& d, const Deviations& judged, const BlockChiSquare& chi_square,
                 Judgement& judgement) {
  const std::size_t c = chi_square.channel;
  std::vector<std::size_t> order(d.places.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto size = [&](std::size_t b) { return std::abs(judged.blocks[c][b].deviate()); };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return size(a) > size(b); });
  std::size_t beyond = 0, darker = 0;
  for (const Deviation& block : judged.blocks[c]) {
    if (std::abs(block.deviate()) <= noticed) continue;
    ++beyond;
    if (block.difference < 0) ++darker;
  }
  std::string named;
  for (std::size_t i = 0; i < std::min(most_named, order.size()); ++i) {
    const std::size_t b = order[i];
    const Block& place = d.places[b];
    named += (i > 0 ? ", " : "") + block_text(d, b, c);
    judgement.tiles.push_back({place.x0, place.y0, place.x1 - place.x0, place.y1 - place.y0, size(b),
                               fmt::format("{} in {}, one of {} blocks beyond {} deviations", block_text(d, b, c),
                                           channel_letters[c], beyond, noticed)});
  }
  judgement.sentence = fmt::format(
      "blocks of 8 x 8 pixels are off by more than noise in {}: {}; {} of them beyond {} deviations ({} darker, {} "
      "brighter), chi^2 {:.4g}, bound {:.4g}",
      channel_letters[c], named, beyond, noticed, darker, beyond - darker, chi_square.value, chi_square.bound);
}

bool is_everywhere(const Deviations& d, const std::vector<FailingTile>& tiles) {
  if (tiles.empty()) return false;
  const double area = static_cast<double>(tiles.front().width) * tiles.front().height;
  return area > most_of_it * d.width * d.height;
}

std::string pixel_text(const Deviations& d, const PixelTest& test) {
  const auto width = static_cast<std::size_t>(d.width);
  const Deviation& worst = d.pixels[test.channel][test.index];
  return fmt::format("pixel ({}, {}) {} is {:.4g}, reference {:.4g}: {:.3g} deviations; {} {} beyond noise",
                     test.index % width, test.index / width, channel_letters[test.channel],
                     worst.expected + worst.difference, worst.expected, test.worst, test.beyond,
                     test.beyond == 1 ? "value" : "values");
}

/// The minimum detectable relative deviation: it is found with probability 1 - missed.
double sees_from(const Deviation& d, double tail, double scale) { return (d.margin(tail) + d.margin(missed)) / scale; }

struct Power {
  double whole = 0, block = 0;
  std::size_t worst_block = 0;
};

/// `whole`: the result of judge_whole.
Power power_of(const Deviations& d, double whole, double block_tail, const AllowedError& allowed) {
  Power power{whole};
  for (std::size_t c = 0; c < 3; ++c) {
    if (d.whole[c].expected == 0) continue;
    for (std::size_t b = 0; b < d.places.size(); ++b) {
      const double seen = sees_from(d.blocks[c][b], block_tail, scale_of(d.blocks[c][b], d.whole[c])) + allowed.block;
      if (seen <= power.block) continue;
      power.block = seen;
      power.worst_block = b;
    }
  }
  return power;
}

/// The deviation beyond the allowed one.
Deviation less(Deviation d, double allowed) {
  d.difference = std::copysign(std::max(0.0, std::abs(d.difference) - allowed), d.difference);
  return d;
}

Deviations less_allowed(Deviations d, const AllowedError& allowed) {
  if (allowed.is_none()) return d;
  for (std::size_t c = 0; c < 3; ++c) {
    for (Deviation& block : d.blocks[c]) block = less(block, allowed.block * scale_of(block, d.whole[c]));
    for (Deviation& pixel : d.pixels[c]) pixel.difference = 0;
    d.whole[c] = less(d.whole[c], allowed.whole * std::abs(d.whole[c].expected));
  }
  return d;
}

double block_tail_of(const Deviations& d, double alpha, const AllowedError& allowed) {
  return tail_of(part_of(alpha, allowed), 3 * d.places.size());
}

void say_why_it_fails(const Deviations& d, const Deviations& judged, double part, const PixelTest& pixels,
                      const BlockChiSquare& chi_square, Judgement& judgement) {
  const bool whole_off = std::ranges::find(judgement.whole_off, true) != judgement.whole_off.end();
  if (whole_off && (judgement.tiles.empty() || is_everywhere(d, judgement.tiles)))
    judgement.sentence = whole_text(d, part);
  else if (!judgement.tiles.empty())
    judgement.sentence = places_text(judgement.tiles);
  else if (pixels.beyond > 0)
    judgement.sentence = pixel_text(d, pixels);
  else
    name_blocks(d, judged, chi_square, judgement);
}

Judgement judge_with_samples(const Deviations& d, const AgreementBounds& bounds, double alpha,
                             const AllowedError& allowed) {
  const double part = part_of(alpha, allowed);
  const double block_tail = block_tail_of(d, alpha, allowed);
  const Deviations judged = less_allowed(d, allowed);
  Judgement judgement = judge_whole(judged_means(d, allowed), alpha, allowed);
  const BlockChiSquare chi_square = chi_square_of_blocks(judged.blocks, judged.independent_blocks, part);
  const PixelTest pixels = test_pixels(judged, tail_of(part, 3 * d.pixels[0].size()));
  const BlockScore score = block_excess(d, alpha, allowed);
  judgement.tiles = failing_tiles(d, score);
  if (judgement.verdict == GateVerdict::fail || !judgement.tiles.empty() || chi_square.beyond() || pixels.beyond > 0) {
    judgement.verdict = GateVerdict::fail;
    judgement.would_see.reset();
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t b = 0; b < d.places.size(); ++b)
        judgement.blocks_off[c] = judgement.blocks_off[c] || score(b, c) > 0;
    say_why_it_fails(d, judged, part, pixels, chi_square, judgement);
    return judgement;
  }
  const Power power = power_of(d, judgement.would_see.value_or(0), block_tail, allowed);
  judgement.verdict.reset();
  judgement.would_see.reset();
  if (power.whole <= bounds.whole && power.block <= bounds.block) {
    judgement.verdict = GateVerdict::pass;
    judgement.would_see = power.whole;
    judgement.would_see_in_a_block = power.block;
    judgement.sentence = fmt::format("agrees; {} overall or {} in a block of 8 x 8 pixels would have been seen",
                                     percent_text(power.whole), percent_text(power.block));
  } else if (power.block > bounds.block) {
    const Block& block = d.places[power.worst_block];
    judgement.sentence = fmt::format("too noisy to tell: {} could hide in the block at ({}, {}), bound {}",
                                     percent_text(power.block), block.x0, block.y0, percent_text(bounds.block));
  } else {
    judgement.sentence = fmt::format("too noisy to tell: {} could hide overall, bound {}", percent_text(power.whole),
                                     percent_text(bounds.whole));
  }
  return judgement;
}

/// The deviations without an allowance for missing bright samples.
Deviations without_rare_samples(Deviations d) {
  for (std::size_t c = 0; c < 3; ++c) {
    d.whole[c].sample = 0;
    if (d.weighed) (*d.weighed)[c].sample = 0;
    for (Deviation& block : d.blocks[c]) block.sample = 0;
    for (Deviation& pixel : d.pixels[c]) pixel.sample = 0;
  }
  return d;
}

}  // namespace

const std::array<Deviation, 3>& judged_means(const Deviations& d, const AllowedError& allowed) {
  return d.weighed && allowed.is_none() ? *d.weighed : d.whole;
}

Judgement judge_whole(const std::array<Deviation, 3>& whole, double alpha, const AllowedError& allowed) {
  const double tail = tail_of(part_of(alpha, allowed), 3);
  Judgement judgement;
  judgement.observed = worst_whole(whole, tail);
  judgement.verdict = GateVerdict::pass;
  for (std::size_t c = 0; c < 3; ++c) {
    const double scale = std::abs(whole[c].expected);
    if (scale > 0)
      judgement.would_see = std::max(judgement.would_see.value_or(0), sees_from(whole[c], tail, scale) + allowed.whole);
    judgement.whole_off[c] = beyond(less(whole[c], allowed.whole * scale), tail);
    if (judgement.whole_off[c]) judgement.verdict = GateVerdict::fail;
  }
  return judgement;
}

BlockScore block_excess(const Deviations& d, double alpha, const AllowedError& allowed) {
  return [judged = less_allowed(d, allowed), tail = block_tail_of(d, alpha, allowed)](std::size_t b, std::size_t c) {
    const Deviation& block = judged.blocks[c][b];
    return beyond(block, tail) ? std::abs(block.deviate()) : 0.0;
  };
}

Judgement judge_agreement(const Deviations& d, const AgreementBounds& bounds, double alpha,
                          const AllowedError& allowed) {
  Judgement judgement = judge_with_samples(d, bounds, alpha, allowed);
  if (judgement.verdict == GateVerdict::fail) return judgement;
  const Judgement known = judge_with_samples(without_rare_samples(d), bounds, alpha, allowed);
  if (known.verdict != GateVerdict::fail) return judgement;
  judgement.but_for_rare_samples = known.sentence;
  if (!judgement.verdict) judgement.sentence = "too few samples to meet rare bright ones: " + known.sentence;
  return judgement;
}

namespace {

/// One relative deviation against a bound.
struct Relative {
  double value = 0, margin = 0;
  std::size_t block = 0, channel = 0;
  double outside(double bound) const { return std::abs(value) - margin - bound; }  ///< > 0: surely outside
  double reach() const { return std::abs(value) + margin; }                        ///< <= bound: surely inside
};

std::vector<Relative> relative_deviations(const Deviations& d, bool block, double alpha) {
  std::vector<Relative> all;
  const double tail = tail_of(alpha, block ? 3 * d.places.size() : 3);
  for (std::size_t c = 0; c < 3; ++c) {
    if (d.whole[c].expected == 0) continue;
    for (std::size_t b = 0; b < (block ? d.places.size() : 1); ++b) {
      const Deviation& deviation = block ? d.blocks[c][b] : d.whole[c];
      const double scale = scale_of(deviation, d.whole[c]);
      all.push_back({deviation.difference / scale, deviation.margin(tail) / scale, b, c});
    }
  }
  return all;
}

}  // namespace

Judgement judge_bias(const Deviations& d, bool block, double bound, double alpha) {
  const std::vector<Relative> all = relative_deviations(d, block, alpha);
  Judgement judgement;
  if (all.empty()) {
    judgement.verdict = GateVerdict::fail;
    judgement.sentence = "the reference is black: nothing is relative to it";
    return judgement;
  }
  // The deciding value: the one surest to be outside, else the one with the largest reach.
  const Relative* outside = &*std::max_element(all.begin(), all.end(), [&](const Relative& a, const Relative& b) {
    return a.outside(bound) < b.outside(bound);
  });
  const Relative* furthest = &*std::max_element(
      all.begin(), all.end(), [](const Relative& a, const Relative& b) { return a.reach() < b.reach(); });
  const Relative& worst = outside->outside(bound) > 0 ? *outside : *furthest;
  judgement.observed = {worst.value, Interval{worst.value - worst.margin, worst.value + worst.margin}};
  const std::string where =
      block ? fmt::format("the block at ({}, {})", d.places[worst.block].x0, d.places[worst.block].y0)
            : std::string("the whole image");
  const std::string interval = fmt::format("{} is {:+.2g} % in {} ({:+.2g} to {:+.2g})", where, 100 * worst.value,
                                           channel_letters[worst.channel], 100 * judgement.observed.interval->low,
                                           100 * judgement.observed.interval->high);
  const std::string limit = "bound " + percent_text(bound);
  if (outside->outside(bound) > 0) {
    judgement.verdict = GateVerdict::fail;
    judgement.tiles = failing_tiles(d, [&](std::size_t b, std::size_t c) {
      if (!block)
        return beyond(d.blocks[c][b], tail_of(alpha, 3 * d.places.size())) ? std::abs(d.blocks[c][b].deviate()) : 0.0;
      for (const Relative& relative : all)
        if (relative.block == b && relative.channel == c && relative.outside(bound) > 0)
          return relative.outside(bound) * scale_of(d.blocks[c][b], d.whole[c]) / d.blocks[c][b].standard_error;
      return 0.0;
    });
    judgement.sentence =
        block && !judgement.tiles.empty() ? places_text(judgement.tiles) + "; " + limit : interval + ", " + limit;
  } else if (furthest->reach() <= bound) {
    judgement.verdict = GateVerdict::pass;
    judgement.sentence = block
                             ? fmt::format("no block is off by more than {}, ", percent_text(furthest->reach())) + limit
                             : interval + ", " + limit;
  } else {
    judgement.sentence = "too noisy to tell: " + interval + ", " + limit;
  }
  return judgement;
}

Judgement judge_metric(const std::string& metric, std::span<const double> values, BoundKind kind, double bound,
                       double alpha) {
  const auto n = static_cast<double>(values.size());
  double mean = 0, squares = 0;
  for (const double value : values) mean += value;
  mean /= n;
  for (const double value : values) squares += (value - mean) * (value - mean);
  const double margin = t_quantile(alpha / 2, n - 1) * std::sqrt(squares / (n - 1) / n);
  Judgement judgement;
  judgement.observed = {mean, Interval{mean - margin, mean + margin}};
  const std::string text =
      fmt::format("{} is {:.4g} ({:.4g} to {:.4g}), bound {:.4g}", metric, mean, mean - margin, mean + margin, bound);
  const bool from_below = kind == BoundKind::minimum;
  const double low = mean - margin, high = mean + margin;
  const bool inside = from_below ? low >= bound : high <= bound && (kind == BoundKind::maximum || low >= -bound);
  const bool outside =
      from_below ? high < bound : low > bound || (kind == BoundKind::absolute_maximum && high < -bound);
  if (outside) judgement.verdict = GateVerdict::fail;
  if (inside) judgement.verdict = GateVerdict::pass;
  judgement.sentence = inside || outside ? text : "too noisy to tell: " + text;
  return judgement;
}

}  // namespace photonproof::inline harness_statistics
