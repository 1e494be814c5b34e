#include "harness/gates/gate_self_tests.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <random>
#include <span>

#include "harness/cells/folder_lock.h"
#include "harness/cells/host.h"
#include "harness/cells/side_by_side.h"
#include "harness/images/engine_version.h"
#include "harness/metrics/metrics.h"
#include "harness/pixels/repeated_images.h"
#include "harness/references/suite_scene.h"
#include "scenes/base/faults.h"
#include "scenes/base/input_error.h"

namespace photonproof::inline harness_gates {
namespace {

constexpr int nulls_a_mutant = 5;
constexpr std::uint64_t seeds_apart = 1000;  // between the runs of variants with their own images

int runs_of(const GateVariant& variant, const SelfTestOptions& options) {
  return variant.is_mutant() || variant.draws_its_own() ? options.runs : nulls_a_mutant * options.runs;
}

bool is_ours(const Engine& engine) {
  return engine.command.size() > 1 && engine.command[0] == "{photonproof}" && engine.command[1] == "render";
}

/// The value of --integrator; empty without.
std::string integrator_of(const Engine& engine) {
  const auto option = std::find(engine.command.begin(), engine.command.end(), "--integrator");
  return option == engine.command.end() || option + 1 == engine.command.end() ? "" : *(option + 1);
}

/// Whether the engine can have the fault, or knows the arguments.
bool applies(const GateVariant& variant, const Engine& engine) {
  if (variant.is_fault_of_harness()) return can_have_faults;
  if (!variant.draws_its_own()) return true;
  const std::vector<std::string>& able = variant.integrators;
  return is_ours(engine) && (able.empty() || std::find(able.begin(), able.end(), integrator_of(engine)) != able.end());
}

/// Returns the result of `work`, run with the fault in this process; without a name or without faults, just run.
template <class Work>
auto with_fault(const std::string& name, const Work& work) {
#ifdef PHOTONPROOF_FAULTS
  std::optional<PlantedFault> planted;
  if (!name.empty()) planted.emplace(name);
#else
  (void)name;
#endif
  return work();
}

/// Images of one stream, changed by a variant, and the findings about them before any gate looks.
struct Pool {
  std::vector<Image> images;
  bool defective = false;    ///< not finite or not drawn: every gate fails without a look
  bool out_of_time = false;  ///< one reached its limit of wall time: no gate can judge
};

/// Whether the first `count` images of both are bit-identical.
bool starts_alike(const std::vector<Image>& a, const std::vector<Image>& b, std::size_t count) {
  if (a.size() < count || b.size() < count) return false;
  for (std::size_t i = 0; i < count; ++i)
    if (bytes_of(a[i]) != bytes_of(b[i])) return false;
  return true;
}

class SelfTestRun {
 public:
  SelfTestRun(const GateSuite& suite, const SelfTestOptions& options)
      : suite_(suite),
        options_(options),
        lock_(options.gates.folder),
        copies_(options.gates.folder),
        host_(describe_host()) {
    for (const GateVariant& variant : gate_variants()) test_.variants.push_back(variant);
    test_.unpromised = suite.unpromised;
    gates_ = gates_named(suite, options.gates.only);
    for (const Gate* gate : gates_) {
      test_.gates.push_back(gate->name);
      test_.alphas.push_back(gate->alpha);
      test_.pools.push_back(options.pool.of(stream_label(*gate)));
      test_.seeds = std::max(test_.seeds, gate->seeds);
    }
    test_.counts.assign(test_.variants.size(), std::vector<VerdictCounts>(gates_.size()));
    test_.any.resize(test_.variants.size());
    for (const GateVariant& variant : test_.variants)
      found_.emplace_back(static_cast<std::size_t>(runs_of(variant, options)), false);
  }

  SelfTest run() {
    std::vector<std::string> streams;
    for (const Gate* gate : gates_)
      if (std::find(streams.begin(), streams.end(), stream_label(*gate)) == streams.end())
        streams.push_back(stream_label(*gate));
    for (std::size_t i = 0; i < streams.size() && !test_.interrupted; ++i) run_stream(streams[i], i, streams.size());
    for (std::size_t v = 0; v < test_.variants.size(); ++v) {
      const std::vector<VerdictCounts>& of_gates = test_.counts[v];
      if (std::none_of(of_gates.begin(), of_gates.end(), [](const VerdictCounts& gate) { return gate.runs > 0; }))
        continue;
      test_.any[v].runs = static_cast<int>(found_[v].size());
      test_.any[v].fail = static_cast<int>(std::count(found_[v].begin(), found_[v].end(), true));
    }
    return std::move(test_);
  }

 private:
  void say(std::size_t done, std::size_t total, double part, const std::string& what) const {
    if (options_.progress) options_.progress((static_cast<double>(done) + part) / static_cast<double>(total), what);
  }

