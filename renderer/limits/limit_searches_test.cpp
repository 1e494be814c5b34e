// Searches for close faces, near lights and grazing lights among many shapes. The reference is the same question about
// each pair of shapes or each light alone, where a search has nothing to leave out. Work is counted at n and at 4 n.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "renderer/integrators/test_scenes.h"
#include "renderer/lanes/test_random.h"
#include "renderer/limits/close_faces.h"
#include "renderer/limits/grazing_lights.h"
#include "renderer/limits/near_lights.h"
#include "renderer/limits/surface_faces.h"

namespace photonproof::inline renderer_limits {
namespace {

using test::Random;

double signed_unit(Random& random) { return 2 * double{random.next()} - 1; }
Vec3d place(Random& random, double reach) {
  return Vec3d(signed_unit(random), signed_unit(random), signed_unit(random)) * reach;
}

SceneDescription stage(const decltype(BsdfDescription::model)& model) {
  SceneDescription d;
  test::add_bsdf(d, model);
  test::set_camera(d, Transform::look_at({0, -4, 12}, {0, 0, 0}, {0, 1, 0}), 40, 4);
  return d;
}

/// Turned, sheared by uneven scales, and mirrored.
Transform random_transform(Random& random) {
  const auto side = [&] { return (random.next() < 0.5f ? -1 : 1) * (0.1 + double{random.next()}); };
  const double along_x = side(), along_y = side();
  const Vec3d size{along_x, along_y, 0.5};
  const Transform turned =
      random.next() < 0.5f ? Transform() : Transform::rotate(place(random, 1), 360 * signed_unit(random));
  return Transform::translate(place(random, 2)) * turned * Transform::scale(size);
}

/// Glass, of which each second shape lies up to about `off` from an earlier one.
SceneDescription random_glass(Random& random, int count, double off) {
  SceneDescription d = stage(DielectricDescription{});
  for (int i = 0; i < count; ++i) {
    const float kind = random.next();
    if (i > 0 && random.next() < 0.5f) {
      ShapeDescription copy = d.shapes[static_cast<std::size_t>(random.next() * static_cast<float>(i))];
      copy.to_world = Transform::translate(place(random, random.next() < 0.5f ? off : 5 * off)) * copy.to_world;
      // Many lie over a narrow border alone.
      if (std::holds_alternative<RectangleDescription>(copy.geometry) && random.next() < 0.7f)
        copy.to_world =
            copy.to_world * Transform::translate({1.99 * signed_unit(random), 1.99 * signed_unit(random), 0});
      if (auto* ball = std::get_if<SphereDescription>(&copy.geometry)) ball->radius += off * signed_unit(random);
      d.shapes.push_back(copy);
    } else if (kind < 0.4f) {
      test::add_shape(d, SphereDescription{place(random, 2), 0.1 + double{random.next()}}, {}, {0});
    } else if (kind < 0.7f) {
      test::add_shape(d, RectangleDescription{}, random_transform(random), {0});
    } else {
      test::add_shape(d, CubeDescription{}, random_transform(random), {0});
    }
  }
  return d;
}

TEST(limit_searches, find_close_glass_as_every_pair_of_shapes_does) {
  std::size_t pairs = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Random random(seed);
    // In every other scene less is resolved: the coordinates of rays are larger than those of faces.
    const double coarser = seed % 2 == 0 ? 1 : 64;
    SceneDescription d = random_glass(random, 40, 2e-6 * coarser);
    const Transform resized = Transform::scale(Vec3d(seed % 3 == 0 ? 1 : seed % 3 == 1 ? 0x1p115 : 0x1p-150));
    for (ShapeDescription& shape : d.shapes) shape.to_world = resized * shape.to_world;
    d.sensor.to_world = resized * d.sensor.to_world;
    SceneFrame frame = SceneParts(d, 4, 4).frame;
    frame.coordinate_floor = static_cast<float>(4 * coarser);
    std::map<std::pair<std::size_t, std::size_t>, double> expected, found;
    for (std::size_t i = 0; i < d.shapes.size(); ++i)
      for (std::size_t k = i + 1; k < d.shapes.size(); ++k) {
        SceneDescription both = d;
        both.shapes = {d.shapes[i], d.shapes[k]};
        for (const CloseFaces& close : close_faces_of_glass(both, frame)) expected[{i, k}] = close.apart;
      }
    for (const CloseFaces& close : close_faces_of_glass(d, frame)) found[{close.first, close.second}] = close.apart;
    EXPECT_EQ(found, expected) << seed;
    pairs += expected.size();
  }
  EXPECT_GT(pairs, 100);
}

/// A wall across x = 0, where no order by x helps.
template <class Add>
SceneDescription wall(int side, const decltype(BsdfDescription::model)& model, const Add& add) {
  SceneDescription d = stage(model);
  for (int i = 0; i < side * side; ++i)
    add(d, Transform::translate({0, 4.0 * (i % side) / side - 2, 4.0 * (i / side) / side - 2}) *
               Transform::rotate({0, 1, 0}, 90) * Transform::scale(Vec3d(1.6 / side)));
  return d;
}

TEST(limit_searches, compare_a_few_faces_of_glass_with_each) {
  for (const auto& geometry : {decltype(ShapeDescription::geometry)(RectangleDescription{}),
                               decltype(ShapeDescription::geometry)(SphereDescription{}),
                               decltype(ShapeDescription::geometry)(CubeDescription{})}) {
    const auto compared_with = [&](int side) {
      const SceneDescription d = wall(side, DielectricDescription{}, [&](SceneDescription& to, const Transform& at) {
        test::add_shape(to, geometry, at, {0});
      });
      std::size_t compared = 0;
      EXPECT_TRUE(close_faces_of_glass(d, SceneParts(d, 4, 4).frame, &compared).empty());
      return static_cast<double>(compared) / (side * side);
    };
    const double few = compared_with(12), many = compared_with(24);
    EXPECT_LE(few, 100) << geometry.index();
    EXPECT_LE(many, few * 1.3 + 1) << geometry.index();
  }
}

TEST(limit_searches, find_lights_on_surfaces_as_one_light_at_a_time_does) {
  std::size_t total = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    Random random(seed);
    SceneDescription d = stage(DiffuseDescription{});
    std::vector<std::size_t> lit;
    for (int i = 0; i < 30; ++i) {
      const Transform at = random_transform(random);
      test::add_shape(d, RectangleDescription{}, at, {0});
      if (random.next() < 0.3f) continue;
      lit.push_back(d.shapes.size());
      const double off = random.next() < 0.5f ? 1e-7 : 1e-3;
      test::add_shape(d, RectangleDescription{}, at * Transform::translate({0, 0, off}) * Transform::scale(Vec3d(0.3)),
                      {0});
    }
    std::map<std::size_t, double> expected, found;
    for (std::size_t i = 0; i < lit.size(); ++i) {
      SceneDescription one = d;
      one.shapes[lit[i]].radiance = RgbD(1);
      for (const NearLight& light : lights_on_surfaces(SceneParts(one, 4, 4))) expected[i] = light.height;
    }
    for (const std::size_t i : lit) d.shapes[i].radiance = RgbD(1);
    for (const NearLight& light : lights_on_surfaces(SceneParts(d, 4, 4))) found[light.light] = light.height;
    EXPECT_EQ(found, expected) << seed;
    total += expected.size();
  }
  EXPECT_GT(total, 50);
}

