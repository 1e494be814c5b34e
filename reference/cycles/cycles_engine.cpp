#include "reference/cycles/cycles_engine.h"

#include <algorithm>
#include <filesystem>
#include <string_view>

#include "reference/engines/batches.h"
#include "scenes/base/process.h"
#include "scenes/files/scratch_folder.h"

namespace photonproof::inline reference_cycles {
namespace {

namespace fs = std::filesystem;

std::string line_with(const std::string& text, std::string_view start) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    if (text.compare(at, start.size(), start) == 0) return text.substr(at, end - at);
    at = end + 1;
  }
  return "";
}

}  // namespace

std::string blender_error(const std::string& console) {
  // A traceback's last line has the exception; Blender's own lines start with their kind.
  const std::string exception = python_exception(console);
  return exception.empty() ? line_with(console, "Error: ") : exception;
}

CyclesRun render_cycles(const CyclesExport& scene, const CyclesRunOptions& options) {
  const ScratchFolder folder("cycles");
  write_script(scene, folder.path() / "scene.py");
  // -b: no window. A fixed start ignores the user's settings. An exception in the script is a failure.
  // Blender resolves a relative name against the folder that its caller's shell was in.
  std::vector<std::string> argv{options.program,
                                "-b",
                                "--factory-startup",
                                "--python-exit-code",
                                "1",
                                "--python",
                                (folder.path() / "scene.py").string()};
  ProcessOptions process;
  process.wall_limit_seconds = options.wall_limit_seconds;
  process.memory_limit_bytes = options.memory_limit_bytes;
  process.interrupt = options.interrupt;
  process.working_folder = folder.path();
  process.on_stderr = BatchProgress{scene.batches.size(), "Cycles", options.progress};
  const ProcessOutcome outcome = run_process(argv, process);
  if (!outcome.ok())
    report_failure({"Blender", options.program, "blender"}, outcome,
                   blender_error(outcome.standard_output + "\n" + outcome.standard_error));
  CyclesRun run;
  run.version = line_with(outcome.standard_output, "Blender ");
  argv.back() = "scene.py";
  run.command = command_line(argv);
  run.wall_seconds = outcome.wall_seconds;
  run.cpu_seconds = outcome.cpu_seconds;
  run.peak_bytes = outcome.peak_bytes;
  const std::vector<Image> images =
      read_batches({scene.width, scene.height, scene.film, scene.batches}, folder.path(), "Blender");
  run.rendering = pooled_batches(scene.batches, images);
  run.relative_standard_error = relative_error_of_mean(scene.batches, images);
  run.rendering.place = kept_place(scene.film);
  run.rendering.metadata["photonproof:batches"] = std::to_string(images.size());
  run.rendering.metadata["photonproof:version"] = run.version;
  run.rendering.metadata["photonproof:command"] = run.command;
  run.defects = find_non_finite(run.rendering.mean, "Cycles found no number");
  return run;
}

}  // namespace photonproof::inline reference_cycles
