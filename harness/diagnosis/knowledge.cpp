#include "harness/diagnosis/knowledge.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "harness/diagnosis/direct_geometry.h"
#include "harness/diagnosis/mistakes.h"
#include "harness/diagnosis/pictures/picture_changes.h"
#include "harness/diagnosis/seen_objects.h"

namespace photonproof::inline harness_diagnosis {
namespace {

class KnowledgeMaker {
 public:
  KnowledgeMaker(const SceneDescription& scene, const Rendering& reference, const OwnEngine& engine,
                 const KnowledgeOptions& options)
      : scene_(scene),
        engine_(engine),
        options_(options),
        width_(reference.mean.width),
        height_(reference.mean.height) {
    const int longer = std::max(width_, height_);
    const double part = std::min(1.0, static_cast<double>(options.longer_side) / longer);
    small_width_ = std::max(8, static_cast<int>(width_ * part + 0.5));
    small_height_ = std::max(8, static_cast<int>(height_ * part + 0.5));
    scene_.sensor.film.crop.reset();
    scene_.sensor.film.width = small_width_;
    scene_.sensor.film.height = small_height_;
    points_ = seen_points(scene_, small_width_, small_height_);
  }

  SceneLight light() {
    SceneLight light;
    model_ = rendered(scene_, whole());
    light.model = resized(model_, width_, height_);
    add_features(light);
    if (options_.what_ifs && has_direct()) add_formulas(light);
    return light;
  }

  /// The mistakes without their images.
  std::vector<Mistake> mistakes() const {
    std::vector<bool> visible(scene_.shapes.size());
    for (const SeenPlace& point : points_)
      if (point.object > 0) visible[point.object - 1u] = true;
    std::vector<Mistake> all = mistakes_of(scene_, object_names(scene_), visible);
    all.push_back({"shadows-missing",
                   "shadows missing",
                   "no shadow rays are traced: direct light is never blocked",
                   "",
                   without_objects(scene_),
                   {},
                   true});
    return all;
  }

  /// The change that the mistake makes, with a quarter of the noise.
  Image fine_change_of(const Mistake& mistake) const {
    OwnRender render = whole();
    render.spp *= 16;
    return resized(change_of(rendered(mistake.scene, render), rendered(scene_, render)), width_, height_);
  }

  /// Precondition: light() was called.
  Image image_of(const Mistake& mistake) const {
    if (mistake.direct_only)
      return resized(has_direct() ? with_direct(direct_light(mistake.scene)) : model_, width_, height_);
    Image image = rendered(mistake.scene, whole());
    if (!mistake.only_where_seen.empty())
      for (std::size_t i = 0; i < points_.size(); ++i)
        if (!sees_any(points_[i], mistake.only_where_seen))
          for (std::size_t c = 0; c < 3; ++c) image.rgb[3 * i + c] = model_.rgb[3 * i + c];
    return resized(image, width_, height_);
  }

  std::vector<std::uint8_t> pixels_of(const std::vector<std::size_t>& shapes) const {
    std::vector<std::uint8_t> pixels;
    if (shapes.empty()) return pixels;
    for (const SeenPlace& point : seen_points(scene_, width_, height_)) pixels.push_back(sees_any(point, shapes));
    return pixels;
  }

 private:
  OwnRender whole() const {
    OwnRender render{.width = small_width_, .height = small_height_, .spp = options_.spp};
    render.integrator = "photonmapper";
    return render;
  }
  Image rendered(const SceneDescription& scene, const OwnRender& render) const {
    return render_with(engine_, scene, render).mean;
  }
  Image view_of(const char* view, int max_depth) const {
    SceneDescription scene = scene_;
    PhotonMapperDescription mapper;
    mapper.max_depth = max_depth;
    scene.integrator.method = mapper;
    OwnRender render = whole();
    render.integrator = "";
    render.more = {"--view", view};
    return rendered(scene, render);
  }
  /// Light that goes directly from lights to visible surfaces, without mirrors and glass.
  Image direct_light(const SceneDescription& from) const {
    SceneDescription scene = from;
    PathDescription path;
    path.max_depth = 2;
    path.hide_emitters = false;
    scene.integrator.method = path;
    OwnRender render = whole();
    render.integrator = "";
    render.spp = 4 * options_.spp;
    return rendered(scene, render);
  }

  void add_probe(SceneLight& to, const char* feature, const Image& light) const {
    FeatureProbe probe{feature, resized(light, width_, height_), {}};
    for (std::size_t i = 0; i < probe.light.pixels(); ++i) {
      double part = 0, all = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        part += std::abs(probe.light.rgb[3 * i + c]);
        all += to.model.rgb[3 * i + c];
      }
      probe.weight.push_back(static_cast<float>(all > 0 ? std::min(1.0, part / all) : 0));
    }
    to.probes.push_back(std::move(probe));
  }

