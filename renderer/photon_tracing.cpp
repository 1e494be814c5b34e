#include "renderer/photon_tracing.h"

#include <algorithm>
#include <cmath>

#include "renderer/camera_walk.h"

namespace photonproof {
namespace {

constexpr std::uint64_t chunk_size = 4096;

/// Roulette by albedo keeps the photons' flux even. Only long histories also die at random where nothing is absorbed,
/// so that a lossless closed scene ends.
constexpr int always_mortal_from = 32;

bool survives_absorption(const Rgb& weight, int edges, Rgb& flux, Sampler& sampler) {
  const float largest = max_component(weight);
  if (!(largest > 0)) return false;
  const float q = std::min(edges < always_mortal_from ? 1.0f : 0.95f, largest);
  if (q < 1 && !(sampler.next() < q)) return false;
  flux *= weight / q;
  return true;
}

void trace_photon(const Scene& scene, const PhotonRun& run, std::uint64_t index, Photons& stored, RayCounts& counts) {
  const Tracer& tracer = scene.tracer();
  Sampler sampler(run.seed, run.stream, run.first + index, 0);
  const Scene::LightChoice choice = scene.choose_light(sampler.next());
  const Vec2<float> u_position = sampler.next2();
  const Emission start = emit(scene.lights[choice.index], u_position, sampler.next2());
  Rgb flux = start.flux / (choice.probability * static_cast<float>(run.count));
  Ray ray{tracer.offset(start.p_world, start.normal, start.direction), start.direction};
  bool bounced_diffusely = false;
  bool bounced_specularly = false;

  for (int edges = 1; run.max_edges < 0 || edges <= run.max_edges; ++edges) {
    ++counts.photon;
    const Hit hit = tracer.intersect(ray);
    if (!hit.valid()) return;
    const Bsdf& bsdf = scene.bsdf_of(hit);
    const Frame frame(hit.normal);
    const Vec3f wo_local = frame.to_local(-ray.direction);
    if (is_delta(bsdf)) {
      bounced_specularly = true;
    } else {
      const bool wanted = run.kind == PhotonKind::global ? bounced_diffusely : bounced_specularly;
      if (wanted && wo_local.z > 0) stored.push_back({hit.p_world, flux, hit.surface, edges});
      if (run.kind == PhotonKind::caustic) return;
      bounced_diffusely = true;
    }
    const float u_lobe = sampler.next();
    const auto next = sample(bsdf, wo_local, u_lobe, sampler.next2(), TransportMode::importance);
    if (!next || !survives_absorption(next->weight, edges, flux, sampler)) return;
    ray = scattered_ray(scene, hit, frame, next->wi_local);
  }
}

}  // namespace

Photons trace_photons(const Scene& scene, const PhotonRun& run, const Threads& threads, RayTotals& totals) {
  const std::uint64_t chunks = (run.count + chunk_size - 1) / chunk_size;
  std::vector<Photons> stored(chunks);
  threads.for_each(chunks, [&](std::size_t chunk) {
    RayCounts counts;
    const std::uint64_t begin = chunk * chunk_size;
    const std::uint64_t end = std::min(begin + chunk_size, run.count);
    for (std::uint64_t i = begin; i < end; ++i) trace_photon(scene, run, i, stored[chunk], counts);
    totals.add(counts);
  });
  Photons all;
  std::size_t total = 0;
  for (const auto& part : stored) total += part.size();
  all.reserve(total);
  for (const auto& part : stored) all.append(part);
  return all;
}

}  // namespace photonproof
