#include "harness/gates/gate_accept.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "harness/gates/gate_look.h"
#include "harness/metrics/metrics.h"
#include "harness/references/given_reference.h"
#include "harness/references/suite_scene.h"
#include "harness/suites/suite_rows.h"
#include "reference/store/reference_store.h"
#include "scenes/base/input_error.h"
#include "scenes/base/process.h"
#include "scenes/base/shell_text.h"
#include "scenes/base/size_text.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/scratch_folder.h"

namespace photonproof::inline harness_gates {
namespace {

namespace fs = std::filesystem;

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

/// The scene's committed reference, of any version of the scene; empty without a readable one.
std::optional<StoredReference> committed(const SuiteScene& scene) {
  const fs::path exr = committed_reference_path(stored_beside(scene), scene.width, scene.height);
  const fs::path json = fs::path(exr).replace_extension(".json");
  try {
    const Provenance provenance = parse_provenance(read_file(json), json.string());
    return read_reference(exr, provenance.scene_hash, scene.width, scene.height, "");
  } catch (const InputError&) {
    return std::nullopt;
  }
}

std::string difference(const StoredReference& old, const StoredReference& fresh, double exposure) {
  if (!find_defects(old.rendering.mean, fresh.rendering.mean).empty()) return "the old one cannot be compared";
  std::string text = "new against old:";
  for (const MetricValue& metric :
       compute_metrics(old.rendering.mean, fresh.rendering.mean, {.parameters = {.exposure = exposure}}))
    if (metric.name == "bias" || metric.name == "relmse" || metric.name == "ssim" || metric.name == "max_abs")
      text += fmt::format(" {} {:.3g}", metric.name, metric.value);
  return text;
}

std::string reason_of(const AcceptOptions& options, const std::string& sentence) {
  return fmt::format("{} (accepted by {} for gate {}; {})", trimmed(options.reason), options.who, options.gate,
                     sentence);
}

/// The engine of the old reference renders as many images as it had, else the gate's engine.
std::optional<Accepted> accept_by_engine(const GateSuite& suite, const Gate& gate, const AcceptOptions& options) {
  const SuiteScene& scene = suite.scene(gate.scene);
  const std::optional<StoredReference> old = committed(scene);
  const bool has_engine = old && old->provenance.given && old->provenance.given->files.empty() &&
                          find_named(suite.engines, old->provenance.estimator) != nullptr;
  EngineImages images{suite.engine(has_engine ? old->provenance.estimator : gate.engine), gate.budget};
  if (has_engine) images.count = static_cast<int>(std::max<std::uint64_t>(2, old->provenance.given->images));
  if (has_engine && old->provenance.samples > 0)
    images.budget = {"spp", static_cast<double>(old->provenance.samples) / images.count};
  std::optional<MadeReference> made =
      reference_by_engine(suite, scene, images, {.program = options.program, .interrupt = options.interrupt});
  if (!made) return std::nullopt;
  made->provenance.versions.insert(options.versions.begin(), options.versions.end());
  Accepted accepted;
  accepted.sentence = old ? difference(*old, {made->rendering, made->provenance, {}}, viewing_of(scene).exposure)
                          : "there was no reference";
  accepted.provenance = store_reference_of(scene, *made, reason_of(options, accepted.sentence));
  accepted.file = committed_reference_path(stored_beside(scene), scene.width, scene.height);
  return accepted;
}

}  // namespace

std::optional<Accepted> accept_reference(const GateSuite& suite, const AcceptOptions& options) {
  if (trimmed(options.reason).empty())
    throw InputError("--reason", "say why the reference of '" + options.gate + "' is replaced");
  const Gate* gate = find_named(suite.gates, options.gate);
  if (gate == nullptr) throw InputError("--accept", unknown_name("gate", options.gate, suite.gates));
  const SuiteScene& scene = suite.scene(gate->scene);
  if (scene.is_opaque()) return accept_by_engine(suite, *gate, options);
  const std::optional<StoredReference> old = committed(scene);

  const ScratchFolder scratch("accept");
  const fs::path exr = scratch.path() / "reference.exr";
  std::vector<std::string> argv{options.program.string(),
                                "reference",
                                scene.path.string(),
                                "--size",
                                size_text(scene.width, scene.height),
                                "--fresh",
                                "--quiet",
                                "--witness",  // as --commit asks for
                                "-o",
                                exr.string()};
  if (old) argv.insert(argv.end(), {"--integrator", old->provenance.estimator});  // as independent as the old one
  if (options.standard_error || old)
    argv.insert(argv.end(),
                {"--standard-error",
                 fmt::format("{}", options.standard_error ? *options.standard_error : old->provenance.standard_error)});
  const ProcessOutcome outcome = run_process(argv, {.interrupt = options.interrupt});
  if (outcome.end == ProcessOutcome::End::interrupted) return std::nullopt;
  if (!outcome.ok())
    throw InputError(scene.path.string(), "no new reference: '" + shell_line(argv) + "' " + outcome.sentence() + ": " +
                                              trimmed(outcome.standard_error));
  const fs::path json = fs::path(exr).replace_extension(".json");
  const std::string hash = parse_provenance(read_file(json), json.string()).scene_hash;
  const StoredReference fresh = read_reference(exr, hash, scene.width, scene.height, "");

  Accepted accepted;
  accepted.sentence = old ? difference(*old, fresh, viewing_of(scene).exposure) : "there was no reference";
  accepted.provenance =
      commit_reference(scene.path, fresh.rendering, fresh.provenance, reason_of(options, accepted.sentence));
  accepted.file = committed_reference_path(scene.path, scene.width, scene.height);
  return accepted;
}

std::string name_of_user() {
  const ProcessOutcome git = run_process({"git", "config", "user.name"}, {.wall_limit_seconds = 5});
  if (git.ok() && !trimmed(git.standard_output).empty()) return trimmed(git.standard_output);
  const char* user = std::getenv("USER");
  return user != nullptr && *user != '\0' ? user : "somebody";
}

}  // namespace photonproof::inline harness_gates
