#include "render.h"

#include "config.h"
#include "raytracer.h"
#include "threads.h"

Renderer::Renderer(const PackedScene& scene, const std::vector<Lamp>& lamps, bool has_water, const Parts& parts)
    : scene_(scene), lamps_(lamps), parts_(parts) {
  caustic_radius_ = has_water ? CAUSTIC_LOOKUP_RADIUS_WATER : CAUSTIC_LOOKUP_RADIUS;
  global_map_.build(trace_photons(false, GLOBAL_PHOTONS));
  caustic_map_.build(trace_photons(true, has_water ? CAUSTIC_PHOTONS_WATER : CAUSTIC_PHOTONS));
  light_maps_.resize(scene.rectangles().size());
  for (std::size_t i = 0; i < light_maps_.size(); ++i) {
    const Rectangle& r = scene.rectangles()[i];
    if (scene.material(r.material).kind != MaterialKind::diffuse) continue;
    auto cells = [](double side) { return std::min(std::max(int(side / (GLOBAL_LOOKUP_RADIUS / 2)), 1), 512); };
    LightMap& map = light_maps_[i];
    map.columns = cells(2 * length(r.a)), map.rows = cells(2 * length(r.b));
    map.known.reset(new std::atomic<bool>[map.columns * map.rows] {});
    map.values.reset(new Vec3[map.columns * map.rows]);
  }
}

// The share of a ray that glass reflects (Fresnel), and the direction of the transmitted part.
static double reflected_share(const Ray& ray, const Hit& hit, Vec3* through) {
  Vec3 n = hit.front ? hit.normal : -hit.normal;
  double ratio = hit.front ? 1 / hit.material->ior : hit.material->ior;
  double cos_in = std::min(1.0, -dot(ray.direction, n)), sin2_out = ratio * ratio * (1 - cos_in * cos_in);
  if (sin2_out >= 1) return 1;
  double cos_out = std::sqrt(1 - sin2_out);
  *through = normalized(ray.direction * ratio + n * (ratio * cos_in - cos_out));
  double parallel = (cos_in - ratio * cos_out) / (cos_in + ratio * cos_out);
  double across = (ratio * cos_in - cos_out) / (ratio * cos_in + cos_out);
  return (parallel * parallel + across * across) / 2;
}

static Vec3 mirrored(Vec3 d, Vec3 n) { return normalized(d - n * (2 * dot(d, n))); }

bool Renderer::scatter(const Hit& hit, Ray* ray, Vec3* power, Random& random) const {
  const Material& material = *hit.material;
  if (material.kind == MaterialKind::mirror) {
    if (!hit.front) return false;
    *power = *power * material.colour;
    *ray = {hit.position, mirrored(ray->direction, hit.normal)};
    return true;
  }
  if (material.kind != MaterialKind::glass) return false;
  Vec3 through;
  if (random() < reflected_share(*ray, hit, &through)) {
    *ray = {hit.position, mirrored(ray->direction, hit.normal)};
  } else {
    *power = *power * material.colour;
    *ray = {hit.position, through};
  }
  return true;
}

void Renderer::trace_photon(const Lamp& lamp, Vec3 power, bool caustics, Random& random,
                            std::vector<Photon>* photons) const {
  Vec3 s, t;
  frame(lamp.normal, &s, &t);
  double u = 2 * random() - 1, v = 2 * random() - 1, p = random(), q = random();
  Ray ray{lamp.center + lamp.a * u + lamp.b * v, cosine_direction(lamp.normal, s, t, p, q)};
  for (int bounce = 0; bounce < MAX_PHOTON_BOUNCES; ++bounce) {
    Hit hit;
    if (!scene_.first_hit(ray, &hit)) return;
    if (hit.material->kind != MaterialKind::diffuse) {
      if (!scatter(hit, &ray, &power, random)) return;
      continue;
    }
    if (!hit.front || (caustics && bounce == 0)) return;
    photons->push_back(make_photon(hit.position, hit.normal, power));
    if (caustics) return;
    Vec3 left = power * hit.material->colour;
    double chance = largest(left) / largest(power);
    if (random() >= chance) return;
    power = left / chance;
    frame(hit.normal, &s, &t);
    p = random(), q = random();
    ray = {hit.position, cosine_direction(hit.normal, s, t, p, q)};
  }
}

std::vector<Photon> Renderer::trace_photons(bool caustics, int count) const {
  const int chunk = 512;
  int chunks = (count + chunk - 1) / chunk;
  std::vector<std::vector<Photon>> parts(chunks * lamps_.size());
  for_each(int(parts.size()), [&](int i) {
    const Lamp& lamp = lamps_[i / chunks];
    Vec3 power = lamp.radiance * (PI * lamp.area / count);
    int first = i % chunks * chunk;
    for (int j = first; j < std::min(count, first + chunk); ++j) {
      Random random(caustics ? 1 : 2, uint64_t(i / chunks) << 40 | uint64_t(j));
      trace_photon(lamp, power, caustics, random, &parts[i]);
    }
  });
  std::vector<Photon> all;
  for (const std::vector<Photon>& part : parts) all.insert(all.end(), part.begin(), part.end());
  return all;
}

