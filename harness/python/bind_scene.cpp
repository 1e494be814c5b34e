#include <nanobind/stl/array.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/vector.h>

#include <atomic>
#include <cstdint>
#include <mutex>
#include <utility>
#include <vector>

#include "harness/python/arrays.h"
#include "harness/python/bindings.h"
#include "harness/python/interruptible.h"
#include "harness/python/stats.h"
#include "renderer/api/render_scene.h"
#include "renderer/denoising/oidn_library.h"
#include "renderer/planning/integrator_name.h"
#include "scenes/base/input_error.h"
#include "scenes/description/sensors.h"
#include "scenes/parser/parser.h"

namespace nb = nanobind;

namespace photonproof::inline harness_python {
namespace {

constexpr std::int64_t most_pixels = std::int64_t{1} << 28;

/// Throws InputError as `--size` does.
void resize(SceneDescription& scene, const std::pair<int, int>& size) {
  const auto [width, height] = size;
  if (width < 1 || height < 1 || std::int64_t{width} * height > most_pixels)
    throw InputError("size", "expected (width, height) in pixels, from (1, 1) to 2^28 pixels");
  scene.sensor.film.resize(width, height);
  const std::string problem = film_problem(scene.sensor);
  if (!problem.empty()) throw InputError("size", "the scene's sensor " + problem);
}

SceneDescription load(const std::string& path, const std::map<std::string, std::string>& defines,
                      const std::optional<std::pair<int, int>>& size, int sensor, bool allow_outside, bool lenient,
                      bool as_mitsuba) {
  const nb::gil_scoped_release released;
  ParseOptions options;
  options.defines = defines;
  options.sensor = sensor;
  options.allow_outside = allow_outside;
  options.lenient = lenient;
  options.as_mitsuba = as_mitsuba;
  SceneDescription scene = parse_scene_file(path, options);
  if (size) resize(scene, *size);
  return scene;
}

IndirectLight indirect_named(const std::string& name) {
  for (const auto& word : indirect_words)
    if (name == word.text) return word.value;
  throw InputError("indirect", "'" + name + "' is none of automatic, map, gather, cache, path");
}

SamplerKind sampler_named(const std::string& name) {
  if (name == "sobol") return SamplerKind::sobol;
  if (name == "independent") return SamplerKind::independent;
  throw InputError("sampler", "'" + name + "' is neither sobol nor independent");
}

/// The arguments of Scene.render, as Python gives them.
struct Asked {
  std::string integrator;
  std::optional<std::string> indirect;
  std::optional<std::int64_t> spp, photons;
  std::optional<double> seconds, target_error;
  std::uint64_t seed;
  int threads, grid;
  std::string sampler, view;
  std::vector<std::string> no_skip;
  std::string isa;
  std::optional<std::array<int, 4>> crop;
  bool denoise;
};

template <class T>
void check_range(const char* name, const std::optional<T>& value, T least, T most, const char* words) {
  if (value && !(*value >= least && *value <= most)) throw InputError(name, std::string("must be from ") + words);
}

/// Throws InputError where a number is outside of the range that the command line has.
void check(const Asked& asked) {
  check_range<std::int64_t>("spp", asked.spp, 1, std::int64_t{1} << 32, "1 to 2^32");
  check_range<std::int64_t>("photons", asked.photons, 1, std::int64_t{1} << 40, "1 to 2^40");
  check_range("seconds", asked.seconds, 1e-3, 1e7, "0.001 to 1e7");
  check_range("target_error", asked.target_error, 1e-6, 10.0, "1e-6 to 10");
  check_range<int>("threads", asked.threads, 0, 1024, "0, every core, to 1024");
  if (asked.seconds && asked.spp) throw InputError("seconds", "excludes spp: a render has one budget");
  if (asked.target_error && (asked.spp || asked.seconds))
    throw InputError("target_error", "excludes spp and seconds: a render has one budget");
  check_range<int>("grid", asked.grid, 0, 1024, "0 to 1024");
}

RenderRequest request_of(const Asked& asked) {
  check(asked);
  RenderRequest request;
  request.integrator = asked.integrator;
  if (asked.indirect) request.indirect = indirect_named(*asked.indirect);
  request.budget = {asked.spp, asked.photons, asked.seconds, asked.target_error};
  request.seed = asked.seed;
  request.threads = asked.threads;
  request.grid = asked.grid;
  request.sampler = sampler_named(asked.sampler);
  request.view = aov_named(asked.view);
  request.no_skip = asked.no_skip;
  request.isa = asked.isa;
  if (const auto& crop = asked.crop) request.crop = {(*crop)[0], (*crop)[1], (*crop)[2], (*crop)[3]};
  if (asked.denoise) request.denoise = DenoiseRequest{oidn_in_environment()};
  return request;
}

/// Messages of a render's threads to the thread that has the GIL.
class Mailbox {
 public:
  void progress(double fraction, const std::string& phase) {
    const std::lock_guard lock(mutex_);
    progress_ = {fraction, phase};
  }
  void warn(const SceneNote& note) {
    const std::lock_guard lock(mutex_);
    warnings_.push_back(note.where + ": " + note.text);
  }
  std::optional<std::pair<double, std::string>> take_progress() {
    const std::lock_guard lock(mutex_);
    return std::exchange(progress_, std::nullopt);
  }
  std::vector<std::string> take_warnings() {
    const std::lock_guard lock(mutex_);
    return std::exchange(warnings_, {});
  }

