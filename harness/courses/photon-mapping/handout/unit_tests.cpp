// make test: tests of parts of the program. Add your own.
#include <cstdio>
#include <fstream>

#include "config.h"
#include "cube.h"
#include "displaced_surface.h"
#include "image.h"
#include "noise.h"
#include "random.h"
#include "raytracer.h"
#include "sphere.h"

static int failures = 0;

static void expect_near(const char* what, double found, double expected, double within) {
  if (std::fabs(found - expected) <= within) return;
  std::printf("%s is %g, not %g\n", what, found, expected);
  ++failures;
}

static void test_random() {
  // The numbers of two seeds are independent of each other, at any distance.
  std::vector<double> first(200);
  seed_random(1);
  for (double& value : first) value = random_unit();
  seed_random(2);
  int alike = 0;
  for (int i = 0; i < 200; ++i) {
    double value = random_unit();
    for (double other : first) alike += value == other;
  }
  expect_near("numbers that two seeds share", alike, 0, 0);
}

static void test_objects() {
  Intersection hit;
  Ray down{{1, 5, 2}, {0, -1, 0}};
  expect_near("a square below is met", Square({0, 1, 0}, {0, 0, 3}, {3, 0, 0}, {}).intersect(down, &hit), 1, 0);
  expect_near("the way to it", hit.t, 4, 1e-12);
  expect_near("its front", hit.front, 1, 0);
  expect_near("a square beside is met", Square({9, 1, 0}, {0, 0, 3}, {3, 0, 0}, {}).intersect(down, &hit), 0, 0);
  Cube cube({0, 0, 0}, {3, 0, 0}, {0, 2, 0}, {0, 0, 3}, {});
  expect_near("a cube is met", cube.intersect(down, &hit), 1, 0);
  expect_near("the way to its top", hit.t, 3, 1e-12);
  // From the middle of a sphere its surface is a radius away, seen from behind.
  expect_near("a sphere is met", Sphere({1, 5, 2}, 7, {}).intersect(down, &hit), 1, 0);
  expect_near("its radius", hit.t, 7, 1e-12);
  expect_near("its front", hit.front, 0, 0);
}

static void test_water() {
  Water flat{{0, 3, 0}, {50, 0, 0}, {0, 0, -50}, {0, 1e-9, 0}, 20, 20, 7, 7, 0};
  Intersection hit;
  Ray slanted{{-20, 13, 4}, normalized({3, -1, 0.5})};
  expect_near("still water is met", DisplacedSurface(flat, {}).intersect(slanted, &hit), 1, 0);
  expect_near("its height", hit.position.y, 3, 1e-6);
  Water waves = flat;
  waves.up = {0, 1, 0};
  DisplacedSurface surface(waves, {});
  // Straight down onto a corner of the grid.
  Ray down{{-50 + 7 * 5.0 + 1e-7, 20, 50 - 9 * 5.0 - 1e-7}, {0, -1, 0}};
  expect_near("waves are met", surface.intersect(down, &hit), 1, 0);
  expect_near("their height", hit.position.y, 3 + surface.height(7, 9), 1e-6);
  expect_near("noise at a corner of its lattice", noise(4, -2, 0), 0, 1e-12);
}

static void test_photon_map() {
  PhotonMap map;
  for (int i = 0; i < 2000; ++i) {
    double x = random_unit() * 10, y = random_unit() * 10;
    map.store({{x, y, 0}, {0, 0, 1}, {0.05, 0.1, 0.2}});
  }
  std::vector<Photon> found = map.nearest({5, 5, 0}, {0, 0, 1}, 30, 9);
  expect_near("photons found", double(found.size()), 30, 0);
  for (std::size_t i = 1; i < found.size(); ++i)
    if (length(found[i].position - Vec3{5, 5, 0}) < length(found[i - 1].position - Vec3{5, 5, 0}))
      expect_near("photons in their order", 0, 1, 0);
  expect_near("photons of the other side", double(map.nearest({5, 5, 0}, {0, 0, -1}, 30, 9).size()), 0, 0);
  // 2000 photons of 0.1 on 100 units of area; the estimate uses about 1250, so its deviation is 3 %.
  expect_near("irradiance", map.irradiance({5, 5, 0}, {0, 0, 1}, 5000, 4.5).y, 2, 0.25);
}

