// The compiled scene: flat tables ready for tracing, made once from a SceneDescription and immutable.
#pragma once

#include <vector>

#include "renderer/bsdf.h"
#include "renderer/camera.h"
#include "renderer/light.h"
#include "renderer/surface.h"
#include "renderer/trace.h"
#include "scenes/description.h"

namespace photonproof {

class Scene {
 public:
  /// `width`, `height` override the film's size. Throws InputError at an entity it cannot represent.
  Scene(const SceneDescription& description, int width, int height);
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  struct LightChoice {
    std::uint32_t index;
    float probability;
  };
  /// Picks a light with probability proportional to its flux.
  LightChoice choose_light(float u) const;
  float light_probability(std::uint32_t index) const { return light_probability_[index]; }

  const Bsdf& bsdf_of(const Hit& hit) const { return bsdfs[surfaces[hit.surface].bsdf]; }

  const int width, height;
  std::vector<Bsdf> bsdfs;
  std::vector<Light> lights;
  std::vector<Surface> surfaces;
  Camera camera;

 private:
  void add_shape(const SceneDescription& description, const ShapeDescription& shape);
  void add_surface(const std::variant<Quad, Sphere>& geometry, const ShapeDescription& shape);
  void add_quad(const ShapeDescription& shape, const Transform& face_to_world);

  std::vector<float> light_probability_;
  std::vector<float> light_cdf_;  ///< inclusive
  std::unique_ptr<Tracer> tracer_;

 public:
  const Tracer& tracer() const { return *tracer_; }
};

}  // namespace photonproof
