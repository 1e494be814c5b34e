#include "reference/cycles/cycles_engine.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <string_view>
#include <utility>

#include "scenes/base/input_error.h"
#include "scenes/base/process.h"
#include "scenes/files/scratch_folder.h"
#include "scenes/images/mean_error.h"

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

/// Image `i` of the run.
Image batch_image(const CyclesExport& scene, const fs::path& folder, std::size_t i) {
  const fs::path file = folder / ("batch_" + std::to_string(i) + ".exr");
  const auto failed = [&](const std::string& why) {
    return EngineFailure(EngineFailure::Kind::failed, "Blender ended well and " + why);
  };
  if (!fs::exists(file)) throw failed("wrote no image " + file.filename().string());
  Image image;
  try {
    image = read_image(file.string());
  } catch (const InputError& error) {
    throw failed("left an image that cannot be read: " + error.summary());
  }
  if (image.width != scene.width || image.height != scene.height)
    throw failed("wrote an image of " + std::to_string(image.width) + "x" + std::to_string(image.height) + " where " +
                 std::to_string(scene.width) + "x" + std::to_string(scene.height) + " was asked for");
  return kept_part(scene.film, image);
}

/// A share of the samples.
double weight_of(const CyclesExport& scene, std::size_t batch) {
  return double(scene.batches[batch].samples) / scene.samples;
}

/// Variance of the weighted mean over at least two batches, from their spread. A batch's variance is assumed to be
/// proportional to 1 / samples.
template <class Value>
double variance_of_mean(const CyclesExport& scene, double mean, const Value& value) {
  double sum = 0;
  for (std::size_t i = 0; i < scene.batches.size(); ++i) sum += weight_of(scene, i) * std::pow(value(i) - mean, 2);
  return sum / double(scene.batches.size() - 1);
}

/// Pools batches weighted by their samples: the mean, its variance, and the standard error of the image's mean.
Rendering pooled_batches(const CyclesExport& scene, const std::vector<Image>& images) {
  Rendering out;
  out.mean = Image(images.front().width, images.front().height);
  const std::size_t count = images.size();
  if (count > 1) out.variance = out.mean;
  std::vector<std::array<double, 3>> totals(count);
  for (std::size_t k = 0; k < out.mean.rgb.size(); ++k) {
    double mean = 0;
    for (std::size_t i = 0; i < count; ++i) {
      mean += weight_of(scene, i) * double{images[i].rgb[k]};
      totals[i][k % 3] += double{images[i].rgb[k]};
    }
    out.mean.rgb[k] = static_cast<float>(mean);
    if (count > 1)
      out.variance->rgb[k] =
          static_cast<float>(variance_of_mean(scene, mean, [&](std::size_t i) { return double{images[i].rgb[k]}; }));
  }
  if (count < 2) return out;
  MeanError error;
  error.passes = double(count);
  const auto pixels = double(out.mean.pixels());
  for (std::size_t c = 0; c < 3; ++c) {
    double mean = 0;
    for (std::size_t i = 0; i < count; ++i) mean += weight_of(scene, i) * totals[i][c] / pixels;
    error.standard_error[c] =
        std::sqrt(variance_of_mean(scene, mean, [&](std::size_t i) { return totals[i][c] / pixels; }));
  }
  store_mean_error(out, error);
  return out;
}

/// Calls `progress` with the share of batches that the script reports as done on standard error.
struct Progress {
  std::size_t batches;
  std::function<void(double, const std::string&)> progress;
  std::string text{};

  void operator()(std::string_view chunk) {
    constexpr std::string_view start = "photonproof: ";
    text += chunk;
    for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n')) {
      int done = 0;
      if (text.starts_with(start)) std::from_chars(text.data() + start.size(), text.data() + end, done);
      if (done > 0 && progress) progress(std::min(1.0, double(done) / double(batches)), "Cycles");
      text.erase(0, end + 1);
    }
  }
};

/// Standard error of the mean over pixels and channels, as a share of it.
double relative_error_of_mean(const CyclesExport& scene, const std::vector<Image>& images) {
  double mean = 0;
  std::vector<double> totals;
  for (std::size_t i = 0; i < images.size(); ++i) {
    double total = 0;
    for (const float value : images[i].rgb) total += double{value};
    totals.push_back(total);
    mean += weight_of(scene, i) * total;
  }
  if (images.size() < 2 || !(mean > 0)) return 0;
  return std::sqrt(variance_of_mean(scene, mean, [&](std::size_t i) { return totals[i]; })) / mean;
}

}  // namespace

std::string blender_error(const std::string& console) {
  // A traceback's last line has the exception; Blender's own lines start with their kind.
  const std::size_t trace = console.rfind("Traceback (most recent call last):");
  if (trace != std::string::npos) {
    for (std::size_t at = console.find('\n', trace); at != std::string::npos;) {
      const std::size_t start = at + 1, end = std::min(console.find('\n', start), console.size());
      if (start >= console.size()) break;
      if (console[start] != ' ' && console[start] != '\n') return console.substr(start, end - start);
      at = end < console.size() ? end : std::string::npos;
    }
  }
  return line_with(console, "Error: ");
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
  process.on_stderr = Progress{scene.batches.size(), options.progress};
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
  std::vector<Image> images;
  for (std::size_t i = 0; i < scene.batches.size(); ++i) images.push_back(batch_image(scene, folder.path(), i));
  run.rendering = pooled_batches(scene, images);
  run.relative_standard_error = relative_error_of_mean(scene, images);
  run.rendering.place = kept_place(scene.film);
  run.rendering.metadata["photonproof:batches"] = std::to_string(images.size());
  run.rendering.metadata["photonproof:version"] = run.version;
  run.rendering.metadata["photonproof:command"] = run.command;
  run.defects = find_non_finite(run.rendering.mean, "Cycles found no number");
  return run;
}

}  // namespace photonproof::inline reference_cycles