TEST(limit_searches, find_beams_along_faces_as_one_beam_at_a_time_does) {
  std::size_t total = 0;
  for (std::uint64_t seed = 0; seed < 12; ++seed) {
    Random random(seed);
    SceneDescription d = stage(DiffuseDescription{});
    const Transform turned = Transform::rotate(place(random, 1), 50);
    for (int i = 0; i < 9; ++i)
      test::add_shape(d, RectangleDescription{}, turned * Transform::translate({2.0 * (i % 3), 2.0 * (i / 3), 0}), {0});
    std::vector<EmitterDescription> beams;
    for (int i = 0; i < 60; ++i) {
      DirectionalLightDescription beam;
      const double turn = 2 * double{pi} * double{random.next()};
      const double down = random.next() < 0.7f ? 1.3e-4 * signed_unit(random) : signed_unit(random);
      beam.direction = turned.vector({std::cos(turn), std::sin(turn), down});
      beam.irradiance = RgbD(1);
      beams.push_back({{}, "", beam});
    }
    std::map<std::size_t, double> expected, found;
    for (std::size_t i = 0; i < beams.size(); ++i) {
      d.emitters = {beams[i]};
      for (const GrazingLight& light : grazing_lights(SceneParts(d, 4, 4))) expected[i] = light.height;
    }
    d.emitters = beams;
    for (const GrazingLight& light : grazing_lights(SceneParts(d, 4, 4))) found[light.light] = light.height;
    EXPECT_EQ(found, expected) << seed;
    total += expected.size();
  }
  EXPECT_GT(total, 100);
}

