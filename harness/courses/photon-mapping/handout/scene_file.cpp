// Reads a scene from a file in the format of README.md.
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "cube.h"
#include "displaced_surface.h"
#include "raytracer.h"
#include "sphere.h"

static Vec3 read_vec(std::istream& words) {
  Vec3 v;
  words >> v.x >> v.y >> v.z;
  return v;
}

static Material read_material(std::istream& words) {
  Material material;
  std::string kind;
  words >> kind;
  Vec3 colour = read_vec(words);
  if (kind == "light") {
    material.kind = MaterialKind::light;
    material.colour = {};
    material.radiance = colour;
    return material;
  }
  material.colour = colour;
  if (kind == "mirror") {
    material.kind = MaterialKind::mirror;
  } else if (kind == "glass") {
    material.kind = MaterialKind::glass;
    words >> material.ior;
  } else if (kind != "diffuse") {
    words.setstate(std::ios::failbit);
  }
  return material;
}

static void read_camera(std::istream& words, Camera* camera) {
  camera->position = read_vec(words);
  camera->direction = normalized(read_vec(words));
  camera->up = read_vec(words);
  words >> camera->fov >> camera->near;
}

static void read_object(const std::string& kind, std::istream& words, Raytracer* scene) {
  Vec3 center = read_vec(words);
  if (kind == "sphere") {
    double radius;
    words >> radius;
    scene->add(std::make_shared<Sphere>(center, radius, read_material(words)));
    return;
  }
  Vec3 a = read_vec(words), b = read_vec(words);
  if (kind == "square") {
    Material material = read_material(words);
    std::shared_ptr<Square> square = std::make_shared<Square>(center, a, b, material);
    material.kind == MaterialKind::light ? scene->add_light(square) : scene->add(square);
    return;
  }
  Vec3 c = read_vec(words);
  if (kind == "cube") {
    scene->add(std::make_shared<Cube>(center, a, b, c, read_material(words)));
  } else if (kind == "water") {
    Water water;
    water.center = center, water.a = a, water.b = b, water.up = c;
    words >> water.columns >> water.rows >> water.frequency_a >> water.frequency_b >> water.seed;
    scene->add_water(std::make_shared<DisplacedSurface>(water, read_material(words)));
  } else {
    words.setstate(std::ios::failbit);
  }
}

void Raytracer::build_scene_file(const std::string& name) {
  std::ifstream file(name);
  if (!file) throw std::runtime_error("cannot read " + name);
  std::stringstream words;
  std::string line, kind;
  while (std::getline(file, line)) words << line.substr(0, line.find('#')) << '\n';
  for (int number = 1; words >> kind; ++number) {
    if (kind == "camera") {
      read_camera(words, &camera);
    } else if (kind == "film") {
      words >> camera.full_width >> camera.full_height >> camera.left >> camera.top;
    } else {
      read_object(kind, words, this);
    }
    if (!words) throw std::runtime_error(name + ": cannot read entry " + std::to_string(number) + ", " + kind);
  }
}
