#include "renderer/api/render_scene.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "renderer/api/direct_as_mitsuba.h"
#include "renderer/api/render_identity.h"
#include "renderer/api/request_checks.h"
#include "renderer/core/parallel.h"
#include "renderer/core/version.h"
#include "renderer/denoising/denoiser.h"
#include "renderer/integrators/check_supported.h"
#include "renderer/integrators/integrator.h"
#include "renderer/limits/precision_notes.h"
#include "renderer/limits/scene_notes.h"
#include "renderer/scalar/coverage.h"
#include "scenes/base/timer.h"
#include "scenes/files/atomic_file.h"
#include "scenes/images/mean_error.h"

namespace photonproof::inline renderer_api {
namespace {

constexpr const char* oidn_name = "Open Image Denoise";
constexpr int guide_samples = 16;  // with 4, the error of `roughness` and of `lens` is a quarter and a third larger

IntegratorDescription method_of(const SceneDescription& description, const RenderRequest& request) {
  IntegratorDescription method = description.integrator;
  if (!request.integrator.empty()) method = with_integrator(method, request.integrator);
  if (request.indirect) {
    auto* photons = std::get_if<PhotonMapperDescription>(&method.method);
    if (photons == nullptr)
      throw InputError("--indirect", "does nothing with integrator '" + integrator_name(method) + "'");
    photons->indirect = *request.indirect;
  }
  return method;
}

RenderJob job_of(const SceneDescription& description, const RenderRequest& request) {
  RenderJob job;
  job.budget = request.budget;
  job.seed = request.seed;
  job.threads = request.threads;
  job.grid = request.grid;
  job.sampler = request.sampler;
  job.isa = request.isa;
  job.view = request.view;
  job.skips = SkipSwitches(request.no_skip);
  job.sample_count = description.sensor.sample_count;
  job.integrator_place = description.where(description.integrator.loc);
  job.interrupt = request.interrupt;
  job.progress = request.progress;
  job.preview_seconds = request.preview_seconds;
  return job;
}

/// One render, from its request to its image.
class SceneRender {
 public:
  SceneRender(const SceneDescription& description, const RenderRequest& request)
      : request_(request),
        method_(method_of(description, request)),
        changed_(direct_as_mitsuba(description, method_)),
        description_(changed_ ? *changed_ : description),
        job_(job_of(description, request)) {
    check_supported(description_, method_);
    check_job(job_, method_);
    check_view(description_, job_);
    window_ = film_window(description_.sensor.film, request_.crop);
    if (!request_.denoise) return;
    check_denoise(job_);
    denoiser_.emplace(request_.denoise->library, Threads(request_.threads).count());
  }

  RenderPlan plan() {
    SceneParts parts = planned_parts();
    warn(scene_notes(description_, parts));
    if (plan_.may_lose_light) find_lost_light(Scene(std::move(parts), plan_.scene), plan_);
    return std::move(plan_);
  }

  Rendered render() {
    prepare_checkpoint();
    build();
    if (request_.preview) job_.preview = [this](Rendering image) { request_.preview(scaled(std::move(image)).mean); };
    Film film(window_);
    const std::size_t known = stats_.losses.size();
    photonproof::render(*scene_, plan_, job_, film, stats_);
    note_lost_variance(film);
    for (std::size_t i = known; i < stats_.losses.size(); ++i)
      warn_of({description_.files.empty() ? "scene" : description_.files.front(), stats_.losses[i]});
    note_missed_spots();
    Rendered rendered;
    rendered.image = developed(film);
    rendered.threads = Threads(request_.threads).count();
    rendered.unsampled_pixels = film.unsampled_pixels();
    const std::vector<float>& values = rendered.image.mean.rgb;
    rendered.non_finite_values =
        static_cast<std::size_t>(std::ranges::count_if(values, [](float v) { return !std::isfinite(v); }));
    if (denoiser_) denoise(rendered);
    if (request_.preview) request_.preview(rendered.image.mean);
    rendered.plan = std::move(plan_);
    rendered.stats = std::move(stats_);
    return rendered;
  }

 private:
  SceneParts planned_parts() {
    SceneParts parts{description_, description_.sensor.film.width, description_.sensor.film.height};
    plan_ = plan_render(analyse(parts), method_, job_);
    if (denoiser_)
      plan_.runs.push_back({"denoiser", oidn_name + (" " + denoiser_->version()) +
                                            ", guided by albedo and normals: biased, without a variance layer"});
    return parts;
  }

  /// Removes what earlier processes left half-written beside the checkpoint.
  void prepare_checkpoint() {
    job_.checkpoint = request_.checkpoint;
    if (!job_.checkpoint) return;
    const std::string file = job_.checkpoint->file.string();
    if (!job_.checkpoint->finds_what_it_resumes())
      warn_of({file, "no such checkpoint, the render starts from the beginning"});
    remove_abandoned_temporaries(file);
  }

  /// The scene as the plan wants it.
  void build() {
    const PhaseTimer timer(stats_.phases["compile"]);
    check_memory(description_, window_,
                 {job_.checkpoint && job_.checkpoint->interval_seconds > 0, denoiser_.has_value()});
    SceneParts parts = planned_parts();
    std::vector<SceneNote> notes = scene_notes(description_, parts);
    scene_ = std::make_unique<const Scene>(std::move(parts), plan_.scene);
    find_lost_light(*scene_, plan_);
    if (plan_.lost_light) notes.push_back({description_.where(method_.loc), plan_.lost_light->text()});
    keep(notes);
    stats_.counts["bytes_scene"] = static_cast<double>(scene_->memory_bytes());
    if (const Tracer* tracer = scene_->view().tracer)
      stats_.counts["bytes_bvh"] = static_cast<double>(tracer->bvh_bytes());
    if (job_.checkpoint) job_.checkpoint->identity = render_identity(description_, request_, plan_, window_);
  }