Vec3 Renderer::direct(const Hit& hit, Random& random) const {
  Vec3 all;
  for (const Lamp& lamp : lamps_) {
    double sum = 0;
    for (int i = 0; i < SHADOW_RAYS_U; ++i)
      for (int j = 0; j < SHADOW_RAYS_V; ++j) {
        double u = 2 * (i + random()) / SHADOW_RAYS_U - 1, v = 2 * (j + random()) / SHADOW_RAYS_V - 1;
        Vec3 way = lamp.center + lamp.a * u + lamp.b * v - hit.position;
        double far2 = dot(way, way), far = std::sqrt(far2);
        Ray ray{hit.position, way * (1 / far)};
        double cos_here = dot(ray.direction, hit.normal), cos_there = -dot(ray.direction, lamp.normal);
        if (cos_here <= 0 || cos_there <= 0 || scene_.blocked(ray, far - EPSILON)) continue;
        sum += cos_here * cos_there / far2;
      }
    all += lamp.radiance * (sum * lamp.area / (SHADOW_RAYS_U * SHADOW_RAYS_V));
  }
  return all;
}

Vec3 Renderer::global_irradiance(const Hit& hit) {
  if (hit.rectangle < 0)
    return global_map_.irradiance(hit.position, hit.normal, GLOBAL_LOOKUP_PHOTONS, GLOBAL_LOOKUP_RADIUS);
  LightMap& map = light_maps_[hit.rectangle];
  int column = std::min(std::max(int((hit.u + 1) / 2 * map.columns), 0), map.columns - 1);
  int row = std::min(std::max(int((hit.v + 1) / 2 * map.rows), 0), map.rows - 1);
  int i = row * map.columns + column;
  if (map.known[i].load(std::memory_order_acquire)) return map.values[i];
  const Rectangle& r = scene_.rectangles()[hit.rectangle];
  Vec3 middle = r.center + r.a * (2 * (column + 0.5) / map.columns - 1) + r.b * (2 * (row + 0.5) / map.rows - 1);
  Vec3 value = global_map_.irradiance(middle, hit.normal, GLOBAL_LOOKUP_PHOTONS, GLOBAL_LOOKUP_RADIUS);
  map.values[i] = value;
  map.known[i].store(true, std::memory_order_release);
  return value;
}

Vec3 Renderer::gathered_radiance(Ray ray, double* distance, Random& random) {
  Vec3 weight{1, 1, 1};
  *distance = 1e30;
  for (int bounce = 0; bounce < MAX_PHOTON_BOUNCES; ++bounce) {
    Hit hit;
    if (!scene_.first_hit(ray, &hit)) return {};
    if (bounce == 0) *distance = hit.t;
    const Material& material = *hit.material;
    if (material.kind == MaterialKind::diffuse)
      return hit.front ? weight * material.colour * global_irradiance(hit) / PI : Vec3{};
    if (!scatter(hit, &ray, &weight, random)) return {};
    if (material.kind == MaterialKind::glass && (dot(ray.direction, hit.normal) < 0) == hit.front)
      weight = weight * (hit.front ? 1 / (material.ior * material.ior) : material.ior * material.ior);
  }
  return {};
}

Vec3 Renderer::global(const Hit& hit, Random& random) {
  Vec3 irradiance;
  if (cache_.interpolate(hit.position, hit.normal, &irradiance)) return irradiance;
  Vec3 s, t, sum;
  frame(hit.normal, &s, &t);
  double inverse_distances = 0;
  for (int i = 0; i < GATHER_PHI; ++i)
    for (int j = 0; j < GATHER_THETA; ++j) {
      double u = (j + random()) / GATHER_THETA, v = (i + random()) / GATHER_PHI, way;
      sum += gathered_radiance({hit.position, cosine_direction(hit.normal, s, t, u, v)}, &way, random);
      inverse_distances += 1 / way;
    }
  irradiance = sum * PI / (GATHER_PHI * GATHER_THETA);
  cache_.insert({hit.position, hit.normal, irradiance, GATHER_PHI * GATHER_THETA / inverse_distances});
  return irradiance;
}

Vec3 Renderer::shade(const Hit& hit, Random& random) {
  Vec3 sum;
  if (parts_.direct) sum += direct(hit, random);
  if (parts_.caustic) sum += caustic_map_.irradiance(hit.position, hit.normal, CAUSTIC_LOOKUP_PHOTONS, caustic_radius_);
  if (parts_.global) sum += global(hit, random);
  return sum * hit.material->colour / PI;
}

Vec3 Renderer::trace(const Ray& ray, int depth, Random& random) {
  Hit hit;
  if (depth > MAX_DEPTH || !scene_.first_hit(ray, &hit)) return {};
  const Material& material = *hit.material;
  switch (material.kind) {
    case MaterialKind::light:
      return hit.front && parts_.lamp ? material.radiance : Vec3{};
    case MaterialKind::diffuse:
      if (!hit.front) return {};
      hit.position = ray.at(hit.t - 100 * EPSILON);
      return shade(hit, random);
    case MaterialKind::mirror:
      if (!hit.front) return {};
      return material.colour * trace({hit.position, mirrored(ray.direction, hit.normal)}, depth + 1, random);
    case MaterialKind::glass: {
      Vec3 through;
      double share = reflected_share(ray, hit, &through);
      Vec3 sum = share * trace({hit.position, mirrored(ray.direction, hit.normal)}, depth + 1, random);
      if (share < 1) {
        double squeezed = hit.front ? 1 / (material.ior * material.ior) : material.ior * material.ior;
        sum += material.colour * trace({hit.position, through}, depth + 1, random) * ((1 - share) * squeezed);
      }
      return sum;
    }
  }
  return {};
}