  /// One engine's images of one scene and budget.
  struct Stream {
    const Gate& gate;  ///< any of its gates
    std::string label;
    StoredReference reference;
    ParameterValues viewing;
    std::string engine_version;
    std::optional<Pool> healthy{}, with_faulty_kernels{};  ///< once drawn
  };

  void run_stream(const std::string& label, std::size_t done, std::size_t total) {
    const Gate& first =
        **std::find_if(gates_.begin(), gates_.end(), [&](const Gate* gate) { return stream_label(*gate) == label; });
    const SuiteScene& scene = suite_.scene(first.scene);
    const EngineVersion version = ask_version(suite_.engine(first.engine), suite_.folder, options_.gates.program);
    if (version.problem) throw InputError(first.engine, *version.problem);
    Stream stream{first, label, reference_of(scene), viewing_of(scene), version.line};
    for (std::size_t v = 0; v < test_.variants.size() && !test_.interrupted; ++v) {
      const GateVariant& variant = test_.variants[v];
      if (!applies(variant, suite_.engine(first.engine))) continue;
      say(done, total, static_cast<double>(v) / static_cast<double>(test_.variants.size()),
          label + ", " + variant.name);
      if (const std::optional<Pool> pool = pool_of(stream, v))
        with_fault(variant.planted == PlantedIn::judging ? variant.name : "",
                   [&] { return judge_all(stream, v, *pool); });
    }
  }

  /// Empty when interrupted, and where the variant changes nothing.
  std::optional<Pool> pool_of(Stream& stream, std::size_t v) {
    const GateVariant& variant = test_.variants[v];
    if (variant.planted == PlantedIn::nothing && variant.draws_its_own())
      return draw_pool(stream, variant, v + 1, nullptr, options_.other_pool.of(stream.label));
    if (variant.planted == PlantedIn::renderer) {
      std::optional<Pool>& sound = stream.with_faulty_kernels;
      if (!sound) sound = draw_pool(stream, {.further = kernels_for(stream)}, 0, nullptr, test_.seeds);
      if (!sound) return std::nullopt;
      return draw_pool(stream, variant, 0, &*sound, options_.other_pool.of(stream.label));
    }
    if (!stream.healthy) stream.healthy = draw_pool(stream, {}, 0, nullptr, options_.pool.of(stream.label));
    if (!stream.healthy || variant.planted == PlantedIn::nothing) return stream.healthy;
    if (variant.planted == PlantedIn::drawing)
      return with_fault(variant.name, [&] {
        return draw_pool(stream, variant, 0, &*stream.healthy, options_.other_pool.of(stream.label));
      });
    Pool pool = changed(*stream.healthy, variant, images_for(variant));
    const bool alike =
        variant.change != nullptr && starts_alike(pool.images, stream.healthy->images, pool.images.size());
    return alike ? std::nullopt : std::optional(std::move(pool));
  }

  std::vector<std::string> kernels_for(const Stream& stream) const {
    return kernels_with_faults(integrator_of(suite_.engine(stream.gate.engine)));
  }

  /// The number of images that makes all runs of the variant disjoint.
  std::size_t images_for(const GateVariant& variant) const {
    return static_cast<std::size_t>(runs_of(variant, options_)) * static_cast<std::size_t>(test_.seeds);
  }

  static Pool changed(const Pool& healthy, const GateVariant& variant, std::size_t most) {
    Pool pool;
    for (const Image& image : std::span(healthy.images).first(std::min(most, healthy.images.size()))) {
      pool.images.push_back(variant.change != nullptr ? variant.change(image) : image);
      pool.defective = pool.defective || !find_defects(image, pool.images.back()).empty();
    }
    return pool;
  }

  /// Draws a pool with the `number`-th range of seeds. Empty when interrupted, or if the first look equals that of
  /// `sound`.
  std::optional<Pool> draw_pool(const Stream& of, const GateVariant& variant, std::size_t number, const Pool* sound,
                                int count) {
    GateSuite suite = suite_;
    if (variant.threads > 0) suite.limits.threads = variant.threads;
    DrawOptions draw;
    draw.program = options_.gates.program;
    draw.folder = options_.gates.folder;
    draw.seed = options_.gates.seed + number * seeds_apart;
    draw.further = variant.further;
    draw.processes = usual_executor().at_once(suite.limits.threads);
    draw.resume = options_.gates.resume;
    draw.interrupt = options_.gates.interrupt;
    draw.copies = &copies_;
    if (variant.planted == PlantedIn::renderer) {
      draw.program = options_.faulty;
      draw.fault = variant.name;
      draw.further = kernels_for(of);
    }
    ImageStream stream(suite, of.gate, {of.reference.provenance.scene_hash, of.engine_version},
                       of.reference.provenance.seeds, draw);
    Pool pool;
    const auto draw_until = [&](int images) {
      if (!stream.draw(static_cast<std::size_t>(images))) {
        test_.interrupted = true;
        return false;
      }
      for (std::size_t i = pool.images.size(); i < stream.drawn().size(); ++i)
        pool.images.push_back(stream.drawn()[i]->image);
      return true;
    };
    if (sound != nullptr) {
      if (!draw_until(test_.seeds)) return std::nullopt;
      if (starts_alike(pool.images, sound->images, pool.images.size())) return std::nullopt;
    }
    if (!draw_until(count)) return std::nullopt;
    if (const DrawnImage* failed = stream.failed()) {
      if (!variant.is_mutant() || failed->result.status == Status::not_started)
        throw InputError(of.label,
                         variant.name + ": no image: " + failed->result.detail + "; " + failed->result.command);
      (failed->result.status == Status::timeout ? pool.out_of_time : pool.defective) = true;
    }
    return pool;
  }

