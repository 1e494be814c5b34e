#include "reference/povray/povray_engine.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "reference/engines/engine_run.h"
#include "scenes/base/process.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/scratch_folder.h"

namespace photonproof::inline reference_povray {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> command(const PovrayExport& scene, const std::string& program) {
  // +FE: linear half floats. -D: no window. -P: no pause. +V: progress. +WT1: one thread, which makes it repeatable.
  std::vector<std::string> argv{program,
                                "+Iscene.pov",
                                "+Oscene.exr",
                                "+FE",
                                "+W" + std::to_string((scene.width + 2 * scene.margin) * scene.grid),
                                "+H" + std::to_string((scene.height + 2 * scene.margin) * scene.grid),
                                "-D",
                                "-P",
                                "+V",
                                "+WT1",
                                "+GSstatistics.txt"};
  argv.insert(argv.end(), scene.antialias.begin(), scene.antialias.end());
  return argv;
}

void add(const PovrayRun& part, PovrayRun& run) {
  for (std::size_t i = 0; i < run.rendering.mean.rgb.size(); ++i)
    run.rendering.mean.rgb[i] += part.rendering.mean.rgb[i];
  run.wall_seconds += part.wall_seconds;
  run.cpu_seconds += part.cpu_seconds;
  run.peak_bytes = std::max(run.peak_bytes, part.peak_bytes);
}

}  // namespace

Image box_downsample(const Image& image, int grid, double gain) {
  Image result(image.width / grid, image.height / grid);
  const double weight = gain / (static_cast<double>(grid) * grid);
  for (int y = 0; y < result.height; ++y)
    for (int x = 0; x < result.width; ++x) {
      RgbD sum(0.0);
      for (int j = 0; j < grid; ++j)
        for (int i = 0; i < grid; ++i) {
          const float* p = image.pixel(x * grid + i, y * grid + j);
          sum += RgbD(p[0], p[1], p[2]);
        }
      float* out = result.pixel(x, y);
      out[0] = static_cast<float>(sum.x * weight);
      out[1] = static_cast<float>(sum.y * weight);
      out[2] = static_cast<float>(sum.z * weight);
    }
  return result;
}

Image variance_of_blocks(const Image& image, int grid, double gain) {
  Image result(image.width / grid, image.height / grid);
  const double count = static_cast<double>(grid) * grid;
  for (int y = 0; y < result.height; ++y)
    for (int x = 0; x < result.width; ++x)
      for (int c = 0; c < 3; ++c) {
        double sum = 0, squares = 0;
        for (int j = 0; j < grid; ++j)
          for (int i = 0; i < grid; ++i) {
            const double value = gain * double{image.pixel(x * grid + i, y * grid + j)[c]};
            sum += value;
            squares += value * value;
          }
        result.pixel(x, y)[c] = static_cast<float>(std::max(0.0, squares - sum * sum / count) / (count * (count - 1)));
      }
  return result;
}

