// photonproof reference: a scene's mean image, as certain as asked, with its variance and provenance.
// Exit codes: 0 done, 1 time ran out before the standard error was reached, 2 bad input, 130 interrupted. Finished
// batches are kept, and the same command continues.

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "harness/cells/folder_lock.h"
#include "harness/cells/host.h"
#include "harness/references/reference_estimator.h"
#include "harness/references/reference_run.h"
#include "harness/verbs/engine_output.h"
#include "harness/verbs/interrupt.h"
#include "harness/verbs/scene_options.h"
#include "harness/verbs/suite_reference.h"
#include "harness/verbs/usage/name_hints.h"
#include "harness/verbs/usage/progress.h"
#include "harness/verbs/usage/verb_usage.h"
#include "harness/verbs/verbs.h"
#include "harness/verbs/versions.h"
#include "harness/verify/reference_witness.h"
#include "reference/store/reference_store.h"
#include "renderer/core/version.h"
#include "scenes/base/input_error.h"
#include "scenes/base/json_text.h"
#include "scenes/base/percent_text.h"
#include "scenes/base/process.h"
#include "scenes/description/film_part.h"
#include "scenes/description/output_files.h"
#include "scenes/description/scene_hash.h"
#include "scenes/files/checksum.h"

namespace photonproof::inline harness_verbs {
namespace {

namespace fs = std::filesystem;

struct ReferenceArguments {
  SceneOptions scene;
  double standard_error = 0.005;
  std::string integrator = "auto";
  std::optional<double> seconds;
  int threads = 0;
  std::string output;
  bool commit = false;
  std::string reason;
  bool witness = false, no_witness = false;  ///< neither: with --commit
  bool fresh = false;
  bool json = false;
  std::string progress = "auto";
  SuiteReferenceArguments suite;
};

struct Job {
  const ReferenceArguments& arguments;
  SceneDescription scene;
  std::string hash;
  int width, height;  ///< of the film
  std::optional<FilmPart> crop;
  fs::path program, folder;
  fs::path cached() const { return folder / "reference.exr"; }
  /// The batches' mean and variance, in their place in the film.
  Rendering rendering(const BatchMeans& means) const {
    Rendering mean = means.rendering();
    if (crop) mean.place = crop->place;
    return mean;
  }
};

Job job_of(const ReferenceArguments& arguments) {
  SceneDescription scene = load_scene(arguments.scene);
  const std::string hash = scene_hash(scene);
  const int width = scene.sensor.film.width, height = scene.sensor.film.height;
  const std::optional<FilmPart> crop = crop_of(scene.sensor.film, width, height);
  return {arguments,
          std::move(scene),
          hash,
          width,
          height,
          crop,
          fs::read_symlink("/proc/self/exe"),
          cached_reference_folder(hash, width, height)};
}

/// The reason why `render` refuses the integrator for this scene; empty if it does not.
/// Also why it would lack light, where `whole` light is asked for.
std::string refusal_of(const Job& job, const std::string& integrator, bool whole) {
  std::vector<std::string> argv{job.program.string(), "render", "--integrator", integrator, "--plan", "--json"};
  const std::vector<std::string> scene = scene_arguments(job.arguments.scene);
  argv.insert(argv.end(), scene.begin(), scene.end());
  const ProcessOutcome outcome = run_process(argv);
  if (outcome.ok()) {
    const auto lost = nlohmann::json::parse(outcome.standard_output).at("cannot_find").get<std::vector<std::string>>();
    return whole && !lost.empty() ? lost.front() : "";
  }
  const std::size_t end = outcome.standard_error.find_last_not_of("\r\n");
  return end == std::string::npos ? outcome.sentence() : outcome.standard_error.substr(0, end + 1);
}

std::optional<Expect> expect_of(const Job& job) {
  const std::string path = expect_path_of(job.arguments.scene.path);
  return fs::exists(path) ? std::optional(read_expect(path)) : std::nullopt;
}

std::string integrator_for(const Job& job) {
  if (job.arguments.integrator != "auto") return job.arguments.integrator;
  const auto chosen = [&](bool whole) {
    return choose_estimator(job.scene, expect_of(job),
                            [&](const std::string& name) { return refusal_of(job, name, whole); });
  };
  try {
    return chosen(true);
  } catch (const InputError& nobody) {
    const std::string best = chosen(false);
    std::fprintf(stderr, "warning: the reference lacks light: %s\n", nobody.summary().c_str());
    return best;
  }
}

/// The one in this file, when it is good and by an integrator that will do.
std::optional<StoredReference> kept_reference(const Job& job, const fs::path& file) {
  if (job.arguments.fresh || !fs::exists(file)) return std::nullopt;
  try {
    StoredReference stored = read_reference(file, job.hash, job.width, job.height, "");
    const std::string& asked = job.arguments.integrator;
    if (asked == "auto" || asked == stored.provenance.estimator) return stored;
  } catch (const InputError&) {
    // A damaged one is replaced.
  }
  return std::nullopt;
}

Provenance provenance_of(const Job& job, const std::string& integrator, const BatchMeans& means) {
  Provenance p;
  p.scene_hash = job.hash;
  p.definitions = job.arguments.scene.defines;
  if (job.arguments.scene.as_mitsuba) p.definitions.emplace_back("--as-mitsuba");
  std::sort(p.definitions.begin(), p.definitions.end());
  p.estimator = integrator;
  p.bias = means.relative_bias();
  p.samples = static_cast<std::uint64_t>(means.batches()) * static_cast<std::uint64_t>(means.samples_per_batch());
  for (int batch = 0; batch < means.batches(); ++batch) p.seeds.push_back(batch_seed(batch));
  p.versions = program_versions();
  const Host host = describe_host();
  p.host = host.cpu + ", " + std::to_string(host.cores) + " cores, " + host.os;
  p.date = utc_now();
  return p;
}

ReferenceProgress render(const Job& job, const std::string& integrator, double standard_error,
                         std::optional<double> seconds) {
  Checksum version;
  version.add(version_line().data(), version_line().size());
  ReferenceRun run;
  run.program = job.program;
  run.scene.name = "scene";
  run.scene.path = job.arguments.scene.path;
  run.scene.width = job.width;
  run.scene.height = job.height;
  run.content = job.hash;
  run.crop = job.crop;
  run.arguments = scene_arguments(job.arguments.scene);
  run.arguments.erase(run.arguments.begin());  // the file
  run.integrator = integrator;
  run.standard_error = standard_error;
  run.seconds = seconds;
  run.threads = job.arguments.threads;
  run.folder = job.folder / (integrator + "-" + version.hex());
  run.interrupt = &interrupt_flag();
  Progress progress(job.arguments.progress);
  run.progress = [line = progress.callback(), &run](const BatchMeans& means, std::optional<double> error) {
    if (!line) return;
    // The square of the error falls as one over the batches; the least number of them takes as long as it takes.
    const double by_error = error && *error > 0 ? run.standard_error * run.standard_error / (*error * *error) : 1;
    const double by_count = double(means.batches()) / least_batches;
    line(error ? std::min({by_error, by_count, 0.999}) : 0,
         run.integrator + ", " + std::to_string(means.batches()) + " batches of " +
             std::to_string(means.samples_per_batch()) + " samples" +
             (error ? ", standard error " + percent_text(*error) + " of " + percent_text(run.standard_error) : ""));
  };
  if (job.arguments.fresh) fs::remove_all(run.folder);
  fs::create_directories(run.folder);
  return run_reference(run);
}

void print(const Job& job, const Provenance& p, const std::vector<fs::path>& files, bool reached) {
  if (job.arguments.json) {
    nlohmann::ordered_json json = {{"files", nlohmann::json::array()}, {"reached", reached}};
    for (const fs::path& file : files) json["files"].push_back(file.string());
    json["provenance"] = nlohmann::ordered_json::parse(provenance_text(p));
    std::printf("%s\n", json_text(json).c_str());
    return;
  }
  const std::string bias = p.bias > 0 ? ", bias " + percent_text(p.bias) : "";
  std::printf("%s: %s, %dx%d, %zu batches of %llu samples, standard error %s%s\n", job.arguments.scene.path.c_str(),
              p.estimator.c_str(), p.width, p.height, p.seeds.size(),
              static_cast<unsigned long long>(p.samples / p.seeds.size()), percent_text(p.standard_error).c_str(),
              bias.c_str());
  if (p.witness) std::printf("second estimator: %s\n", facts(p).at("witness").c_str());
  for (const fs::path& file : files) std::printf("reference: %s\n", file.c_str());
}

/// Thrown when the witness was interrupted or has no time: what is finished is kept.
struct NoWitnessYet {
  ReferenceProgress progress;
};

/// A second estimator that shares no sampling with the first must agree; it needs a third of its certainty, and has as
/// long as is left. Throws InputError where the two disagree, since neither can then be believed.
void find_witness(const Job& job, const Rendering& rendering, Provenance& provenance) {
  constexpr double less_certain = 3;
  const std::string witness = witness_for(job.scene, provenance.estimator, expect_of(job),
                                          [&](const std::string& name) { return refusal_of(job, name, true); });
  if (witness.empty()) {
    if (job.arguments.progress != "none")
      std::fprintf(stderr, "no second estimator: only %s's way of finding light renders this scene\n",
                   provenance.estimator.c_str());
    return;
  }
  const double certainty = less_certain * std::max(job.arguments.standard_error, provenance.standard_error);
  const ReferenceProgress progress = render(job, witness, certainty, job.arguments.seconds);
  if (progress.means.batches() < least_batches) throw NoWitnessYet{progress};
  const Rendering second = progress.means.rendering();
  const PairTest test = test_witness(rendering, provenance.bias, second);
  if (test.differs || test.is_undecided)
    throw InputError(job.arguments.scene.path,
                     provenance.estimator + " and " + witness + " disagree, so that no reference is stored: " +
                         (test.differs ? witness + " is " : "") + test.sentence +
                         "; `photonproof verify` finds which is wrong, " + "--no-witness skips this check");
  provenance.witness = {witness,
                        static_cast<std::uint64_t>(progress.means.batches()) *
                            static_cast<std::uint64_t>(progress.means.samples_per_batch()),
                        relative_standard_error(second), std::nullopt};
  if (test.would_see && std::isfinite(*test.would_see)) provenance.witness->would_see = test.would_see;
}

/// `kept` is the file that holds it.
int write_out(const Job& job, const fs::path& kept, const Rendering& rendering, Provenance provenance, bool reached) {
  const ReferenceArguments& arguments = job.arguments;
  if ((arguments.witness || (arguments.commit && !arguments.no_witness)) && !provenance.witness) {
    find_witness(job, rendering, provenance);
    if (provenance.witness && kept == job.cached())
      provenance = write_reference(kept, rendering, provenance, ReferenceSamples::floats);
  }
  std::vector<fs::path> files{kept};
  if (!arguments.output.empty()) {
    write_reference(arguments.output, rendering, provenance, ReferenceSamples::floats);
    files.emplace_back(arguments.output);
  }
  if (arguments.commit) {
    commit_reference(arguments.scene.path, rendering, provenance, arguments.reason);
    files.push_back(committed_reference_path(arguments.scene.path, job.width, job.height));
  }
  print(job, provenance, files, reached);
  if (std::hypot(provenance.standard_error, provenance.bias) > 1.5 * arguments.standard_error && reached) {
    std::fprintf(stderr, "more batches do not reduce the bias of %s; a smaller --standard-error makes batches longer\n",
                 percent_text(provenance.bias).c_str());
    return 1;
  }
  if (reached) return 0;
  std::fprintf(stderr, "time ran out before the standard error reached %s; the same command continues\n",
               percent_text(arguments.standard_error).c_str());
  return 1;
}

/// Two runs of one estimator: the longer one is better, whatever its estimate of its error. The smaller estimate may
/// belong to a run that has not met its rare bright samples yet.
bool is_better(const Provenance& cached, const Provenance& fresh, double standard_error) {
  if (cached.estimator == fresh.estimator) return cached.samples >= fresh.samples;
  return cached.standard_error <= standard_error;
}

int unfinished(const ReferenceProgress& progress) {
  const bool interrupted = progress.end == ReferenceProgress::End::interrupted;
  std::fprintf(stderr, "%s: kept %d finished batches%s; the same command continues\n",
               interrupted ? "interrupted" : "time ran out", progress.means.batches(),
               progress.standard_error ? (", standard error " + percent_text(*progress.standard_error)).c_str() : "");
  return interrupted ? 130 : 1;
}

/// Refuses now what would else be refused after minutes of rendering.
void check_before_rendering(const Job& job) {
  const ReferenceArguments& arguments = job.arguments;
  const fs::path committed = committed_reference_path(arguments.scene.path, job.width, job.height);
  std::vector<InputFile> inputs = scene_inputs(job.scene);
  if (arguments.commit) {
    check_committable(arguments.scene.path, job.width, job.height);
    prepare_outputs({committed, provenance_path(committed)}, inputs);
  }
  if (arguments.output.empty()) return;
  for (const fs::path& beside : {committed, provenance_path(committed)})
    inputs.push_back({beside, "the scene's committed reference"});
  prepare_outputs({arguments.output, provenance_path(arguments.output)}, inputs);
}

/// The same of what cannot be known before it is known that there is something to render: a good reference is not
/// replaced without a word.
void check_reason(const Job& job) {
  const ReferenceArguments& arguments = job.arguments;
  if (arguments.commit && arguments.reason.empty() &&
      has_good_commit(arguments.scene.path, job.hash, job.width, job.height))
    throw InputError(committed_reference_path(arguments.scene.path, job.width, job.height).string(), reason_is_missing);
}

int reference_of(const ReferenceArguments& arguments) {
  interrupt_flag();
  if (!arguments.output.empty()) check_extension(arguments.output, ".exr", "an EXR");
  if (!arguments.reason.empty() && !arguments.commit) throw InputError("--reason", "is for --commit");
  if (!arguments.scene.defines.empty() && arguments.commit)
    throw InputError("--commit", "is for the scene as it is, without -D; the cache keeps this reference, or -o FILE");
  if (arguments.scene.as_mitsuba && arguments.commit)
    throw InputError("--commit",
                     "is for the scene as it is, without --as-mitsuba; the cache keeps this reference, or -o FILE");
  const Job job = job_of(arguments);
  check_before_rendering(job);
  const FolderLock lock(job.folder, "it makes the same reference: wait for it, then this command uses what it made");
  const auto is_enough = [&](const std::optional<StoredReference>& kept) {
    return kept && kept->provenance.standard_error <= arguments.standard_error;
  };
  const std::optional<StoredReference> cached = kept_reference(job, job.cached());
  if (is_enough(cached)) return write_out(job, cached->file, cached->rendering, cached->provenance, true);
  if (!arguments.commit) {
    const auto committed = kept_reference(job, committed_reference_path(arguments.scene.path, job.width, job.height));
    if (is_enough(committed)) return write_out(job, committed->file, committed->rendering, committed->provenance, true);
  }

  check_reason(job);
  const std::string integrator = integrator_for(job);
  const ReferenceProgress progress = render(job, integrator, arguments.standard_error, arguments.seconds);
  using End = ReferenceProgress::End;
  if (progress.end == End::interrupted || progress.means.batches() < least_batches) return unfinished(progress);
  const Rendering rendering = job.rendering(progress.means);
  Provenance provenance = provenance_of(job, integrator, progress.means);
  if (cached && is_better(cached->provenance, provenance, *progress.standard_error))
    return write_out(job, cached->file, cached->rendering, cached->provenance, false);
  provenance = write_reference(job.cached(), rendering, provenance, ReferenceSamples::floats);
  return write_out(job, job.cached(), rendering, provenance, progress.end == End::reached);
}

int make_reference(const ReferenceArguments& arguments) {
  if (arguments.suite.any() || fs::path(arguments.scene.path).extension() == ".toml")
    return make_suite_reference(arguments.scene.path, arguments.suite, arguments.reason, arguments.json,
                                arguments.progress);
  try {
    return reference_of(arguments);
  } catch (const NoWitnessYet& late) {
    return unfinished(late.progress);
  }
}

void add_suite_options(CLI::App& verb, SuiteReferenceArguments& arguments) {
  begin_option_group(verb, "A suite's scene: its reference is stored beside it, or in references/ beside the suite");
  verb.add_option("--scene", arguments.scene, "name of the scene in the suite (default: the only one)")
      ->type_name("NAME");
  auto* from = verb.add_option("--from", arguments.from, "golden image, or several whose mean is the reference")
                   ->type_name("IMAGE...");
  verb.add_option("--variance", arguments.variance, "image of the mean's variance, linear (default: unknown)")
      ->needs(from)
      ->type_name("IMAGE");
  verb.add_option("--transfer", arguments.transfer,
                  "encoding of the images' values (default: srgb for 8 and 16 bits, else linear)")
      ->needs(from)
      ->check(one_of({"srgb", "gamma22", "linear"}));
  verb.add_option("--engine", arguments.engine, "engine of the suite that renders the reference")
      ->excludes(from)
      ->type_name("NAME");
  verb.add_option("--budget", arguments.budget, "budget of one image (default: that of the scene's first gate or run)")
      ->type_name("KIND=AMOUNT");
  verb.add_option("--images", arguments.images, "images of independent seeds that --engine renders")
      ->check(CLI::Range(2, 65536))
      ->capture_default_str();
}

void add_reference_options(CLI::App& verb, ReferenceArguments& arguments) {
  begin_option_group(verb, output_group);
  verb.add_option("-o,--output", arguments.output, "EXR to write besides the cache's, with its provenance as .json");
  verb.add_flag("--commit", arguments.commit,
                "write reference-WxH.exr and .json beside the scene, in half floats (256x256 at most)");
  verb.add_option("--reason", arguments.reason,
                  "why --commit replaces a good reference; the provenance keeps the reason");
  verb.add_flag("--json", arguments.json, "print files and provenance as JSON");
  begin_option_group(verb, "Method");
  verb.add_option("--standard-error", arguments.standard_error,
                  "relative standard error to reach, over the whole image")
      ->check(CLI::Range(1e-6, 1.0))
      ->check(is_finite_number)
      ->capture_default_str();
  verb.add_option("--integrator", arguments.integrator,
                  "an unbiased one, auto to choose by the scene, or photonmapper with its bias stated")
      ->check(one_of({"auto", "path", "bdpt", "volpath", "ptracer", "photonmapper"}))
      ->capture_default_str();
  auto* witness = verb.add_flag("--witness", arguments.witness,
                                "require a second, independent estimator to agree (default: with --commit)");
  verb.add_flag("--no-witness", arguments.no_witness, "skip the check by a second estimator")->excludes(witness);
  begin_option_group(verb, run_group);
  verb.add_option("--seconds", arguments.seconds, "wall time after which it stops; the same command continues")
      ->check(CLI::Range(1e-3, 1e7))
      ->check(is_finite_number);
  verb.add_flag("--fresh", arguments.fresh, "begin anew, without what the cache has");
  verb.add_option("--threads", arguments.threads, "worker threads (default: every core)")->check(CLI::Range(0, 1024));
  add_progress_option(verb, arguments.progress);
  add_quiet_option(verb, arguments.progress);
}

}  // namespace

void add_reference_verb(CLI::App& program, int& exit_code) {
  auto arguments = std::make_shared<ReferenceArguments>();
  CLI::App* verb = add_verb(
      program, {.name = "reference",
                .group = render_group,
                .purpose = "Render a scene's mean image to a stated standard error, with its provenance",
                .examples = {"photonproof reference scenes/library/cornell/scene.xml --standard-error 0.01 -o mean.exr",
                             "photonproof reference scenes/library/cornell/scene.xml --size 64x64 --commit",
                             "photonproof reference gates.toml --scene ball --from golden.exr"},
                .exit_codes = {done,
                               {1, "the standard error was not reached in time; the same command continues"},
                               {2, "bad input or usage, or the two estimators disagree"},
                               internal_error,
                               interrupted_and_kept},
                .notes = "The standard error is sqrt(mean of variance / (mean^2 + 0.01)) over pixels and channels."});
  add_scene_options(*verb, arguments->scene);
  add_mitsuba_option(*verb, arguments->scene);
  add_reference_options(*verb, *arguments);
  add_suite_options(*verb, arguments->suite);
  verb->callback([arguments, &exit_code] { exit_code = make_reference(*arguments); });
}

}  // namespace photonproof::inline harness_verbs