  void judge_all(const Stream& stream, std::size_t v, const Pool& pool) {
    for (std::size_t g = 0; g < gates_.size(); ++g) {
      if (stream_label(*gates_[g]) != stream.label) continue;
      if (pool.out_of_time) {
        test_.counts[v][g].out_of_time = test_.any[v].out_of_time = true;
        continue;
      }
      const PoolJudge judge(*gates_[g], stream.reference, stream.viewing, pool.images, pool.defective);
      VerdictCounts& counts = test_.counts[v][g];
      const std::size_t runs = found_[v].size(), seeds = static_cast<std::size_t>(gates_[g]->seeds);
      counts.disjoint = static_cast<int>(std::min(runs, pool.images.size() / seeds));
      std::vector<GateVerdict> verdicts(runs);
      side_by_side(runs, host_.cores,
                   [&](std::size_t r) { verdicts[r] = judge.decide(order_of_run(r, v, pool.images.size())); });
      for (std::size_t r = 0; r < runs; ++r) {
        ++counts.runs;
        if (verdicts[r] == GateVerdict::inconclusive) ++counts.inconclusive;
        if (verdicts[r] != GateVerdict::fail) continue;
        ++counts.fail;
        found_[v][r] = true;
      }
    }
  }

  /// The order is the same for every gate of a stream, as in a run of the suite.
  std::vector<std::size_t> order_of_run(std::size_t run, std::size_t variant, std::size_t images) const {
    std::vector<std::size_t> order(images);
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto seeds = static_cast<std::size_t>(test_.seeds);
    if (found_[variant].size() <= images / seeds) {
      std::ranges::rotate(order, order.begin() + static_cast<std::ptrdiff_t>(run * seeds));
    } else {
      std::mt19937_64 random(run * 1'000'003 + variant);
      std::shuffle(order.begin(), order.end(), random);
    }
    return order;
  }

  /// Judges one gate on a pool, computing metrics of an image once.
  class PoolJudge {
   public:
    PoolJudge(const Gate& gate, const StoredReference& reference, const ParameterValues& viewing,
              const std::vector<Image>& images, bool defective)
        : gate_(gate), reference_(reference), viewing_(viewing), images_(images), defective_(defective) {
      if (!defective && !weighs_noise(gate.metric))
        for (const Image& image : images) values_.push_back(metric_of(gate, reference, viewing, image));
    }

    GateVerdict decide(const std::vector<std::size_t>& order) const {
      if (defective_) return GateVerdict::fail;
      for (int look = 0; look < gate_.looks; ++look) {
        const std::size_t count = static_cast<std::size_t>(gate_.seeds) << look;
        if (count > order.size()) break;
        if (const auto verdict = look_at_first(order, count).verdict) return *verdict;
      }
      return GateVerdict::inconclusive;
    }

   private:
    Judgement look_at_first(const std::vector<std::size_t>& order, std::size_t count) const {
      if (!values_.empty()) {
        std::vector<double> values;
        for (std::size_t i = 0; i < count; ++i) values.push_back(values_[order[i]]);
        return look_at_values(gate_, values);
      }
      std::vector<const Image*> images;
      for (std::size_t i = 0; i < count; ++i) images.push_back(&images_[order[i]]);
      return look_at(gate_, reference_, viewing_, images);
    }

    const Gate& gate_;
    const StoredReference& reference_;
    const ParameterValues& viewing_;
    const std::vector<Image>& images_;
    bool defective_;
    std::vector<double> values_;
  };

  const GateSuite& suite_;
  const SelfTestOptions& options_;
  FolderLock lock_;
  SceneCopies copies_;
  Host host_;
  std::vector<const Gate*> gates_;
  std::vector<std::vector<bool>> found_;  ///< by variant and run
  SelfTest test_;
};

}  // namespace

bool can_plant_in_harness() { return can_have_faults; }

SelfTest run_self_test(const GateSuite& suite, const SelfTestOptions& options) {
  return SelfTestRun(suite, options).run();
}

}  // namespace photonproof::inline harness_gates
