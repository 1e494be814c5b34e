// A scene with its camera, and the renderer.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "light_source.h"
#include "scene_object.h"

struct Camera {
  Vec3 position{0, 0, 150}, direction{0, 0, -1}, up{0, 1, 0};
  double fov = 52.62529698957768;                          ///< from the picture's bottom to its top, degrees
  double near = 100.1;                                     ///< rays start on the plane this far before the camera
  int full_width = 0, full_height = 0, left = 0, top = 0;  ///< if not 0: the picture is cut out of a larger one
};

struct Parts {
  bool direct = true, caustic = true, global = true, lamp = true;
};

class Raytracer {
 public:
  // --- what a scene is built with ---
  void add(std::shared_ptr<SceneObject> object);
  void add_light(std::shared_ptr<Square> square);
  void add_water(std::shared_ptr<SceneObject> water);  ///< caustics get more photons and a smaller radius
  void build_scene(int number);                        ///< 1 to 3: scenes.cpp
  void build_scene_file(const std::string& name);      ///< scene_file.cpp
  Camera camera;
  Parts parts;
  int caustic_photons;    ///< of each light
  double caustic_radius;  ///< of a radiance estimate

  // --- how it is seen ---
  Raytracer();
  /// width * height colours, the top row first.
  std::vector<Vec3> render(int width, int height);
  /// The photons of the global maps, or of the caustic ones, as dots with their power.
  std::vector<Vec3> render_dots(int width, int height, bool caustics);

  // --- rays ---
  bool intersect(const Ray& ray, Intersection* hit) const;
  /// A photon at a mirror or glass goes one way, by chance; false if it ends there.
  bool scatter_photon(const Intersection& hit, Ray* ray, Vec3* power) const;
  const std::vector<std::shared_ptr<LightSource>>& lights() const { return lights_; }

 private:
  void build_maps();
  Ray camera_ray(int x, int y, int width, int height) const;
  Vec3 trace(const Ray& ray, int depth);
  Vec3 shade(const Intersection& hit);
  std::vector<std::shared_ptr<SceneObject>> objects_;
  std::vector<std::shared_ptr<LightSource>> lights_;
};

/// The share of light that glass reflects (Fresnel), and the way of what goes through; 1 if nothing does.
double reflected_share(const Ray& ray, const Intersection& hit, Vec3* through);
Vec3 mirrored(Vec3 direction, Vec3 normal);