struct Place {
  Vec3d at;
  double within;
  std::size_t looks = 0;
};

TEST(limit_searches, look_at_all_places_near_a_surface) {
  std::size_t total = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    Random random(seed);
    SceneDescription d = stage(DiffuseDescription{});
    for (int i = 0; i < 20; ++i) test::add_shape(d, RectangleDescription{}, random_transform(random), {0});
    for (int i = 0; i < 10; ++i)
      test::add_shape(d, SphereDescription{place(random, 2), 0.1 + double{random.next()}}, {}, {0});
    const SceneParts scene(d, 4, 4);
    std::vector<Place> places;
    for (int i = 0; i < 100; ++i) places.push_back({place(random, 3), 0.5 * double{random.next()}});
    const PlaceTree<Place> tree(places);
    for (std::size_t i = 0; i < scene.surfaces.size(); ++i) {
      for (Place& p : places) p.looks = 0;
      tree.look_at(scene.surfaces[i], scene.boxes[i], [&](Place& p, const Vec3d&, const Vec3d&) { ++p.looks; });
      Extent box{Vec3d(scene.boxes[i].low), Vec3d(scene.boxes[i].high)};
      for_each_face(scene.surfaces[i], [&](const FlatFace& face) { box = extent_of_face(face); });
      for (const Place& p : places) {
        EXPECT_EQ(p.looks, comes_near(box, p.at, p.within) ? 1 : 0) << seed << " " << i;
        total += p.looks;
      }
    }
  }
  EXPECT_GT(total, 1000);
}

TEST(limit_searches, look_at_a_few_places_from_each_surface) {
  const auto looks_with = [](int side) {
    const SceneDescription d = wall(side, DiffuseDescription{}, [](SceneDescription& to, const Transform& at) {
      test::add_shape(to, RectangleDescription{}, at, {0});
    });
    const SceneParts scene(d, 4, 4);
    std::vector<Place> places;
    for (const Surface& surface : scene.surfaces) {
      const Quad& quad = std::get<Quad>(surface.geometry);
      places.push_back({Vec3d(quad.corner) + Vec3d(quad.edge_u + quad.edge_v) / 2, 1e-3});
    }
    const PlaceTree<Place> tree(places);
    std::size_t looks = 0;
    for (std::size_t i = 0; i < scene.surfaces.size(); ++i)
      tree.look_at(scene.surfaces[i], scene.boxes[i], [&](Place&, const Vec3d&, const Vec3d&) { ++looks; });
    return looks;
  };
  EXPECT_EQ(looks_with(10), 100);
  EXPECT_EQ(looks_with(20), 400);
}

}  // namespace
}  // namespace photonproof::inline renderer_limits