  void add_features(SceneLight& light) {
    const Image caustic = view_of("caustics", -1), indirect = view_of("global", -1);
    add_probe(light, "caustic", caustic);
    add_probe(light, "indirect", indirect);
    direct_ = direct_light(scene_);
    // The lights' own pixels are no direct light: they stay when direct light is lost.
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (shows_light(i))
        for (std::size_t c = 0; c < 3; ++c) direct_.rgb[3 * i + c] = 0;
    add_probe(light, "direct", direct_);
  }

  static bool sees_any(const SeenPlace& point, const std::vector<std::size_t>& shapes) {
    return std::any_of(shapes.begin(), shapes.end(), [&](std::size_t shape) { return point.object == shape + 1; });
  }

  /// Whether the pixel or a neighbour shows a light: the light's edge may lie in this pixel.
  bool shows_light(std::size_t pixel) const {
    const int x = static_cast<int>(pixel % static_cast<std::size_t>(small_width_)),
              y = static_cast<int>(pixel / static_cast<std::size_t>(small_width_));
    for (int ny = std::max(0, y - 1); ny <= std::min(small_height_ - 1, y + 1); ++ny)
      for (int nx = std::max(0, x - 1); nx <= std::min(small_width_ - 1, x + 1); ++nx) {
        const SeenPlace& point = points_[static_cast<std::size_t>(ny * small_width_ + nx)];
        if (point.object > 0 && scene_.shapes[point.object - 1u].radiance) return true;
      }
    return false;
  }

  /// The model plus the change of direct light, except in pixels that show a light or a body.
  Image with_direct(const Image& other) const {
    Image image = model_;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (points_[i].object == 0) continue;
      const ShapeDescription& shape = scene_.shapes[points_[i].object - 1u];
      if (shows_light(i) || is_object(scene_, shape)) continue;
      for (std::size_t c = 0; c < 3; ++c)
        image.rgb[3 * i + c] = std::max(0.0f, image.rgb[3 * i + c] + other.rgb[3 * i + c] - direct_.rgb[3 * i + c]);
    }
    return image;
  }

  bool has_direct() const {
    return std::any_of(direct_.rgb.begin(), direct_.rgb.end(), [](float v) { return v > 0.01f; });
  }

  void add_formulas(SceneLight& light) const {
    for (DirectMistake& mistake : direct_mistakes(scene_, points_, direct_))
      light.formulas.push_back({mistake.kind, mistake.sentence, mistake.cause, "",
                                Lazy<Image>(resized(with_direct(mistake.direct), width_, height_))});
  }

  SceneDescription scene_;
  OwnEngine engine_;
  KnowledgeOptions options_;
  int width_, height_, small_width_ = 0, small_height_ = 0;
  std::vector<SeenPlace> points_;
  Image model_, direct_;
};

}  // namespace

SceneKnowledge knowledge_of(const SceneDescription& scene, const Rendering& reference, const OwnEngine& engine,
                            const KnowledgeOptions& options) {
  SceneKnowledge knowledge;
  knowledge.reference = reference.mean;
  knowledge.variance = reference.variance;
  knowledge.white = options.white;
  const auto maker = std::make_shared<KnowledgeMaker>(scene, reference, engine, options);
  set_landmarks(knowledge, scene, seen_points(scene, reference.mean.width, reference.mean.height), reference.mean.width,
                reference.mean.height);
  const Lazy<SceneLight> light(std::function<SceneLight()>([maker] { return maker->light(); }));
  knowledge.light = light;
  if (!options.what_ifs) return knowledge;
  for (const Mistake& mistake : maker->mistakes()) {
    const std::function<Image()> image = [maker, light, mistake] {
      light.get();
      return maker->image_of(mistake);
    };
    WhatIf what_if{mistake.kind, mistake.sentence, mistake.cause, mistake.landmark, Lazy<Image>(image)};
    what_if.only_there = !mistake.only_where_seen.empty();
    what_if.changes = maker->pixels_of(what_if.only_there ? mistake.only_where_seen : mistake.changes);
    what_if.rough = mistake.rough;
    what_if.rare = mistake.rare;
    if (mistake.faint)
      what_if.fine = Lazy<Image>(std::function<Image()>([maker, mistake] { return maker->fine_change_of(mistake); }));
    knowledge.what_ifs.push_back(std::move(what_if));
  }
  return knowledge;
}

}  // namespace photonproof::inline harness_diagnosis
