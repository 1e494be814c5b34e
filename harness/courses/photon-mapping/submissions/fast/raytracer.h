// A scene during its construction; Renderer (render.h) renders it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "packed_scene.h"
#include "scene_object.h"
#include "square.h"

struct Camera {
  Vec3 position{0, 0, 150}, direction{0, 0, -1}, up{0, 1, 0};
  double fov = 52.62529698957768, near = 100.1;
  int full_width = 0, full_height = 0, left = 0, top = 0;
};

struct Parts {
  bool direct = true, caustic = true, global = true, lamp = true;
};

class Raytracer {
 public:
  void add(std::shared_ptr<SceneObject> object) { object->pack(&scene_); }
  void add_light(std::shared_ptr<Square> square);
  void add_water(std::shared_ptr<SceneObject> water);
  void build_scene(int number);
  void build_scene_file(const std::string& name);
  Camera camera;
  Parts parts;

  std::vector<Vec3> render(int width, int height);
  std::vector<Vec3> render_dots(int width, int height, bool caustics);

 private:
  Ray camera_ray(int x, int y, int width, int height) const;
  PackedScene scene_;
  std::vector<Lamp> lamps_;
  bool has_water_ = false;
};
