#include "raytracer.h"

#include "random.h"
#include "render.h"
#include "threads.h"

void Raytracer::add_light(std::shared_ptr<Square> square) {
  add(square);
  lamps_.push_back(square->lamp());
}

void Raytracer::add_water(std::shared_ptr<SceneObject> water) {
  add(water);
  has_water_ = true;
}

Ray Raytracer::camera_ray(int x, int y, int width, int height) const {
  int full_width = camera.full_width ? camera.full_width : width;
  int full_height = camera.full_height ? camera.full_height : height;
  Vec3 right = normalized(cross(camera.direction, camera.up)), up = cross(right, camera.direction);
  double half = std::tan(camera.fov / 2 * PI / 180);
  double u = (camera.left + x + 0.5 - full_width / 2.0) / (full_height / 2.0);
  double v = 1 - (camera.top + y + 0.5) / (full_height / 2.0);
  Vec3 way = camera.direction + right * (u * half) + up * (v * half);
  return {camera.position + way * camera.near, normalized(way)};
}

std::vector<Vec3> Raytracer::render(int width, int height) {
  Renderer renderer(scene_, lamps_, has_water_, parts);
  std::vector<Vec3> picture(width * height);
  const int tile = 8;
  int across = (width + tile - 1) / tile, down = (height + tile - 1) / tile;
  for_each(across * down, [&](int i) {
    for (int y = i / across * tile; y < std::min(height, (i / across + 1) * tile); ++y)
      for (int x = i % across * tile; x < std::min(width, (i % across + 1) * tile); ++x) {
        Random random(3, y * width + x);
        picture[y * width + x] = renderer.trace(camera_ray(x, y, width, height), 1, random);
      }
  });
  return picture;
}

std::vector<Vec3> Raytracer::render_dots(int width, int height, bool caustics) {
  Renderer renderer(scene_, lamps_, has_water_, parts);
  std::vector<Vec3> picture(width * height);
  for_each(height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      Hit hit;
      if (!scene_.first_hit(camera_ray(x, y, width, height), &hit)) continue;
      const KdTree& map = caustics ? renderer.caustic_map() : renderer.global_map();
      const Photon* photon =
          map.nearest(hit.position, hit.front ? hit.normal : -hit.normal, length(camera.position) / height / 2);
      if (!photon) continue;
      Vec3 power{photon->power[0], photon->power[1], photon->power[2]};
      picture[y * width + x] = power / largest(power);
    }
  });
  return picture;
}
