// Scenes 1 to 3.
#include <stdexcept>

#include "config.h"
#include "cube.h"
#include "displaced_surface.h"
#include "raytracer.h"
#include "sphere.h"

static Material diffuse(Vec3 colour) { return {MaterialKind::diffuse, colour, 1, {}}; }
static Material mirror() { return {MaterialKind::mirror, {0.7, 0.7, 0.7}, 1, {}}; }
static Material glass() { return {MaterialKind::glass, {0.89, 0.89, 0.89}, 1.8, {}}; }

// The room, 100 wide and closed on all sides, and its light. The camera is outside; its rays start inside.
static void add_room(Raytracer* scene, Vec3 left, Vec3 right) {
  Material grey = diffuse({0.7, 0.7, 0.7});
  Vec3 x{50, 0, 0}, y{0, 50, 0}, z{0, 0, 50};
  scene->add(std::make_shared<Square>(-y, z, x, grey));  // floor
  scene->add(std::make_shared<Square>(y, x, z, grey));   // ceiling
  scene->add(std::make_shared<Square>(-z, x, y, grey));  // back
  scene->add(std::make_shared<Square>(z, y, x, grey));   // front
  scene->add(std::make_shared<Square>(-x, y, z, diffuse(left)));
  scene->add(std::make_shared<Square>(x, z, y, diffuse(right)));
  Material lamp{MaterialKind::light, {}, 1, {}};
  lamp.radiance = Vec3{1, 1, 1} * (15000 / (PI * 32 * 32));
  scene->add_light(std::make_shared<Square>(Vec3{0, 49.99, 0}, Vec3{16, 0, 0}, Vec3{0, 0, 16}, lamp));
}

static void add_water(Raytracer* scene, double height) {
  Water water{{0, height, 0}, {50, 0, 0},      {0, 0, -50}, {0, 1, 0}, WATER_CELLS,
              WATER_CELLS,    0.14 * 50 / 1.2, 0.14 * 50,   0};
  Material material{MaterialKind::glass, {1, 1, 1}, 1.3, {}};
  scene->add_water(std::make_shared<DisplacedSurface>(water, material));
}

void Raytracer::build_scene(int number) {
  switch (number) {
    case 1:
      add_room(this, {0.92941176, 0.52156863, 0.14117647}, {0.14117647, 0.52156863, 0.92941176});
      add(std::make_shared<Sphere>(Vec3{-27, -30, -30}, 20, mirror()));
      add(std::make_shared<Sphere>(Vec3{29, -30, -5}, 20, glass()));
      return;
    case 2:
      add_room(this, {0.14117647, 0.52156863, 0.92941176}, {0, 0.8, 0});
      add(std::make_shared<Sphere>(Vec3{-27, -30, -30}, 20, mirror()));
      ::add_water(this, 22);
      return;
    case 3:
      add_room(this, {0.878, 0.106, 0.298}, {0.933, 0.969, 0.271});
      add(std::make_shared<Sphere>(Vec3{27, 30, 30}, 20, mirror()));
      add(std::make_shared<Sphere>(Vec3{-29, 30, 5}, 20, glass()));
      ::add_water(this, -22);
      return;
  }
  throw std::runtime_error("there is no scene " + std::to_string(number));
}
