#include "light_source.h"

#include "config.h"
#include "random.h"
#include "raytracer.h"

// A square emits pi * radiance from each unit of its area; its area comes from its half-edges.
Vec3 LightSource::flux() const {
  return square_->material().radiance * PI * 4 * length(cross(square_->a(), square_->b()));
}

Ray LightSource::emit() const {
  double u = 2 * random_unit() - 1, v = 2 * random_unit() - 1;
  Vec3 normal = normalized(cross(square_->a(), square_->b()));
  Vec3 from = square_->center() + square_->a() * u + square_->b() * v;
  double s = random_unit(), t = random_unit();
  return {from, cosine_direction(normal, s, t)};
}

void LightSource::build_global_map(int photons) {
  for (int i = 0; i < photons; ++i) {
    Vec3 power = flux() / photons;
    Ray ray = emit();
    for (int bounce = 0; bounce < MAX_PHOTON_BOUNCES; ++bounce) {
      Intersection hit;
      if (!scene_->intersect(ray, &hit)) break;
      if (hit.material.kind == MaterialKind::diffuse) {
        if (!hit.front) break;
        global_map_.store({hit.position, hit.normal, power});
        // The photon survives with a probability equal to the share of power that it would keep.
        Vec3 left = power * hit.material.colour;
        double chance = largest(left) / largest(power);
        if (random_unit() >= chance) break;
        power = left / chance;
        double u = random_unit(), v = random_unit();
        ray = {hit.position, cosine_direction(hit.normal, u, v)};
      } else if (!scene_->scatter_photon(hit, &ray, &power)) {
        break;
      }
    }
  }
}

void LightSource::build_caustic_map(int photons) {
  for (int i = 0; i < photons; ++i) {
    Vec3 power = flux() / photons;
    Ray ray = emit();
    for (int bounce = 0; bounce < MAX_PHOTON_BOUNCES; ++bounce) {
      Intersection hit;
      if (!scene_->intersect(ray, &hit)) break;
      if (hit.material.kind == MaterialKind::diffuse) {
        // What comes straight from the lamp is direct light.
        if (bounce > 0 && hit.front) caustic_map_.store({hit.position, hit.normal, power});
        break;
      }
      if (!scene_->scatter_photon(hit, &ray, &power)) break;
    }
  }
}

Vec3 LightSource::direct(const Intersection& hit) const {
  Vec3 normal = normalized(cross(square_->a(), square_->b()));
  double area = 4 * length(cross(square_->a(), square_->b()));
  Vec3 sum;
  for (int i = 0; i < SHADOW_RAYS_U; ++i)
    for (int j = 0; j < SHADOW_RAYS_V; ++j) {
      double u = 2 * (i + random_unit()) / SHADOW_RAYS_U - 1, v = 2 * (j + random_unit()) / SHADOW_RAYS_V - 1;
      Vec3 way = square_->center() + square_->a() * u + square_->b() * v - hit.position;
      Ray ray{hit.position, normalized(way)};
      double cos_here = dot(ray.direction, hit.normal), cos_there = -dot(ray.direction, normal);
      if (cos_here <= 0 || cos_there <= 0) continue;
      Intersection first;
      if (scene_->intersect(ray, &first) && first.t < length(way) - EPSILON) continue;
      sum += square_->material().radiance * (cos_here * cos_there * area / std::pow(length(way), 2));
    }
  return sum / (SHADOW_RAYS_U * SHADOW_RAYS_V);
}

Vec3 LightSource::caustic(const Intersection& hit) const {
  return caustic_map_.irradiance(hit.position, hit.normal, CAUSTIC_LOOKUP_PHOTONS, scene_->caustic_radius);
}

Vec3 LightSource::global(const Intersection& hit) {
  Vec3 irradiance;
  if (cache_.interpolate(hit.position, hit.normal, &irradiance)) return irradiance;
  double distance;
  irradiance = gather(hit, &distance);
  cache_.insert({hit.position, hit.normal, irradiance, distance});
  return irradiance;
}

Vec3 LightSource::gather(const Intersection& hit, double* distance) const {
  Vec3 sum;
  double inverse_distances = 0;
  for (int i = 0; i < GATHER_PHI; ++i)
    for (int j = 0; j < GATHER_THETA; ++j) {
      double u = (j + random_unit()) / GATHER_THETA, v = (i + random_unit()) / GATHER_PHI;
      double way;
      sum += gathered_radiance({hit.position, cosine_direction(hit.normal, u, v)}, &way);
      inverse_distances += 1 / way;
    }
  *distance = GATHER_PHI * GATHER_THETA / inverse_distances;
  return sum * PI / (GATHER_PHI * GATHER_THETA);
}

// Radiance along a ray from diffuse surfaces; *distance is that of the first surface on the ray.
Vec3 LightSource::gathered_radiance(Ray ray, double* distance) const {
  Vec3 weight{1, 1, 1};
  *distance = 1e30;
  for (int bounce = 0; bounce < MAX_PHOTON_BOUNCES; ++bounce) {
    Intersection hit;
    if (!scene_->intersect(ray, &hit)) return {};
    if (bounce == 0) *distance = hit.t;
    if (hit.material.kind == MaterialKind::diffuse) {
      if (!hit.front) return {};
      Vec3 arrives = global_map_.irradiance(hit.position, hit.normal, GLOBAL_LOOKUP_PHOTONS, GLOBAL_LOOKUP_RADIUS);
      return weight * hit.material.colour * arrives / PI;
    }
    if (!scene_->scatter_photon(hit, &ray, &weight)) return {};
    // Light enters fewer directions where it is slower: its radiance grows, and its power does not.
    if (hit.material.kind == MaterialKind::glass && (dot(ray.direction, hit.normal) < 0) == hit.front)
      weight = weight * (hit.front ? 1 / std::pow(hit.material.ior, 2) : std::pow(hit.material.ior, 2));
  }
  return {};
}