 private:
  std::mutex mutex_;
  std::optional<std::pair<double, std::string>> progress_;
  std::vector<std::string> warnings_;
};

using Warn = nb::typed<nb::callable, void(std::string)>;

/// Whether a callback returned something false other than None. Raises what its conversion raises.
bool says_no(const nb::object& answer) {
  if (answer.is_none()) return false;
  const int truth = PyObject_IsTrue(answer.ptr());
  if (truth < 0) nb::raise_python_error();
  return truth == 0;
}

/// Calls `progress(fraction, phase)` and `warn(text)` while it renders. A progress that returns False ends the render
/// early. Returns mean, variance, alpha, metadata and stats.
Parts render(const SceneDescription& scene, const Asked& asked, const nb::object& progress, const Warn& warn) {
  RenderRequest request = request_of(asked);
  std::atomic<bool> stop = false;
  Mailbox mail;
  request.interrupt = &stop;
  if (!progress.is_none())
    request.progress = [&](double fraction, const std::string& phase) { mail.progress(fraction, phase); };
  request.warn = [&](const SceneNote& note) { mail.warn(note); };
  std::optional<Rendered> rendered;
  run_interruptibly(
      stop, [&] { rendered = render_scene(scene, request); },
      [&] {
        for (const std::string& text : mail.take_warnings()) warn(text);
        if (const auto at = mail.take_progress())
          if (says_no(progress(at->first, at->second))) stop = true;
      });
  const nb::dict stats = stats_of(*rendered, asked.seed, asked.sampler);
  return nb::tuple(arrays_of(std::move(rendered->image)) + nb::make_tuple(stats));
}

std::vector<std::string> notes_of(const SceneDescription& scene) {
  std::vector<std::string> notes;
  for (const SceneNote& note : scene.notes) notes.push_back(note.where + ": " + note.text);
  return notes;
}

}  // namespace

void bind_scene(nb::module_& module) {
  using namespace nb::literals;
  nb::class_<SceneDescription>(module, "Scene", "A scene that was read.")
      .def_prop_ro("size",
                   [](const SceneDescription& scene) {
                     return std::pair{scene.sensor.film.width, scene.sensor.film.height};
                   })
      .def_prop_ro("spp", [](const SceneDescription& scene) { return scene.sensor.sample_count; })
      .def_prop_ro("integrator", [](const SceneDescription& scene) { return integrator_name(scene.integrator); })
      .def_prop_ro("files", [](const SceneDescription& scene) { return scene.files; })
      .def_prop_ro("notes", &notes_of)
      .def(
          "render",
          [](const SceneDescription& scene, std::string integrator, std::optional<std::string> indirect,
             std::optional<std::int64_t> spp, std::optional<std::int64_t> photons, std::optional<double> seconds,
             std::optional<double> target_error, std::uint64_t seed, int threads, int grid, std::string sampler,
             std::string view, std::vector<std::string> no_skip, std::string isa,
             std::optional<std::array<int, 4>> crop, bool denoise, const nb::object& progress, const Warn& warn) {
            return render(
                scene,
                {std::move(integrator), std::move(indirect), spp, photons, seconds, target_error, seed, threads, grid,
                 std::move(sampler), std::move(view), std::move(no_skip), std::move(isa), crop, denoise},
                progress, warn);
          },
          nb::kw_only(), "integrator"_a, "indirect"_a.none(), "spp"_a.none(), "photons"_a.none(), "seconds"_a.none(),
          "target_error"_a.none(), "seed"_a, "threads"_a, "grid"_a, "sampler"_a, "view"_a, "no_skip"_a, "isa"_a,
          "crop"_a.none(), "denoise"_a, "progress"_a.none(), "warn"_a);
  module.def("load", &load, "path"_a, nb::kw_only(), "defines"_a, "size"_a.none(), "sensor"_a, "allow_outside"_a,
             "lenient"_a, "as_mitsuba"_a);
}

}  // namespace photonproof::inline harness_python
