#include "harness/gates/gate_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <ranges>
#include <span>

#include "harness/cells/folder_lock.h"
#include "harness/cells/host.h"
#include "harness/gates/accepted_verdicts.h"
#include "harness/gates/gate_look.h"
#include "harness/gates/gate_pictures.h"
#include "harness/gates/gates_together.h"
#include "harness/gates/independence.h"
#include "harness/gates/named_fault.h"
#include "harness/images/engine_version.h"
#include "harness/pixels/repeated_images.h"
#include "harness/references/suite_scene.h"
#include "scenes/base/input_error.h"
#include "scenes/description/expect.h"

namespace photonproof::inline harness_gates {
namespace {

namespace fs = std::filesystem;

class Run {
 public:
  Run(const GateSuite& suite, const GateOptions& options, GateObserver& observer)
      : suite_(suite),
        options_(options),
        observer_(observer),
        lock_(options.folder),
        copies_(options.folder),
        host_(describe_host()),
        draw_{.program = options.program,
              .folder = options.folder,
              .seed = options.seed,
              .further = {},
              .processes = usual_executor().at_once(suite.limits.threads),
              .resume = options.resume,
              .interrupt = options.interrupt,
              .copies = &copies_} {}

  GateSummary run() {
    const std::vector<const Gate*> chosen = gates_named(suite_, options_.only);
    begin_record(chosen);
    summary_.interrupted = !draw_first_looks(chosen);
    for (std::size_t i = 0; i < chosen.size() && !summary_.interrupted; ++i) {
      const std::optional<GateRecord> record = decide(i + 1, chosen.size(), *chosen[i]);
      if (!record) {
        summary_.interrupted = true;
        break;
      }
      summary_.results.gates.push_back(*record);
      observer_.ended(i + 1, chosen.size(), *record);
    }
    for (SceneRecord& scene : summary_.results.scenes)
      scene.reference = store_reference(references_.at(scene.name), scene.name, scene.exposure, options_.folder);
    summary_.results.findings = gates_together(summary_.results.gates, suite_);
    summary_.results_file = options_.folder / "results.json";
    write_results(summary_.results_file.string(), summary_.results);
    return std::move(summary_);
  }

 private:
  void begin_record(const std::vector<const Gate*>& chosen) {
    Results& results = summary_.results;
    results.suite = suite_.name;
    results.title = suite_.title;
    results.created = utc_now();
    results.command = options_.command;
    results.host = host_;
    results.versions = options_.versions;
    for (const SuiteScene& scene : suite_.scenes)
      if (std::any_of(chosen.begin(), chosen.end(), [&](const Gate* gate) { return gate->scene == scene.name; }))
        add_scene(scene);
    add_note_on_opaque(chosen);
    for (const Engine& engine : suite_.engines) {
      if (std::none_of(chosen.begin(), chosen.end(), [&](const Gate* gate) { return gate->engine == engine.name; }))
        continue;
      const EngineVersion& version = versions_[engine.name] = ask_version(engine, suite_.folder, options_.program);
      results.engines.push_back({engine.name, engine.title, version.line, to_string(engine.trust)});
    }
  }

  void add_note_on_opaque(const std::vector<const Gate*>& chosen) {
    std::vector<const SuiteScene*> scenes;
    for (const SuiteScene& scene : suite_.scenes)
      if (std::ranges::any_of(chosen, [&](const Gate* gate) { return gate->scene == scene.name; }))
        scenes.push_back(&scene);
    if (auto note = note_on_opaque(scenes)) summary_.results.caveats.push_back(std::move(*note));
  }

  void add_scene(const SuiteScene& scene) {
    const Image& reference = references_.emplace(scene.name, reference_of(scene)).first->second.rendering.mean;
    SceneRecord record;
    record.name = scene.name;
    record.path = scene.given_path;
    const std::optional<Expect>& expected = expectations_[scene.name] = expectations_of(scene);
    record.title = expected ? expected->title : "";
    record.purpose = expected ? expected->purpose : "";
    record.width = reference.width;
    record.height = reference.height;
    const ParameterValues& viewing = viewings_[scene.name] = viewing_of(scene);
    record.exposure = viewing.exposure;
    record.hdr_exposures = viewing.hdr_exposures;
    remove_reference(scene.name, options_.folder);  // until the engines are done
    summary_.results.scenes.push_back(std::move(record));
  }