static void test_cache() {
  IrradianceCache cache;
  Vec3 irradiance;
  expect_near("an empty cache knows", cache.interpolate({}, {0, 1, 0}, &irradiance), 0, 0);
  cache.insert({{}, {0, 1, 0}, {1, 2, 3}, 5});
  double near = CACHE_TOLERANCE * std::max(5.0, CACHE_MIN_SPACING) * 0.9;
  expect_near("a cache knows what is near", cache.interpolate({near, 0, 0}, {0, 1, 0}, &irradiance), 1, 0);
  expect_near("what it knows", irradiance.z, 3, 1e-9);
  expect_near("a cache knows what is far", cache.interpolate({near * 1.5, 0, 0}, {0, 1, 0}, &irradiance), 0, 0);
}

// Light on the middle of the floor. A parallel square of half-side s, h above a small patch, has the form factor 4 s/r
// atan(s/r) 2 / (2 pi). Here r = sqrt(s^2 + h^2) (Howell, a catalogue of factors).
static void test_direct_light() {
  Raytracer scene;
  Material lamp{MaterialKind::light, {}, 1, {2, 2, 2}};
  scene.add_light(std::make_shared<Square>(Vec3{0, 10, 0}, Vec3{5, 0, 0}, Vec3{0, 0, 5}, lamp));
  scene.add(std::make_shared<Square>(Vec3{}, Vec3{0, 0, 50}, Vec3{50, 0, 0}, Material()));
  Intersection hit;
  scene.intersect({{0, 5, 0}, {0, -1, 0}}, &hit);
  double r = std::sqrt(125), sum = 0;
  for (int i = 0; i < 100; ++i) sum += scene.lights()[0]->direct(hit).x / 100;
  expect_near("direct light", sum, 2 * PI * 4 * 2 * (5 / r) * std::atan(5 / r) / (2 * PI), 0.02);
}

static void test_glass() {
  Material material{MaterialKind::glass, {1, 1, 1}, 1.5, {}};
  Intersection hit;
  Vec3 through;
  Ray ray{{0, 5, 0}, {0, -1, 0}};
  Sphere({0, 0, 0}, 1, material).intersect(ray, &hit);
  expect_near("what glass reflects", reflected_share(ray, hit, &through), 0.04, 1e-12);  // (0.5 / 2.5)^2
  expect_near("straight through", through.y, -1, 1e-12);
}

static void test_scene_file() {
  const char* name = "unit_tests.scene";
  std::ofstream(name) << "# one\ncamera 0 0 9  0 0 -2  0 1 0  40 0.1\nsphere 0 0 0  1\n  mirror 1 1 1 # two\n";
  Raytracer scene;
  scene.build_scene_file(name);
  std::remove(name);
  Intersection hit;
  expect_near("a sphere of a file is met", scene.intersect({{0, 0, 9}, {0, 0, -1}}, &hit), 1, 0);
  expect_near("the way to it", hit.t, 8, 1e-12);
  expect_near("a camera of a file", scene.camera.direction.z, -1, 1e-12);
}

int main() {
  test_random();
  test_objects();
  test_water();
  test_photon_map();
  test_cache();
  test_direct_light();
  test_glass();
  test_scene_file();
  expect_near("half as a byte", to_byte(0.5), 128, 0);
  expect_near("more than white as a byte", to_byte(7), 255, 0);
  std::printf(failures ? "%d failures\n" : "all tests pass\n", failures);
  return failures ? 1 : 0;
}
