#include "raytracer.h"

#include "config.h"
#include "random.h"

Raytracer::Raytracer() : caustic_photons(CAUSTIC_PHOTONS), caustic_radius(CAUSTIC_LOOKUP_RADIUS) {}

void Raytracer::add(std::shared_ptr<SceneObject> object) { objects_.push_back(object); }

void Raytracer::add_light(std::shared_ptr<Square> square) {
  add(square);
  lights_.push_back(std::make_shared<LightSource>(square, this));
}

void Raytracer::add_water(std::shared_ptr<SceneObject> water) {
  add(water);
  caustic_photons = CAUSTIC_PHOTONS_WATER;
  caustic_radius = CAUSTIC_LOOKUP_RADIUS_WATER;
}

bool Raytracer::intersect(const Ray& ray, Intersection* hit) const {
  bool any = false;
  for (std::shared_ptr<SceneObject> object : objects_) {
    Intersection one;
    if (object->intersect(ray, &one) && (!any || one.t < hit->t)) {
      *hit = one;
      any = true;
    }
  }
  return any;
}

Vec3 mirrored(Vec3 direction, Vec3 normal) { return normalized(direction - normal * (2 * dot(direction, normal))); }

double reflected_share(const Ray& ray, const Intersection& hit, Vec3* through) {
  Vec3 n = hit.front ? hit.normal : -hit.normal;
  double ratio = hit.front ? 1 / hit.material.ior : hit.material.ior;
  double cos_in = std::min(1.0, -dot(ray.direction, n));
  double sin2_out = ratio * ratio * (1 - cos_in * cos_in);
  if (sin2_out >= 1) return 1;  // total reflection
  double cos_out = std::sqrt(1 - sin2_out);
  *through = normalized(ray.direction * ratio + n * (ratio * cos_in - cos_out));
  double parallel = (cos_in - ratio * cos_out) / (cos_in + ratio * cos_out);
  double across = (ratio * cos_in - cos_out) / (ratio * cos_in + cos_out);
  return (parallel * parallel + across * across) / 2;
}

bool Raytracer::scatter_photon(const Intersection& hit, Ray* ray, Vec3* power) const {
  if (hit.material.kind == MaterialKind::mirror) {
    if (!hit.front) return false;
    *power = *power * hit.material.colour;
    *ray = {hit.position, mirrored(ray->direction, hit.normal)};
    return true;
  }
  if (hit.material.kind != MaterialKind::glass) return false;
  Vec3 through;
  if (random_unit() < reflected_share(*ray, hit, &through)) {
    *ray = {hit.position, mirrored(ray->direction, hit.normal)};
  } else {
    *power = *power * hit.material.colour;
    *ray = {hit.position, through};
  }
  return true;
}

Vec3 Raytracer::shade(const Intersection& hit) {
  Vec3 sum;
  for (std::shared_ptr<LightSource> light : lights_) {
    if (parts.direct) sum += light->direct(hit);
    if (parts.caustic) sum += light->caustic(hit);
    if (parts.global) sum += light->global(hit);
  }
  return sum * hit.material.colour / PI;
}

// The radiance that arrives along a ray.
Vec3 Raytracer::trace(const Ray& ray, int depth) {
  Intersection hit;
  if (depth > MAX_DEPTH || !intersect(ray, &hit)) return {};
  Vec3 through;
  switch (hit.material.kind) {
    case MaterialKind::light:
      return hit.front && parts.lamp ? hit.material.radiance : Vec3{};
    case MaterialKind::diffuse:
      if (!hit.front) return {};
      // A little before the surface: rays from the very edge of the room would pass between its walls.
      hit.position = ray.at(hit.t - 100 * EPSILON);
      return shade(hit);
    case MaterialKind::mirror:
      if (!hit.front) return {};
      return hit.material.colour * trace({hit.position, mirrored(ray.direction, hit.normal)}, depth + 1);
    case MaterialKind::glass: {
      double share = reflected_share(ray, hit, &through);
      Vec3 sum = share * trace({hit.position, mirrored(ray.direction, hit.normal)}, depth + 1);
      if (share < 1) {
        // Light enters fewer directions where it is slower, so its radiance grows.
        double squeezed = std::pow(hit.front ? 1 / hit.material.ior : hit.material.ior, 2);
        sum += hit.material.colour * trace({hit.position, through}, depth + 1) * ((1 - share) * squeezed);
      }
      return sum;
    }
  }
  return {};
}

void Raytracer::build_maps() {
  for (std::shared_ptr<LightSource> light : lights_) {
    light->build_global_map(GLOBAL_PHOTONS);
    light->build_caustic_map(caustic_photons);
  }
}

// The ray through the middle of a pixel.
Ray Raytracer::camera_ray(int x, int y, int width, int height) const {
  int full_width = camera.full_width ? camera.full_width : width;
  int full_height = camera.full_height ? camera.full_height : height;
  Vec3 right = normalized(cross(camera.direction, camera.up)), up = cross(right, camera.direction);
  double half = std::tan(camera.fov / 2 * PI / 180);  // of the height, at distance 1
  double u = (camera.left + x + 0.5 - full_width / 2.0) / (full_height / 2.0);
  double v = 1 - (camera.top + y + 0.5) / (full_height / 2.0);
  Vec3 way = camera.direction + right * (u * half) + up * (v * half);
  return {camera.position + way * camera.near, normalized(way)};
}

std::vector<Vec3> Raytracer::render(int width, int height) {
  build_maps();
  std::vector<Vec3> picture;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) picture.push_back(trace(camera_ray(x, y, width, height), 1));
  return picture;
}

std::vector<Vec3> Raytracer::render_dots(int width, int height, bool caustics) {
  build_maps();
  std::vector<Vec3> picture;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      Intersection hit;
      Vec3 sum;
      // About half the distance between pixels at the middle of the room.
      double reach = length(camera.position) / height / 2;
      if (intersect(camera_ray(x, y, width, height), &hit))
        for (std::shared_ptr<LightSource> light : lights_)
          for (Photon photon : (caustics ? light->caustic_map() : light->global_map())
                                   .nearest(hit.position, hit.front ? hit.normal : -hit.normal, 1, reach))
            sum += photon.power / largest(photon.power);
      picture.push_back(sum);
    }
  return picture;
}
