#include "harness/gate_self_test.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <random>
#include <span>

#include "harness/engine_version.h"
#include "harness/folder_lock.h"
#include "harness/host.h"
#include "harness/metrics.h"
#include "harness/side_by_side.h"
#include "scenes/input_error.h"

namespace photonproof {
namespace {

constexpr int nulls_a_mutant = 5;
constexpr std::uint64_t seeds_apart = 1000;  // between the runs of variants that draw images of their own

int runs_of(const Variant& variant, const SelfTestOptions& options) {
  return variant.is_mutant || variant.draws_its_own() ? options.runs : nulls_a_mutant * options.runs;
}

bool is_ours(const Engine& engine) { return engine.command.front() == "{photonproof}" && engine.name != "povray"; }

/// Whether the engine can have the fault, or knows the arguments.
bool applies(const Variant& variant, const Engine& engine) {
  if (!variant.draws_its_own()) return true;
  return is_ours(engine) && (variant.fault != "half-photons" || engine.name == "photonmapper");
}

/// Images of one stream, as a variant leaves them, and what one gate knows of each before it looks.
struct Pool {
  std::vector<Image> images;
  bool defective = false;  ///< not finite: every gate fails without looking
};

class SelfTestRun {
 public:
  SelfTestRun(const GateSuite& suite, const SelfTestOptions& options)
      : suite_(suite),
        options_(options),
        lock_(options.gates.folder),
        copies_(options.gates.folder),
        host_(describe_host()) {
    test_.pool = options.pool;
    test_.other_pool = options.other_pool;
    for (const Variant& variant : gate_variants()) test_.variants.push_back(variant);
    gates_ = gates_named(suite, options.gates.only);
    for (const Gate* gate : gates_) {
      test_.gates.push_back(gate->name);
      test_.alphas.push_back(gate->alpha);
      test_.seeds = std::max(test_.seeds, gate->seeds);
    }
    test_.counts.assign(test_.variants.size(), std::vector<VerdictCounts>(gates_.size()));
    test_.any.resize(test_.variants.size());
    for (const Variant& variant : test_.variants)
      found_.emplace_back(static_cast<std::size_t>(runs_of(variant, options)), false);
  }

  SelfTest run() {
    std::vector<std::string> streams;
    for (const Gate* gate : gates_)
      if (std::find(streams.begin(), streams.end(), stream_label(*gate)) == streams.end())
        streams.push_back(stream_label(*gate));
    for (std::size_t i = 0; i < streams.size() && !test_.interrupted; ++i) run_stream(streams[i], i, streams.size());
    for (std::size_t v = 0; v < test_.variants.size(); ++v) {
      test_.any[v].runs = static_cast<int>(found_[v].size());
      test_.any[v].fail = static_cast<int>(std::count(found_[v].begin(), found_[v].end(), true));
    }
    return std::move(test_);
  }

 private:
  void say(std::size_t done, std::size_t total, double part, const std::string& what) const {
    if (options_.progress) options_.progress((static_cast<double>(done) + part) / static_cast<double>(total), what);
  }

  void run_stream(const std::string& label, std::size_t done, std::size_t total) {
    const Gate& first =
        **std::find_if(gates_.begin(), gates_.end(), [&](const Gate* gate) { return stream_label(*gate) == label; });
    const SuiteScene& scene = suite_.scene(first.scene);
    const StoredReference reference = load_reference(scene.path, scene.width, scene.height);
    const Viewing viewing = viewing_of(scene);
    std::optional<Pool> healthy;
    for (std::size_t v = 0; v < test_.variants.size(); ++v) {
      const Variant& variant = test_.variants[v];
      if (!applies(variant, suite_.engine(first.engine))) continue;
      say(done, total, static_cast<double>(v) / static_cast<double>(test_.variants.size()),
          label + ", " + variant.name);
      if (!variant.draws_its_own() && !healthy) {
        healthy = draw_pool(first, reference, variant, 0);
        if (!healthy) return;
      }
      std::optional<Pool> own;
      if (variant.draws_its_own()) {
        own = draw_pool(first, reference, variant, v + 1);
        if (!own) return;
      } else if (variant.change != nullptr) {
        own = changed(*healthy, variant, images_for(variant));
      }
      judge_all(label, reference, viewing, v, own ? *own : *healthy);
    }
  }

  /// As many as make all runs of the variant disjoint.
  std::size_t images_for(const Variant& variant) const {
    return static_cast<std::size_t>(runs_of(variant, options_)) * static_cast<std::size_t>(test_.seeds);
  }

  static Pool changed(const Pool& healthy, const Variant& variant, std::size_t most) {
    Pool pool;
    for (const Image& image : std::span(healthy.images).first(std::min(most, healthy.images.size()))) {
      pool.images.push_back(variant.change(image));
      pool.defective = pool.defective || !find_defects(image, pool.images.back()).empty();
    }
    return pool;
  }

  /// Empty when interrupted.
  std::optional<Pool> draw_pool(const Gate& gate, const StoredReference& reference, const Variant& variant,
                                std::size_t number) {
    GateSuite suite = suite_;
    if (variant.threads > 0) suite.limits.threads = variant.threads;
    DrawOptions draw;
    draw.program = variant.fault.empty() ? options_.gates.program : options_.faulty;
    draw.folder = options_.gates.folder;
    draw.seed = options_.gates.seed + number * seeds_apart;
    draw.fault = variant.fault;
    draw.further = variant.further;
    draw.processes = std::max(1, host_.cores / suite.limits.threads);
    draw.resume = options_.gates.resume;
    draw.interrupt = options_.gates.interrupt;
    draw.copies = &copies_;
    const EngineVersion version = ask_version(suite.engine(gate.engine), suite.folder, options_.gates.program);
    if (version.problem) throw InputError(gate.engine, *version.problem);
    ImageStream stream(suite, gate, {reference.provenance.scene_hash, version.line}, reference.provenance.seeds, draw);
    if (!stream.draw(static_cast<std::size_t>(number == 0 ? options_.pool : options_.other_pool))) {
      test_.interrupted = true;
      return std::nullopt;
    }
    if (const DrawnImage* failed = stream.failed())
      throw InputError(stream_label(gate),
                       variant.name + ": no image: " + failed->result.detail + "; " + failed->result.command);
    Pool pool;
    for (const auto& drawn : stream.drawn()) pool.images.push_back(drawn->image);
    return pool;
  }

  void judge_all(const std::string& label, const StoredReference& reference, const Viewing& viewing, std::size_t v,
                 const Pool& pool) {
    for (std::size_t g = 0; g < gates_.size(); ++g) {
      if (stream_label(*gates_[g]) != label) continue;
      const PoolJudge judge(*gates_[g], reference, viewing, pool.images, pool.defective);
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

  /// The same for every gate of a stream, as in a run of the suite.
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

  /// One gate on a pool: metrics of an image are computed once.
  class PoolJudge {
   public:
    PoolJudge(const Gate& gate, const StoredReference& reference, const Viewing& viewing,
              const std::vector<Image>& images, bool defective)
        : gate_(gate), reference_(reference), viewing_(viewing), images_(images), defective_(defective) {
      if (!defective && is_metric_of_one_image(gate))
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
    const Viewing& viewing_;
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

SelfTest run_self_test(const GateSuite& suite, const SelfTestOptions& options) {
  return SelfTestRun(suite, options).run();
}

}  // namespace photonproof
