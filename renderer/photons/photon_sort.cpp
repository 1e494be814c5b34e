#include "renderer/photons/photon_sort.h"

#include <algorithm>
#include <bit>
#include <tuple>
#include <utility>

namespace photonproof::inline renderer_photons {
namespace {

constexpr std::size_t chunk_size = 32768;
constexpr std::size_t most_buckets = 1024;
constexpr std::size_t photons_a_bucket = 2048;  // aimed at: 64 kB

std::size_t chunks_of(std::size_t count) { return (count + chunk_size - 1) / chunk_size; }

/// Least and greatest of values[begin, end), in lanes so that it vectorises without reassociation.
std::pair<float, float> extremes(const LargeArray<float>& values, std::size_t begin, std::size_t end) {
  constexpr std::size_t lanes = 16;
  float low[lanes], high[lanes];
  std::ranges::fill(low, values[begin]);
  std::ranges::fill(high, values[begin]);
  std::size_t i = begin;
  for (; i + lanes <= end; i += lanes) {
    for (std::size_t k = 0; k < lanes; ++k) {
      low[k] = values[i + k] < low[k] ? values[i + k] : low[k];
      high[k] = values[i + k] > high[k] ? values[i + k] : high[k];
    }
  }
  for (; i < end; ++i) {
    low[0] = std::min(low[0], values[i]);
    high[0] = std::max(high[0], values[i]);
  }
  return {*std::ranges::min_element(low), *std::ranges::max_element(high)};
}

}  // namespace

Bounds bounds_of(const Photons& photons, const Threads& threads) {
  std::vector<Bounds> parts(chunks_of(photons.size()));
  threads.for_each(parts.size(), [&](std::size_t chunk) {
    const std::size_t begin = chunk * chunk_size;
    const std::size_t end = std::min(begin + chunk_size, photons.size());
    Bounds& part = parts[chunk];
    std::tie(part.low.x, part.high.x) = extremes(photons.x, begin, end);
    std::tie(part.low.y, part.high.y) = extremes(photons.y, begin, end);
    std::tie(part.low.z, part.high.z) = extremes(photons.z, begin, end);
  });
  Bounds all = parts.front();
  for (const Bounds& part : parts) {
    all.low = {std::min(all.low.x, part.low.x), std::min(all.low.y, part.low.y), std::min(all.low.z, part.low.z)};
    all.high = {std::max(all.high.x, part.high.x), std::max(all.high.y, part.high.y),
                std::max(all.high.z, part.high.z)};
  }
  return all;
}

void stage_by_bucket(const Photons& photons, const PhotonGrid& grid, const Threads& threads, StagedPhotons& staged) {
  const std::size_t wanted = std::clamp(std::bit_ceil(photons.size() / photons_a_bucket), std::size_t{1}, most_buckets);
  const std::uint64_t last_key = grid.cells() - 1;
  staged.shift = std::max(0, static_cast<int>(std::bit_width(last_key)) - static_cast<int>(std::bit_width(wanted - 1)));
  const std::size_t buckets = (last_key >> staged.shift) + 1;
  const std::size_t chunks = chunks_of(photons.size());

  LargeArray<std::uint16_t>& bucket_of = staged.bucket_of;
  bucket_of.resize(photons.size());
  std::vector<std::uint32_t> next(chunks * buckets);  // first counts, then where a chunk's next photon of a bucket goes
  threads.for_each(chunks, [&](std::size_t chunk) {
    const std::size_t end = std::min((chunk + 1) * chunk_size, photons.size());
    std::uint32_t* counts = next.data() + chunk * buckets;
    for (std::size_t i = chunk * chunk_size; i < end; ++i) {
      const std::uint64_t key = grid.key(grid.cell(photons.x[i], photons.y[i], photons.z[i]));
      bucket_of[i] = static_cast<std::uint16_t>(key >> staged.shift);
      ++counts[bucket_of[i]];
    }
  });

  std::uint32_t total = 0;
  staged.begin.clear();
  staged.begin.reserve(buckets + 1);
  for (std::size_t b = 0; b < buckets; ++b) {
    staged.begin.push_back(total);
    for (std::size_t chunk = 0; chunk < chunks; ++chunk) total += std::exchange(next[chunk * buckets + b], total);
  }
  staged.begin.push_back(total);

  staged.photons.resize(photons.size());
  threads.for_each(chunks, [&](std::size_t chunk) {
    const std::size_t end = std::min((chunk + 1) * chunk_size, photons.size());
    std::uint32_t* to = next.data() + chunk * buckets;
    for (std::size_t i = chunk * chunk_size; i < end; ++i)
      zip_photons([i](auto& to_value, const auto& from) { to_value = from[i]; }, staged.photons[to[bucket_of[i]]++],
                  photons);
  });
}

}  // namespace photonproof::inline renderer_photons