  ImageStream& stream_of(const Gate& gate) {
    const StoredReference& reference = references_.at(gate.scene);
    return streams_
        .try_emplace(stream_label(gate), suite_, gate,
                     StreamContent{reference.provenance.scene_hash, versions_.at(gate.engine).line,
                                   crop_of(reference.rendering)},
                     reference.provenance.seeds, draw_)
        .first->second;
  }

  /// Draws the first images of every gate; all of the first look where no accepted verdict decides. False when
  /// interrupted.
  bool draw_first_looks(const std::vector<const Gate*>& chosen) {
    if (!draw_for(chosen, [this](const Gate& gate) { return images_to_accept(suite_, gate); })) return false;
    std::vector<const Gate*> open;
    for (const Gate* gate : chosen) {
      if (has_no_images(*gate)) continue;
      Acceptance& acceptance = acceptances_[gate->name];
      acceptance.key = verdict_key(*gate, suite_, references_.at(gate->scene), viewings_.at(gate->scene),
                                   std::span(stream_of(*gate).drawn()).first(images_to_accept(suite_, *gate)));
      if (!options_.fresh) acceptance.kept = find_accepted(acceptance.key);
      if (!acceptance.kept) open.push_back(gate);
    }
    return draw_for(open, [](const Gate& gate) { return static_cast<std::size_t>(gate.seeds); });
  }

  template <class Count>
  bool draw_for(const std::vector<const Gate*>& gates, const Count& count_of) {
    std::map<std::string, StreamDemand> demands;
    for (const Gate* gate : gates)
      if (!versions_.at(gate->engine).problem) {
        StreamDemand& demand = demands[stream_label(*gate)];
        demand = {&stream_of(*gate), std::max(demand.count, count_of(*gate))};
      }
    const auto values = std::views::values(demands);
    return draw_streams(std::vector(values.begin(), values.end()), draw_.processes,
                        [this](std::size_t drawn, std::size_t total) { observer_.draws(drawn, total); });
  }

  bool has_no_images(const Gate& gate) {
    return versions_.at(gate.engine).problem || stream_of(gate).failed() != nullptr;
  }

  /// Empty when interrupted.
  std::optional<GateRecord> decide(std::size_t number, std::size_t total, const Gate& gate) {
    GateRecord record;
    record.name = gate.name;
    record.scene = gate.scene;
    record.engine = gate.engine;
    record.metric = gate.metric;
    record.bound = gate.bound;
    record.alpha = gate.alpha;
    record.command =
        fmt::format("photonproof gate {} --only {} --seed {}", suite_.file.string(), gate.name, options_.seed);
    if (const auto& problem = versions_.at(gate.engine).problem) {
      record.verdict = GateVerdict::fail;
      record.status = Status::not_started;
      record.sentence = *problem;
      return record;
    }
    ImageStream& stream = stream_of(gate);
    const Acceptance& acceptance = acceptances_[gate.name];
    if (acceptance.kept) return as_accepted(gate, *acceptance.kept, stream, record);
    std::vector<const Image*> images;
    for (int look = 0; look < gate.looks; ++look) {
      const std::size_t count = static_cast<std::size_t>(gate.seeds) << look;
      observer_.looks(number, total, gate, count);
      if (!stream.draw(count)) return std::nullopt;
      record.looks = look + 1;
      if (const DrawnImage* failed = stream.failed()) {
        record.status = failed->result.status;
        record.verdict = record.status == Status::unsupported ? GateVerdict::inconclusive : GateVerdict::fail;
        record.sentence = fmt::format("seed {}: {} ({})", failed->result.cell.seed, failed->result.detail,
                                      to_string(failed->result.status));
        record.command = failed->result.command;
        count_images(stream, stream.drawn().size(), record);
        return record;
      }
      images = first_images(stream, count);
      Judgement judgement = look_at(gate, references_.at(gate.scene), viewings_.at(gate.scene), images);
      record.observed = judgement.observed;
      record.sentence = std::move(judgement.sentence);
      record.tiles = std::move(judgement.tiles);
      record.would_see = judgement.would_see;
      record.would_see_in_a_block = judgement.would_see_in_a_block;
      if (!judgement.verdict) continue;
      record.verdict = *judgement.verdict;
      break;
    }
    count_images(stream, images.size(), record);
    name_fault(gate, images, record);
    record.sentence += fmt::format("; {} images of {}", images.size(), gate.budget.label());
    record.regression_only =
        regression_only(suite_.engine(gate.engine), references_.at(gate.scene), expectations_.at(gate.scene));
    if (!record.regression_only.empty()) record.sentence += "; regression only: " + record.regression_only;
    add_pictures(gate, images, stream, record);
    if (record.verdict == GateVerdict::pass) keep(acceptance.key, record);
    return record;
  }