namespace {

/// Mitchell and Netravali 1988, equation 8, for x >= 0: by powers of 1 - x up to 1, and of 2 - x beyond.
double cubic_weight(double x, double b, double c) {
  if (x >= 2) return 0;
  if (x >= 1) return (2 - x) * (2 - x) * ((b + 6 * c) * (2 - x) - 6 * c) / 6;
  const double y = 1 - x;
  return (b + (3 * b + 6 * c) * y + (18 - 15 * b - 12 * c) * y * y - (12 - 9 * b - 6 * c) * y * y * y) / 6;
}

double windowed_sinc(double x, double radius, double tau) {
  const auto sinc = [](double of) { return of == 0 ? 1 : std::sin(std::numbers::pi * of) / (std::numbers::pi * of); };
  return x < radius ? sinc(x) * sinc(x / tau) : 0;
}

/// A filter's value at a distance in pixels, up to a factor.
double weight_at(const ReconstructionFilter& filter, double distance) {
  using Kind = ReconstructionFilter::Kind;
  const double x = std::abs(distance), s = filter.stddev;
  switch (filter.kind) {
    case Kind::box:
      return x < 0.5 ? 1 : 0;
    case Kind::tent:
      return std::max(0.0, filter.radius - x);
    case Kind::gaussian:
      return x < 4 * s ? std::exp(-x * x / (2 * s * s)) - std::exp(-8.0) : 0;
    case Kind::mitchell:
      return cubic_weight(x * 2 / filter.mitchell_radius.value_or(2), filter.b, filter.c);
    case Kind::catmullrom:
      return cubic_weight(x, 0, 0.5);
    case Kind::lanczos:
      return windowed_sinc(x, filter.lobes, filter.lobes);
    case Kind::sinc:
      return windowed_sinc(x, filter.sinc_radius, filter.tau);
  }
  return 0;
}

/// Weights of the sub-pixels along an axis that the filter of pixel `at` of `size` reaches, from `margin` pixels before
/// it on; their sum is 1. Those beyond the film's border have none unless the film samples it.
std::vector<double> weights_of(const PovrayExport& scene, int at, int size) {
  const int count = (2 * scene.margin + 1) * scene.grid;
  std::vector<double> weights;
  double sum = 0;
  for (int i = 0; i < count; ++i) {
    const double from_pixel = (i + 0.5) / scene.grid - scene.margin;
    const bool counts = scene.film.sample_border || (at + from_pixel > 0 && at + from_pixel < size);
    weights.push_back(counts ? weight_at(scene.film.filter, from_pixel - 0.5) : 0);
    sum += weights.back();
  }
  for (double& w : weights) w /= sum;
  return weights;
}

/// The filtered image of POV-Ray's, which has margins and sub-pixels.
Image filtered(const Image& image, const PovrayExport& scene) {
  if (scene.margin == 0) return box_downsample(image, scene.grid, 1 / scene.exposure);
  std::vector<std::vector<double>> across, down;
  for (int x = 0; x < scene.width; ++x) across.push_back(weights_of(scene, x, scene.width));
  for (int y = 0; y < scene.height; ++y) down.push_back(weights_of(scene, y, scene.height));
  const int count = (2 * scene.margin + 1) * scene.grid;
  Image result(scene.width, scene.height);
  for (int y = 0; y < scene.height; ++y)
    for (int x = 0; x < scene.width; ++x) {
      const std::vector<double>&row = across[static_cast<std::size_t>(x)], &column = down[static_cast<std::size_t>(y)];
      RgbD sum(0.0);
      for (int j = 0; j < count; ++j)
        for (int i = 0; i < count; ++i) {
          const float* p = image.pixel(x * scene.grid + i, y * scene.grid + j);
          sum += RgbD(double{p[0]}, double{p[1]}, double{p[2]}) *
                 (row[static_cast<std::size_t>(i)] * column[static_cast<std::size_t>(j)] / scene.exposure);
        }
      float* out = result.pixel(x, y);
      out[0] = static_cast<float>(sum.x);
      out[1] = static_cast<float>(sum.y);
      out[2] = static_cast<float>(sum.z);
    }
  return result;
}

}  // namespace

PovrayRun render_povray(const PovrayExport& scene, const PovrayRunOptions& options) {
  const ScratchFolder folder("povray");
  write_sdl(scene, folder.path() / "scene.pov");

  const std::vector<std::string> argv = command(scene, options.program);
  ProcessOptions process;
  process.wall_limit_seconds = options.wall_limit_seconds;
  process.memory_limit_bytes = options.memory_limit_bytes;
  process.interrupt = options.interrupt;
  process.working_folder = folder.path();
  std::string banner;  // the outcome keeps the end of a long console, the version is at its start
  process.on_stderr = [&](std::string_view chunk) {
    if (banner.size() < 4096) banner += chunk;
    if (!options.progress) return;
    if (const auto done = povray_progress(chunk)) options.progress(*done, "POV-Ray");
  };
  const ProcessOutcome outcome = run_process(argv, process);
  if (!outcome.ok())
    report_failure({"POV-Ray", options.program, "povray"}, outcome, povray_errors(outcome.standard_error));

  PovrayRun run;
  run.version = "POV-Ray " + povray_version(banner);
  run.command = command_line(argv);
  run.statistics = parse_povray_statistics(read_file(folder.path() / "statistics.txt"));
  run.wall_seconds = outcome.wall_seconds;
  run.cpu_seconds = outcome.cpu_seconds;
  run.peak_bytes = outcome.peak_bytes;
  const Image image = read_image((folder.path() / "scene.exr").string());
  run.rendering.mean = kept_part(scene.film, filtered(image, scene));
  if (scene.is_noisy && scene.margin == 0 && scene.grid > 1)
    run.rendering.variance = kept_part(scene.film, variance_of_blocks(image, scene.grid, 1 / scene.exposure));
  run.rendering.place = kept_place(scene.film);
  run.rendering.metadata["photonproof:version"] = run.version;
  run.rendering.metadata["photonproof:command"] = run.command;
  for (const PovrayExport& part : scene.besides) add(render_povray(part, options), run);
  run.defects = find_non_finite(run.rendering.mean, "brighter than half floats reach");
  return run;
}

}  // namespace photonproof::inline reference_povray
