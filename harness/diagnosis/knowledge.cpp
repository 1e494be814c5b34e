#include "harness/diagnosis/knowledge.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "harness/diagnosis/direct_geometry.h"
#include "harness/diagnosis/mistakes.h"
#include "harness/diagnosis/picture_changes.h"
#include "harness/diagnosis/seen_objects.h"

namespace photonproof {
namespace {

Image sum_of(const Image& a, const Image& b, float factor) {
  Image sum = a;
  for (std::size_t i = 0; i < sum.rgb.size(); ++i) sum.rgb[i] += factor * b.rgb[i];
  return sum;
}

Image not_negative(Image image) {
  for (float& v : image.rgb) v = std::max(0.0f, v);
  return image;
}

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
    knowledge_.reference = reference.mean;
    knowledge_.variance = reference.variance;
    knowledge_.white = options.white;
    points_ = seen_points(scene_, small_width_, small_height_);
  }

  SceneKnowledge run() {
    set_landmarks(knowledge_, scene_, seen_points(scene_, width_, height_), width_, height_);
    model_ = rendered(scene_, whole());
    add_features();
    if (options_.what_ifs) add_mistakes();
    knowledge_.model = resized(model_, width_, height_);
    return std::move(knowledge_);
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
  /// Light from lamps to what is seen, without mirrors and glass.
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

  void add_probe(const char* feature, const Image& light) {
    FeatureProbe probe{feature, resized(light, width_, height_), {}};
    for (std::size_t i = 0; i < probe.light.pixels(); ++i) {
      double part = 0, all = 0;
      for (std::size_t c = 0; c < 3; ++c) {
        part += std::abs(probe.light.rgb[3 * i + c]);
        all += knowledge_.reference.rgb[3 * i + c];
      }
      probe.weight.push_back(static_cast<float>(all > 0 ? std::min(1.0, part / all) : 0));
    }
    knowledge_.probes.push_back(std::move(probe));
  }

  void add_features() {
    const Image caustic = view_of("caustics", -1), indirect = view_of("global", -1), first = view_of("global", 3);
    const Image later = not_negative(sum_of(indirect, first, -1));
    add_probe("caustic", caustic);
    add_probe("indirect", indirect);
    add_probe("later bounces", later);
    direct_ = direct_light(scene_);
    // Lamps themselves are no direct light that could be lost with it.
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (shows_lamp(i))
        for (std::size_t c = 0; c < 3; ++c) direct_.rgb[3 * i + c] = 0;
    add_probe("direct", direct_);
  }

  bool sees_any(std::size_t pixel, const std::vector<std::size_t>& shapes) const {
    return std::any_of(shapes.begin(), shapes.end(),
                       [&](std::size_t shape) { return points_[pixel].object == shape + 1; });
  }

  /// In the pixel or one beside it, whose edge may lie in this one.
  bool shows_lamp(std::size_t pixel) const {
    const int x = static_cast<int>(pixel % static_cast<std::size_t>(small_width_)),
              y = static_cast<int>(pixel / static_cast<std::size_t>(small_width_));
    for (int ny = std::max(0, y - 1); ny <= std::min(small_height_ - 1, y + 1); ++ny)
      for (int nx = std::max(0, x - 1); nx <= std::min(small_width_ - 1, x + 1); ++nx) {
        const SeenPoint& point = points_[static_cast<std::size_t>(ny * small_width_ + nx)];
        if (point.object > 0 && scene_.shapes[point.object - 1u].radiance) return true;
      }
    return false;
  }

  void add_what_if(const Mistake& mistake, Image image) {
    WhatIf what_if{mistake.kind, mistake.sentence, mistake.cause, mistake.landmark, resized(image, width_, height_)};
    knowledge_.what_ifs.push_back(std::move(what_if));
  }

  /// The model, but for what differs of direct light where it is seen that no lamp or body is.
  Image with_direct(const Image& other) const {
    Image image = model_;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (points_[i].object == 0) continue;
      const ShapeDescription& shape = scene_.shapes[points_[i].object - 1u];
      if (shows_lamp(i) || is_body(scene_, shape)) continue;
      for (std::size_t c = 0; c < 3; ++c)
        image.rgb[3 * i + c] = std::max(0.0f, image.rgb[3 * i + c] + other.rgb[3 * i + c] - direct_.rgb[3 * i + c]);
    }
    return image;
  }

  void add_mistakes() {
    const std::vector<std::string> names = object_names(scene_);
    std::vector<bool> visible(scene_.shapes.size());
    for (const SeenPoint& point : points_)
      if (point.object > 0) visible[point.object - 1u] = true;
    const bool has_direct = std::any_of(direct_.rgb.begin(), direct_.rgb.end(), [](float v) { return v > 0.01f; });
    for (const Mistake& mistake : mistakes_of(scene_, names, visible)) {
      if (mistake.direct_only) {
        if (has_direct) add_what_if(mistake, with_direct(direct_light(mistake.scene)));
        continue;
      }
      Image image = rendered(mistake.scene, whole());
      if (!mistake.only_where_seen.empty())
        for (std::size_t i = 0; i < points_.size(); ++i)
          if (!sees_any(i, mistake.only_where_seen))
            for (std::size_t c = 0; c < 3; ++c) image.rgb[3 * i + c] = model_.rgb[3 * i + c];
      add_what_if(mistake, std::move(image));
    }
    if (!has_direct) return;
    add_what_if(
        {"shadows-missing", "shadows missing", "no shadow rays are traced: direct light is never blocked", "", {}, {}},
        with_direct(direct_light(without_bodies(scene_))));
    for (DirectMistake& mistake : direct_mistakes(scene_, points_, direct_))
      add_what_if({mistake.kind, mistake.sentence, mistake.cause, "", {}, {}}, with_direct(mistake.direct));
  }

  SceneDescription scene_;
  const OwnEngine& engine_;
  KnowledgeOptions options_;
  int width_, height_, small_width_ = 0, small_height_ = 0;
  std::vector<SeenPoint> points_;
  Image model_, direct_;
  SceneKnowledge knowledge_;
};

}  // namespace

SceneKnowledge knowledge_of(const SceneDescription& scene, const Rendering& reference, const OwnEngine& engine,
                            const KnowledgeOptions& options) {
  return KnowledgeMaker(scene, reference, engine, options).run();
}

}  // namespace photonproof
