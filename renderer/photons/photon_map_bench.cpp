// The photon map and the kd-tree against nanoflann on the same photons and queries. The scene is a box of walls with
// two spheres. The argument is the number of photons; discs hold fifty (sparse: an eighth as wide, for which the map is
// compact). The form suits nanoflann best: points as triples, flux and filter in its callback, so that no list of
// matches is made. One thread unless the name says otherwise. PHOTONPROOF_BENCH_LARGE=1 adds 1e7 photons.

#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <memory>
#include <nanoflann.hpp>
#include <numbers>
#include <numeric>

#include "renderer/kernels/isa.h"
#include "renderer/lanes/test_random.h"
#include "renderer/lanes/warp.h"
#include "renderer/photons/photon_map.h"
#include "renderer/photons/query_order.h"
#include "renderer/photons/test_photon_kdtree.h"

namespace photonproof::inline renderer_photons {
namespace {

constexpr int photons_in_disc = 50;
constexpr float sparse_by = 8;  // cells this much smaller than the radius are too many for a dense grid
constexpr float sphere_radius = 0.18f;
constexpr double area = 6 + 2 * 4 * std::numbers::pi * sphere_radius * sphere_radius;

struct SurfacePoint {
  Vec3f p;
  std::uint32_t surface;
};

/// `where` picks the surface by its area, `u` the point on it.
SurfacePoint point_on_surfaces(double where, const Vec2<float>& u) {
  const double at = where * area;
  if (at >= 6) {
    const bool second = at >= (6 + area) / 2;
    const Vec3f centre = second ? Vec3f{0.72f, 0.35f, 0.18f} : Vec3f{0.27f, 0.65f, 0.18f};
    return {centre + square_to_sphere(u) * sphere_radius, second ? 7u : 6u};
  }
  const auto wall = static_cast<std::uint32_t>(at);
  const float offset = wall % 2 == 0 ? 0.0f : 1.0f;
  if (wall < 2) return {{offset, u.x, u.y}, wall};
  if (wall < 4) return {{u.x, offset, u.y}, wall};
  return {{u.x, u.y, offset}, wall};
}

/// Points in nanoflann's form, and the sums of its callback.
struct Cloud {
  std::vector<Photon> photons;
  std::size_t kdtree_get_point_count() const { return photons.size(); }
  float kdtree_get_pt(std::size_t i, std::size_t axis) const {
    const Vec3f& p = photons[i].p_world;
    return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};
using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Cloud>, Cloud, 3>;
const nanoflann::KDTreeSingleIndexAdaptorParams tree_parameters(
    20);  // its best: random gathers take a tenth to a quarter longer with its default, 10

struct Sum {
  using DistanceType = float;
  const Cloud& cloud;
  float radius2;
  std::uint32_t surface;
  Rgb flux{0.0f};
  int count = 0;
  bool full() const { return true; }
  std::size_t size() const { return 0; }  // there is no list of matches
  void sort() const {}                    // nanoflann 1.6 and later need it
  float worstDist() const { return radius2; }
  bool addPoint(float distance2, std::uint32_t i) {
    const Photon& photon = cloud.photons[i];
    if (distance2 < radius2 && photon.surface == surface && photon.edges <= 100) {
      flux += photon.flux;
      ++count;
    }
    return true;
  }
};

struct Queries {
  std::vector<float> x, y, z;
  std::vector<std::uint32_t> surface;
  std::size_t size() const { return x.size(); }
  Vec3f operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
  void add(const SurfacePoint& point) {
    x.push_back(point.p.x);
    y.push_back(point.p.y);
    z.push_back(point.p.z);
    surface.push_back(point.surface);
  }
};

/// Made once for each number of photons.
struct SceneInterface {
  Photons photons;
  Cloud cloud;
  float radius;
  Queries coherent, random;
  std::unique_ptr<Tree> tree;
  PhotonMap map, compact;
  PhotonKdTree kdtree;

