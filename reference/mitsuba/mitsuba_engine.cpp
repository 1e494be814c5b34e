#include "reference/mitsuba/mitsuba_engine.h"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "scenes/base/input_error.h"
#include "scenes/base/process.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/scratch_folder.h"

namespace photonproof::inline reference_mitsuba {
namespace {

namespace fs = std::filesystem;

/// Bytes of the script's report: some hundred.
constexpr std::size_t most_facts = 1 << 16;

/// The script's message: an exception's, or its own.
std::string said(const std::string& console) {
  const std::string exception = python_exception(console);
  if (!exception.empty()) return exception;
  const std::size_t at = console.rfind("Error: ");
  return at == std::string::npos ? "" : console.substr(at, console.find('\n', at) - at);
}

void read_facts(const fs::path& file, MitsubaRun& run) {
  try {
    const auto facts = nlohmann::json::parse(read_file(file, most_facts));
    run.version = facts.at("version").get<std::string>();
    run.variant = facts.at("variant").get<std::string>();
    run.import_seconds = facts.at("import_seconds").get<double>();
    run.load_seconds = facts.at("load_seconds").get<double>();
    run.compile_seconds = facts.at("compile_seconds").get<double>();
    run.render_seconds = facts.at("render_seconds").get<double>();
  } catch (const InputError&) {
    throw EngineFailure(EngineFailure::Kind::failed, "Mitsuba ended well and left no engine.json");
  } catch (const nlohmann::json::exception&) {
    throw EngineFailure(EngineFailure::Kind::failed, "Mitsuba ended well and left an engine.json that cannot be read");
  }
}

}  // namespace

MitsubaRun render_mitsuba(const MitsubaExport& scene, const MitsubaRunOptions& options) {
  const ScratchFolder folder("mitsuba");
  write_mitsuba(scene, folder.path() / "scene.xml");
  write_file_atomically(folder.path() / "options.json", mitsuba_job(scene));
  write_file_atomically(folder.path() / "render.py", mitsuba_script());
  const std::vector<std::string> argv{options.python, "render.py", "scene.xml", "options.json", "."};
  ProcessOptions process;
  process.wall_limit_seconds = options.wall_limit_seconds;
  process.memory_limit_bytes = options.memory_limit_bytes;
  process.interrupt = options.interrupt;
  process.working_folder = folder.path();
  process.on_stderr = BatchProgress{scene.picture.batches.size(), "Mitsuba", options.progress};
  const ProcessOutcome outcome = run_process(argv, process);
  if (outcome.end == ProcessOutcome::End::not_started)
    throw InputError(options.python, "the Python that has Mitsuba cannot be run (" + outcome.cause + ")");
  if (!outcome.ok())
    report_failure({"Mitsuba", options.python, ""}, outcome,
                   said(outcome.standard_output + "\n" + outcome.standard_error));
  MitsubaRun run;
  read_facts(folder.path() / "engine.json", run);
  run.command = command_line(argv);
  run.wall_seconds = outcome.wall_seconds;
  run.cpu_seconds = outcome.cpu_seconds;
  run.peak_bytes = outcome.peak_bytes;
  const std::vector<Image> images = read_batches(scene.picture, folder.path(), "Mitsuba");
  run.rendering = pooled_batches(scene.picture.batches, images);
  run.relative_standard_error = relative_error_of_mean(scene.picture.batches, images);
  run.rendering.place = kept_place(scene.picture.film);
  run.rendering.metadata["photonproof:batches"] = std::to_string(images.size());
  run.rendering.metadata["photonproof:version"] = run.version;
  run.rendering.metadata["photonproof:variant"] = run.variant;
  run.rendering.metadata["photonproof:command"] = run.command;
  run.defects = find_non_finite(run.rendering.mean, "Mitsuba found no number");
  return run;
}

}  // namespace photonproof::inline reference_mitsuba