  void note_lost_variance(const Film& film) {
    const VarianceInFloat variance = film.variance_in_float();
    if (variance.lost == 0) return;
    stats_.losses.push_back("the variance of " + std::to_string(variance.lost) +
                            (variance.lost == 1 ? " pixel is" : " pixels is") +
                            " beyond single precision, as radiances above 1e19 or below 1e-19 make it: " +
                            (variance.fits ? "its layer is unreliable there" : "the image has no variance layer"));
  }

  void note_missed_spots() {
    if (plan_.integrator == "bdpt" || plan_.integrator == "ptracer") return;
    const double pixels = static_cast<double>(window_.width()) * window_.height();
    keep(notes_on_missed_spots(description_, *scene_, pixels * samples_per_pixel()));
  }

  /// The values times the camera's factor, which the film does not have.
  Rendering scaled(Rendering rendering) const {
    if (const double factor = scene_->view().camera.image_factor; factor != 1) scale_values(rendering, factor);
    return rendering;
  }

  Rendering developed(const Film& film) {
    Rendering rendering = scaled(film.develop());
    const FilmDescription& whole = description_.sensor.film;
    if (window_ != Tile{0, 0, whole.width, whole.height})
      rendering.place = {window_.x0, window_.y0, whole.width, whole.height};
    if (whole.alpha) {
      const PhaseTimer timer(stats_.phases["alpha"]);
      rendering.alpha = coverage(*scene_, job_, method_.limits().hide_emitters, window_,
                                 static_cast<std::int64_t>(samples_per_pixel()));
      if (shows_environment_as_mitsuba()) {
        std::ranges::fill(rendering.alpha, 1.0f);
        keep({{description_.where(description_.sensor.loc), "as in Mitsuba, the environment counts in channel A"}});
      }
    }
    if (description_.as_mitsuba) rendering.metadata["photonproof:as_mitsuba"] = "3.9.1";
    rendering.metadata["photonproof:version"] = version_line();
    rendering.metadata["photonproof:sampler"] = sampler_name(job_.sampler);
    rendering.metadata["photonproof:isa"] = plan_.isa;
    if (stats_.counts.contains("photons_stored_global") || stats_.counts.contains("photons_stored_caustic"))
      store_shared_photons(rendering);
    return rendering;
  }

  /// An interrupt or a failure leaves the image as it was rendered.
  void denoise(Rendered& rendered) {
    Denoised done{oidn_name, denoiser_->version(), 0, guide_samples};
    std::optional<NotDenoised> failed;
    {
      const PhaseTimer timer(done.seconds);
      failed = denoise(rendered.image);
    }
    stats_.phases["denoise"] = done.seconds;
    if (!failed) {
      rendered.image.metadata["photonproof:denoised"] = done.library + " " + done.version + ", biased";
      rendered.denoised = std::move(done);
      return;
    }
    rendered.not_denoised = std::move(failed->why);
    stats_.interrupted = failed->cancelled;
  }

  std::optional<NotDenoised> denoise(Rendering& rendering) {
    std::optional<Guides> guides = trace_guides(*scene_, job_, method_.limits().hide_emitters, window_, guide_samples);
    if (!guides) return NotDenoised{true, "it was interrupted"};
    const auto goes_on = [this](double fraction) {
      if (job_.progress) job_.progress(fraction, "denoiser");
      return !job_.interrupted();
    };
    if (auto failed = denoiser_->filter(rendering.mean, *guides, goes_on)) return failed;
    rendering.variance.reset();
    return std::nullopt;
  }

  /// Mitsuba's `path` and `volpath` take a visible environment for a shape in channel A.
  bool shows_environment_as_mitsuba() const {
    return description_.as_mitsuba && (plan_.integrator == "path" || plan_.integrator == "volpath") &&
           !method_.limits().hide_emitters && scene_->view().environment != no_index;
  }

  double samples_per_pixel() const { return stats_.counts.at("samples_per_pixel"); }

  void warn_of(const SceneNote& note) const {
    if (request_.warn) request_.warn(note);
  }
  void warn(const std::vector<SceneNote>& notes) const {
    for (const SceneNote& note : notes) warn_of(note);
  }
  /// Into the stats, too.
  void keep(const std::vector<SceneNote>& notes) {
    warn(notes);
    for (const SceneNote& note : notes) stats_.losses.push_back(note.where + ": " + note.text);
  }

  const RenderRequest& request_;
  IntegratorDescription method_;
  const std::optional<SceneDescription> changed_;
  const SceneDescription& description_;
  RenderJob job_;
  Tile window_;
  std::optional<Denoiser> denoiser_;
  RenderPlan plan_;
  RenderStats stats_;
  std::unique_ptr<const Scene> scene_;
};

}  // namespace

Rendered render_scene(const SceneDescription& description, const RenderRequest& request) {
  return SceneRender(description, request).render();
}

RenderPlan plan_scene(const SceneDescription& description, const RenderRequest& request) {
  return SceneRender(description, request).plan();
}

void remove_checkpoint(const std::filesystem::path& file) {
  std::error_code ignored;
  std::filesystem::remove(file, ignored);
}

}  // namespace photonproof::inline renderer_api