  /// The fault that the images show comes first, unless the sentence states it already.
  void name_fault(const Gate& gate, std::span<const Image* const> images, GateRecord& record) const {
    const StoredReference& reference = references_.at(gate.scene);
    if (record.verdict == GateVerdict::fail && count_repeats(images).different == images.size()) {
      const std::string& extension = suite_.engine(gate.engine).image_extension;
      const bool is_display_file = extension != "exr" && extension != "pfm" && extension != "hdr";
      const auto fault = named_fault(reference.rendering, images, is_display_file);
      const bool states_gain = record.sentence.starts_with("the whole image is off");
      if (fault && !(fault->is_gain && states_gain)) record.sentence = fault->sentence + ": " + record.sentence;
    }
    if (weighs_noise(gate.metric) && has_unknown_noise(reference.provenance))
      record.sentence += "; the reference states no noise, which is estimated from neighbouring pixels";
  }

  /// The verdict is the kept one; its time and its pictures are from the images drawn now.
  GateRecord as_accepted(const Gate& gate, const Results& kept, const ImageStream& stream, const GateRecord& asked) {
    const std::size_t drawn = images_to_accept(suite_, gate);
    GateRecord record = kept.gates[0];
    record.accepted = kept.created;
    record.sentence += fmt::format("; decided {}, and {} the same, bit for bit", kept.created,
                                   drawn == 1 ? "the first image is" : fmt::format("the first {} images are", drawn));
    record.command = asked.command;
    record.seconds = 0;
    record.samples = 0;
    count_images(stream, drawn, record);
    add_pictures(gate, first_images(stream, drawn), stream, record);
    return record;
  }

  /// A verdict that cannot be kept only costs time at the next run.
  void keep(const std::string& key, const GateRecord& record) {
    try {
      keep_accepted(key, summary_.results, record);
    } catch (const InputError& error) {
      const std::string caveat = std::string("passes are not kept for the next run: ") + error.what();
      if (std::ranges::find(summary_.results.caveats, caveat) == summary_.results.caveats.end())
        summary_.results.caveats.push_back(caveat);
    }
  }

  void add_pictures(const Gate& gate, const std::vector<const Image*>& images, const ImageStream& stream,
                    GateRecord& record) const {
    record.skipped = stream.drawn().front()->result.skipped;
    const ParameterValues& viewing = viewings_.at(gate.scene);
    store_pictures(mean_of(images), references_.at(gate.scene), viewing.exposure, parameters_of(gate, viewing),
                   options_.folder, record);
  }

  static std::vector<const Image*> first_images(const ImageStream& stream, std::size_t count) {
    std::vector<const Image*> images;
    for (std::size_t i = 0; i < count; ++i) images.push_back(&stream.drawn()[i]->image);
    return images;
  }

  static void count_images(const ImageStream& stream, std::size_t count, GateRecord& record) {
    for (std::size_t i = 0; i < count; ++i) {
      const Result& result = stream.drawn()[i]->result;
      record.seconds += result.wall_seconds.value_or(0);
      if (result.cell.budget.kind == "spp") record.samples += static_cast<std::uint64_t>(result.cell.budget.amount);
    }
  }

  struct Acceptance {
    std::string key;
    std::optional<Results> kept;
  };

  const GateSuite& suite_;
  const GateOptions& options_;
  GateObserver& observer_;
  FolderLock lock_;
  SceneCopies copies_;
  Host host_;
  DrawOptions draw_;
  std::map<std::string, EngineVersion> versions_;
  std::map<std::string, StoredReference> references_;
  std::map<std::string, ParameterValues> viewings_;
  std::map<std::string, std::optional<Expect>> expectations_;
  std::map<std::string, ImageStream> streams_;
  std::map<std::string, Acceptance> acceptances_;  ///< by gate, once its first images are drawn
  GateSummary summary_;
};

}  // namespace

std::size_t GateSummary::count(GateVerdict verdict) const {
  return static_cast<std::size_t>(std::count_if(results.gates.begin(), results.gates.end(),
                                                [&](const GateRecord& gate) { return gate.verdict == verdict; }));
}

std::size_t GateSummary::accepted() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(results.gates, [](const GateRecord& gate) { return !gate.accepted.empty(); }));
}

GateSummary run_gates(const GateSuite& suite, const GateOptions& options, GateObserver& observer) {
  return Run(suite, options, observer).run();
}

}  // namespace photonproof::inline harness_gates
