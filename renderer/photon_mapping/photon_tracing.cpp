#include "renderer/photon_mapping/photon_tracing.h"

#include <algorithm>
#include <memory>

namespace photonproof::inline renderer_photon_mapping {
namespace {

constexpr std::uint64_t chunk_size = 4096;
constexpr int index_bits = 32;  ///< of the sampler; runs beyond start other sequences

/// A chunk's photons as they landed; their paths are in no order.
struct Landed {
  Photons photons;
  std::vector<std::uint32_t> path;
};

void drain(PhotonTask& task) {
  auto& landed = *static_cast<Landed*>(task.sink);
  PhotonDeposits& d = *task.deposits;
  const auto take = [&](auto& to, const auto& from) { to.insert(to.end(), from, from + d.count); };
  zip_photons(take, landed.photons, d.photons);
  take(landed.path, d.path);
  d.count = 0;
}

/// Sorts photons by their paths; photons of one path stay in the order in which they landed (counting sort).
Photons in_path_order(Landed& landed, std::uint32_t paths) {
  std::vector<std::uint32_t> slot(paths + 1, 0);
  for (const std::uint32_t path : landed.path) ++slot[path + 1];
  for (std::size_t p = 1; p < slot.size(); ++p) slot[p] += slot[p - 1];
  for (std::uint32_t& path : landed.path) path = slot[path]++;
  Photons sorted;
  sorted.resize(landed.photons.size());
  const auto put_in_order = [&](auto& to, const auto& from) {
    for (std::size_t i = 0; i < from.size(); ++i) to[landed.path[i]] = from[i];
  };
  zip_photons(put_in_order, sorted, landed.photons);
  return sorted;
}

}  // namespace

Photons trace_photons(const Scene& scene, const PhotonRun& run, const PhotonMethod& method, const Threads& threads,
                      RayTotals& totals) {
  const std::uint64_t chunks = (run.count + chunk_size - 1) / chunk_size;
  std::vector<Photons> stored(chunks);
  threads.for_each(chunks, [&](std::size_t chunk) {
    const std::uint64_t begin = run.first + chunk * chunk_size;
    const auto count = static_cast<std::uint32_t>(std::min(chunk_size, run.count - chunk * chunk_size));
    std::vector<std::uint32_t> scratch(method.kernels.photon.scratch);
    const auto deposits = std::make_unique<PhotonDeposits>();
    Landed landed;
    PhotonTask task{.scene = &scene.view(),
                    .kind = run.kind,
                    .sampler = method.sampler,
                    .seed = stream_seed(run.seed, run.stream, begin >> index_bits),
                    .first = static_cast<std::uint32_t>(begin),
                    .count = count,
                    .share = 1 / static_cast<float>(run.count),
                    .aimed = run.aimed,
                    .max_edges = run.max_edges,
                    .scratch = scratch.data(),
                    .deposits = deposits.get(),
                    .drain = drain,
                    .sink = &landed};
    method.kernels.photon.trace(task);
    stored[chunk] = in_path_order(landed, count);
    totals.add(task.counts);
  });
  Photons all;
  std::size_t total = 0;
  for (const Photons& part : stored) total += part.size();
  all.reserve(total);
  for (Photons& part : stored) {
    all.append(part);
    part = {};
  }
  return all;
}

}  // namespace photonproof::inline renderer_photon_mapping
