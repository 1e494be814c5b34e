#include "harness/grading/scene_references.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>

#include "harness/cells/cells.h"
#include "harness/cells/side_by_side.h"
#include "harness/metrics/metrics.h"
#include "harness/statistics/batch_means.h"
#include "harness/suites/engine_command.h"
#include "harness/suites/suite_rows.h"
#include "scenes/base/input_error.h"
#include "scenes/base/process.h"
#include "scenes/base/size_text.h"
#include "scenes/base/splitmix.h"
#include "scenes/xml/writer.h"

namespace photonproof::inline harness_grading {
namespace {

// Degrees of freedom of a variance that is known to be 0.
constexpr double no_noise_freedom = 1e6;

// One render of a program without randomness is its reference. A second, equal one proves that.
SceneReference only_reference(const WorkScene& scene, const std::vector<Image>& images, std::string text) {
  if (images[0].rgb != images[1].rgb)
    throw InputError("baseline", "gives two images of scene '" + scene.row.name +
                                     "', so that one render is no reference: leave out 'seeds' in [reference]");
  return {{images[0], Image(scene.width, scene.height), {}}, 1, no_noise_freedom, std::move(text)};
}

SceneReference mean_reference(const WorkScene& scene, const std::vector<Image>& images, std::string text) {
  BatchMeans means(scene.width, scene.height, 1);
  for (const Image& image : images) means.add(image, "reference of scene '" + scene.row.name + "'");
  const auto count = static_cast<int>(images.size());
  return {means.rendering(), count, static_cast<double>(count - 1), std::move(text)};
}

SceneReference file_reference(const WorkScene& scene) {
  const std::string file = scene.row.reference.string();
  Rendering rendering = read_rendering(file);
  if (rendering.mean.width != scene.width || rendering.mean.height != scene.height)
    throw InputError(file, "has " + size_text(rendering.mean.width, rendering.mean.height) + " pixels, scene '" +
                               scene.row.name + "' has " + size_text(scene.width, scene.height));
  if (const auto defects = find_defects(rendering.mean, rendering.mean); !defects.empty())
    throw InputError(file, defects.front().sentence);
  // A file without a variance counts as exact.
  if (!rendering.variance) rendering.variance = Image(scene.width, scene.height);
  return {std::move(rendering), 1, no_noise_freedom, scene.row.reference.filename().string()};
}

// Clamps the image as its format does.
void clamp_image(const AssignmentImage& format, Image& image) {
  if (!format.is_clamped()) return;
  const auto white = static_cast<float>(1 / format.scale);
  for (float& value : image.rgb) value = std::clamp(value, 0.0f, white);
}

class ReferenceMaker {
 public:
  explicit ReferenceMaker(const ReferenceWork& work) : work_(work), source_(work.assignment.reference) {
    for (std::size_t s = 0; s < work.scenes.size(); ++s)
      if (is_made(work.scenes[s]))
        for (std::size_t k = 0; k < renders(); ++k) jobs_.emplace_back(s, k);
    images_.resize(work.scenes.size(), std::vector<Image>(renders()));
  }

  std::optional<std::vector<std::optional<SceneReference>>> all() {
    std::atomic<bool> interrupted{false};
    std::atomic<std::size_t> done{0};
    side_by_side(jobs_.size(), work_.processes, [&](std::size_t job) {
      if (interrupted) return;
      const auto [scene, number] = jobs_[job];
      std::optional<Image> image = source_.kind == ReferenceSource::Kind::engine
                                       ? of_engine(work_.scenes[scene], number)
                                       : of_baseline(work_.scenes[scene], number);
      if (!image) {
        interrupted = true;
        return;
      }
      images_[scene][number] = std::move(*image);
      work_.progress(fmt::format("references: {} of {} images", ++done, jobs_.size()));
    });
    if (interrupted) return std::nullopt;
    std::vector<std::optional<SceneReference>> references;
    for (std::size_t s = 0; s < work_.scenes.size(); ++s) references.push_back(one(s));
    return references;
  }

 private:
  std::size_t renders() const { return static_cast<std::size_t>(std::max(source_.seeds, 2)); }

  bool is_made(const WorkScene& scene) const {
    return scene.unused.empty() && source_.kind != ReferenceSource::Kind::files;
  }

  std::optional<SceneReference> one(std::size_t s) const {
    const WorkScene& scene = work_.scenes[s];
    if (!scene.unused.empty()) return std::nullopt;
    if (!is_made(scene)) return file_reference(scene);
    const std::string by = source_.kind == ReferenceSource::Kind::engine
                               ? source_.engine + ", " + source_.budget.label()
                               : std::string("the baseline");
    if (source_.seeds == 1) return only_reference(scene, images_[s], "a render by " + by + ", which has no randomness");
    return mean_reference(scene, images_[s], fmt::format("mean of {} runs of {}", source_.seeds, by));
  }

  std::optional<Image> of_baseline(const WorkScene& scene, std::size_t number) const {
    std::optional<DrawnRun> cell = work_.runs.run(work_.baseline, scene, "reference", number, work_.reuse);
    if (!cell) return std::nullopt;
    if (!cell->image)
      throw InputError("baseline", "has no image of scene '" + scene.row.name + "': " + cell->run.sentence +
                                       (cell->run.log_tail.empty() ? "" : ": " + last_line(cell->run.log_tail)));
    return std::move(cell->image);
  }

  std::optional<Image> of_engine(const WorkScene& scene, std::size_t number) const {
    OwnEngine engine = work_.engine;
    engine.seconds = 3600;
    if (engine.interrupt != nullptr && *engine.interrupt) return std::nullopt;
    OwnRender render{.width = scene.width, .height = scene.height, .integrator = source_.engine};
    render.seed = 1 + splitmix64(splitmix64(work_.seed, 1u << 31), number) % 999'999'999;
    if (source_.budget.kind == "spp")
      render.spp = static_cast<int>(source_.budget.amount);
    else
      render.more = {"--" + source_.budget.kind, source_.budget.amount_text()};
    Image image = render_with(engine, *scene.description, render).mean;
    clamp_image(work_.assignment.image, image);
    return image;
  }

  const ReferenceWork& work_;
  const ReferenceSource& source_;
  std::vector<std::pair<std::size_t, std::size_t>> jobs_;
  std::vector<std::vector<Image>> images_;  // by scene and number
};

}  // namespace

std::optional<std::vector<std::optional<SceneReference>>> make_scene_references(const ReferenceWork& work) {
  return ReferenceMaker(work).all();
}

}  // namespace photonproof::inline harness_grading