  explicit SceneInterface(std::int64_t count)
      : radius(
            static_cast<float>(std::sqrt(photons_in_disc * area / (std::numbers::pi * static_cast<double>(count))))) {
    for (std::int64_t i = 0; i < count; ++i) {
      test::Random s(1, static_cast<std::uint64_t>(i));
      const float where = s.next();
      const SurfacePoint at = point_on_surfaces(where, s.next2());
      const Photon photon{at.p, {s.next(), s.next(), s.next()}, at.surface, 1 + static_cast<int>(8 * s.next())};
      photons.push_back(photon);
      cloud.photons.push_back(photon);
    }
    // Like a camera's: row after row of one surface after the other, jittered.
    constexpr int side = 110;
    for (int face = 0; face < 8; ++face) {
      for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
          test::Random s(2, random.size());
          const auto jitter = s.next2();
          const double middle = face < 6 ? (face + 0.5) / area : face == 6 ? 6.2 / area : 0.99;
          coherent.add(point_on_surfaces(
              middle, {(static_cast<float>(column) + jitter.x) / side, (static_cast<float>(row) + jitter.y) / side}));
          const float where = s.next();
          random.add(point_on_surfaces(where, s.next2()));
        }
      }
    }
    tree = std::make_unique<Tree>(3, cloud, tree_parameters);
    map = PhotonMap(photons, radius, Threads(1));
    compact = PhotonMap(photons, radius / sparse_by, Threads(1));
    kdtree = PhotonKdTree(photons, Threads(1));
  }
};

const SceneInterface& scene(std::int64_t count) {
  static std::map<std::int64_t, std::unique_ptr<SceneInterface>> made;
  auto& slot = made[count];
  if (!slot) slot = std::make_unique<SceneInterface>(count);
  return *slot;
}

/// The map keeps the photons it is given; the copy is the bench's alone.
/// As from a render's second pass on, when the map has its memory.
void build_and_time(benchmark::State& state, PhotonMap& map, const Photons& photons, float radius,
                    const Threads& threads) {
  state.PauseTiming();
  Photons copy;
  copy.reserve(photons.size());
  copy.append(photons);
  state.ResumeTiming();
  map.build(std::move(copy), radius, threads);
  benchmark::DoNotOptimize(map);
}

void build_ours(benchmark::State& state, int thread_count) {
  const SceneInterface& w = scene(state.range(0));
  const Threads threads(thread_count);
  PhotonMap map;
  for (auto _ : state) build_and_time(state, map, w.photons, w.radius, threads);
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

void build_compact(benchmark::State& state) {
  const SceneInterface& w = scene(state.range(0));
  const Threads threads(1);
  PhotonMap map;
  for (auto _ : state) build_and_time(state, map, w.photons, w.radius / sparse_by, threads);
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

void build_tree(benchmark::State& state, int thread_count) {
  const SceneInterface& w = scene(state.range(0));
  const Threads threads(thread_count);
  for (auto _ : state) {
    PhotonKdTree tree(w.photons, threads);
    benchmark::DoNotOptimize(tree);
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

void build_nanoflann(benchmark::State& state) {
  const SceneInterface& w = scene(state.range(0));
  for (auto _ : state) {
    Tree tree(3, w.cloud, tree_parameters);
    Tree* built = &tree;
    benchmark::DoNotOptimize(built);
  }
  state.SetItemsProcessed(state.iterations() * state.range(0));
}

GatherQueue gather_points(const Queries& queries) {
  GatherQueue points(queries.size());
  for (std::size_t i = 0; i < queries.size(); ++i) points.push_back({queries[i], Rgb(1), 0, queries.surface[i], 0});
  return points;
}

std::vector<std::uint32_t> order_given(std::size_t count) {
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  return order;
}

/// The photon mapper's gather, by the kernel of the processor's best instruction set.
void radiance_estimate(benchmark::State& state, const PhotonMap& map, const Queries& queries, float radius,
                       bool sorted) {
  GatherQueue points = gather_points(queries);
  const GatherPoints view = points.view();
  std::fill_n(view.radius, view.count, radius);
  std::vector<std::uint32_t> order = order_given(points.size());
  double found = 0;
  for (auto _ : state) {
    if (sorted) order = cell_order(map, points);
    kernels_for("").gather.gather({map.view(), 100, view, order.data()});
    benchmark::DoNotOptimize(view.found);
  }
  for (std::size_t i = 0; i < view.count; ++i) found += view.found[i];
  const auto queries_made = static_cast<double>(queries.size());
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(queries.size()));
  state.counters["photons"] = found / queries_made;
}

/// Sorted by the cells of our map; the time includes the sort, as it does for ours.
void gather_nanoflann(benchmark::State& state, const SceneInterface& w, const PhotonMap& map, const Queries& queries,
                      float radius, bool sorted) {
  const GatherQueue points = gather_points(queries);
  std::vector<std::uint32_t> order = order_given(points.size());
  double found = 0;
  for (auto _ : state) {
    if (sorted) order = cell_order(map, points);
    for (const std::uint32_t i : order) {
      Sum sum{w.cloud, radius * radius, queries.surface[i]};
      const Vec3f p = queries[i];
      w.tree->radiusSearchCustomCallback(&p.x, sum);
      benchmark::DoNotOptimize(sum.flux);
      found += sum.count;
    }
  }
  const auto made = static_cast<double>(state.iterations()) * static_cast<double>(queries.size());
  state.SetItemsProcessed(static_cast<std::int64_t>(made));
  state.counters["photons"] = found / made;
}

template <class Nearest>
void nearest(benchmark::State& state, const Queries& queries, const Nearest& find) {
  for (auto _ : state)
    for (std::size_t i = 0; i < queries.size(); ++i) find(queries[i]);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(queries.size()));
}

void nearest_ours(benchmark::State& state, const SceneInterface& w, const Queries& queries) {
  std::array<PhotonKdTree::Neighbour, photons_in_disc> found;
  nearest(state, queries, [&](const Vec3f& p) {
    benchmark::DoNotOptimize(w.kdtree.nearest(p, std::numeric_limits<float>::max(), found));
    benchmark::DoNotOptimize(found.data());
  });
}

void nearest_nanoflann(benchmark::State& state, const SceneInterface& w, const Queries& queries) {
  std::array<std::uint32_t, photons_in_disc> found;
  std::array<float, photons_in_disc> distances;
  nearest(state, queries, [&](const Vec3f& p) {
    benchmark::DoNotOptimize(w.tree->knnSearch(&p.x, photons_in_disc, found.data(), distances.data()));
    benchmark::DoNotOptimize(found.data());
  });
}

void register_all() {
  std::vector<std::int64_t> counts{100'000, 1'000'000};
  if (std::getenv("PHOTONPROOF_BENCH_LARGE") != nullptr) counts.push_back(10'000'000);
  for (const std::int64_t n : counts) {
    const auto add = [n](const std::string& name, auto body) {
      benchmark::RegisterBenchmark(name.c_str(), body)->Arg(n)->Unit(benchmark::kMillisecond);
    };
    add("photon_build/ours", [](benchmark::State& s) { build_ours(s, 1); });
    add("photon_build/ours_all_threads", [](benchmark::State& s) { build_ours(s, 0); });
    add("photon_build/ours_compact", build_compact);
    add("photon_build/nanoflann", build_nanoflann);
    add("photon_tree_build/ours", [](benchmark::State& s) { build_tree(s, 1); });
    add("photon_tree_build/ours_all_threads", [](benchmark::State& s) { build_tree(s, 0); });
    add("photon_tree_build/nanoflann", build_nanoflann);
    for (const bool coherent : {true, false}) {
      const auto queries = [coherent](const SceneInterface& w) -> const Queries& {
        return coherent ? w.coherent : w.random;
      };
      const std::string how = coherent ? "_coherent" : "_random";
      for (const bool sparse : {false, true}) {
        const std::string task = "photon_gather" + std::string(sparse ? "_sparse" : "") + how;
        const auto radius = [sparse](const SceneInterface& w) { return sparse ? w.radius / sparse_by : w.radius; };
        for (const bool sorted : {false, true}) {
          const auto map = [sparse](const SceneInterface& w) -> const PhotonMap& { return sparse ? w.compact : w.map; };
          add(task + (sorted ? "/ours_sorted" : "/ours"), [=](benchmark::State& s) {
            const SceneInterface& w = scene(s.range(0));
            radiance_estimate(s, map(w), queries(w), radius(w), sorted);
          });
          add(task + (sorted ? "/nanoflann_sorted" : "/nanoflann"), [=](benchmark::State& s) {
            const SceneInterface& w = scene(s.range(0));
            gather_nanoflann(s, w, map(w), queries(w), radius(w), sorted);
          });
        }
      }
      add("photon_nearest" + how + "/ours", [=](benchmark::State& s) {
        const SceneInterface& w = scene(s.range(0));
        nearest_ours(s, w, queries(w));
      });
      add("photon_nearest" + how + "/nanoflann", [=](benchmark::State& s) {
        const SceneInterface& w = scene(s.range(0));
        nearest_nanoflann(s, w, queries(w));
      });
    }
  }
}

[[maybe_unused]] const bool registered = (register_all(), true);

}  // namespace
}  // namespace photonproof::inline renderer_photons
