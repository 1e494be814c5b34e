#include <cmath>
#include <filesystem>

#include "harness/stress/stress_scene.h"
#include "harness/stress/sweep_rows.h"

namespace photonproof::inline harness_stress {
namespace {

namespace fs = std::filesystem;

StressScene lit(double) { return {lit_stress_scene()}; }

/// The floor is this shape, so large that its visible part is flat.
StressScene with_floor(const Geometry& geometry, const Transform& to_world) {
  SceneDescription scene = lit_stress_scene();
  scene.shapes[0].geometry = geometry;
  scene.shapes[0].to_world = to_world;
  return {scene};
}

double ten_to(double k) { return std::pow(10.0, k); }

Sweep huge_floor(const char* shape, const std::function<StressScene(double)>& level, double first) {
  Sweep sweep{
      "shape " + std::string(shape), "as a huge floor", "10^k times as large as what is seen", {}, 9, level, lit};
  for (double k = first; k <= 15; k += k < 9 ? 1 : 2) sweep.heights.push_back(k);
  return sweep;
}

/// [-8,8]^2 in y = 0 in `count` strips; the middle one is 10^-k wide.
TriangleMesh floor_with_sliver(double k) {
  const float half = static_cast<float>(0.5 * ten_to(-k));
  return mesh_of(
      {{-8, 0, 8}, {-half, 0, 8}, {half, 0, 8}, {8, 0, 8}, {-8, 0, -8}, {-half, 0, -8}, {half, 0, -8}, {8, 0, -8}},
      {{0, 1, 4}, {1, 5, 4}, {1, 2, 5}, {2, 6, 5}, {2, 3, 6}, {3, 7, 6}});
}

/// The floor as a fan of n triangles about one of its corners: thinner needles for larger n.
TriangleMesh fan_floor(int n) {
  std::vector<Vec3f> positions{{-8, 0, 8}};
  std::vector<TriangleMesh::Triangle> triangles;
  for (int i = 0; i <= n; ++i) positions.push_back({8, 0, 8 - 16 * static_cast<float>(i) / static_cast<float>(n)});
  positions.push_back({-8, 0, -8});
  for (std::uint32_t i = 1; i + 1 < positions.size(); ++i) triangles.push_back({0, i, i + 1});
  return mesh_of(positions, triangles);
}

/// The floor's two triangles `copies` times.
TriangleMesh repeated_floor(int copies) {
  TriangleMesh mesh = mesh_of({{-8, 0, 8}, {8, 0, 8}, {8, 0, -8}, {-8, 0, -8}}, {});
  for (int i = 0; i < copies; ++i) mesh.triangles.insert(mesh.triangles.end(), {{0, 1, 2}, {0, 2, 3}});
  return mesh;
}

std::vector<Sweep> huge_floors(const fs::path& assets) {
  const MeshDescription square =
      mesh_file(assets, "square", mesh_of({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}));
  const HeightfieldDescription flat{2, 2, 0, true, HeightfieldNoise{}};
  const auto flat_shape = [](const char* name, const Geometry& geometry) {
    return huge_floor(
        name,
        [=](double k) {
          return with_floor(geometry, lying({0.1, 0, 0.2}, ten_to(k)));
        },
        2);
  };
  return {
      flat_shape("rectangle", RectangleDescription{}),
      flat_shape("disk", DiskDescription{}),
      flat_shape("mesh", square),
      flat_shape("heightfield", flat),
      huge_floor(
          "cube",
          [](double k) {
            return with_floor(CubeDescription{}, standing({0, -ten_to(k), 0}, ten_to(k)));
          },
          2),
      huge_floor(
          "sphere",
          [](double k) {
            return with_floor(SphereDescription{}, standing({0, -ten_to(k), 0}, ten_to(k)));
          },
          6),
      huge_floor(
          "cylinder",
          [](double k) {
            return with_floor(CylinderDescription{{-1, 0, 0}, {1, 0, 0}, 1}, standing({0, -ten_to(k), 0}, ten_to(k)));
          },
          6)};
}

/// An invisible object, which must not matter.
std::vector<Sweep> bystanders() {
  const auto beside = [](const Geometry& geometry, const std::function<Transform(double)>& place) {
    return [=](double k) {
      SceneDescription scene = lit_stress_scene();
      add_shape(scene, geometry, place(k), {0});
      return StressScene{scene};
    };
  };
  const std::vector<double> heights{4, 6, 9, 12, 15, 20, 30};
  std::vector<Sweep> sweeps;
  for (const auto& [name, geometry] : {std::pair<const char*, Geometry>{"sphere", SphereDescription{}},
                                       {"cube", CubeDescription{}},
                                       {"disk", DiskDescription{}}}) {
    const std::string feature = "shape " + std::string(name);
    sweeps.push_back({feature, "tiny in view", "a size of 10^-k, on the floor", heights, 9,
                      beside(geometry,
                             [](double k) {
                               return standing({0, ten_to(-k), 0}, ten_to(-k));
                             }),
                      lit});
    sweeps.push_back({feature, "far away", "10^k away", heights, 9,
                      beside(geometry,
                             [](double k) {
                               return standing(Vec3d{0.6, -0.64, 0.48} * ten_to(k), 1);
                             }),
                      lit});
    sweeps.push_back({feature, "huge, behind the floor", "a size of 10^k", heights, 9,
                      beside(geometry,
                             [](double k) {
                               return standing({0, -2 - ten_to(k), 0}, ten_to(k));
                             }),
                      lit});
  }
  return sweeps;
}

std::vector<Sweep> odd_triangles(const fs::path& assets) {
  const auto floor_of = [=](const std::string& name, const std::function<TriangleMesh(double)>& mesh) {
    return [=](double k) {
      return with_floor(mesh_file(assets, name + "-" + std::to_string(static_cast<int>(k)), mesh(k)), Transform());
    };
  };
  std::vector<Sweep> sweeps{
      {"triangles",
       "slivers",
       "a strip 10^-k wide",
       {2, 4, 6, 7, 9, 12, 20, 37, 44},
       9,
       floor_of("sliver", floor_with_sliver),
       lit},
      {"triangles",
       "long",
       "10^k long, 16 wide",
       {2, 3, 4, 5, 6, 7, 9, 12, 20},
       9,
       floor_of("long",
                [](double k) {
                  const float end = static_cast<float>(ten_to(k));
                  return mesh_of({{-8, 0, 8}, {8, 0, 8}, {8, 0, -end}, {-8, 0, -end}}, {{0, 1, 2}, {0, 2, 3}});
                }),
       lit},
      {"triangles",
       "needles",
       "10^k in a fan",
       {1, 2, 3, 4, 5},
       4,
       floor_of("fan", [](double k) { return fan_floor(static_cast<int>(ten_to(k))); }),
       lit},
      {"triangles",
       "duplicates",
       "10^k copies",
       {1, 2, 3},
       3,
       floor_of("copies", [](double k) { return repeated_floor(static_cast<int>(ten_to(k))); }),
       lit},
      {"triangles",
       "degenerate beside whole ones",
       "10^k without area",
       {0, 2, 4},
       4,
       floor_of(
           "flat",
           [](double k) {
             TriangleMesh mesh = repeated_floor(1);
             for (int i = 0; i < static_cast<int>(ten_to(k)); ++i)
               mesh.triangles.push_back(i % 2 == 0 ? TriangleMesh::Triangle{0, 0, 2} : TriangleMesh::Triangle{1, 1, 1});
             return mesh;
           }),
       lit}};
  return sweeps;
}

/// [-1,1]^3, two triangles a side.
TriangleMesh box_mesh() {
  return mesh_of({{-1, -1, -1}, {1, -1, -1}, {-1, 1, -1}, {1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {-1, 1, 1}, {1, 1, 1}},
                 {{0, 2, 3},
                  {0, 3, 1},
                  {4, 5, 7},
                  {4, 7, 6},
                  {0, 1, 5},
                  {0, 5, 4},
                  {2, 6, 7},
                  {2, 7, 3},
                  {0, 4, 6},
                  {0, 6, 2},
                  {1, 3, 7},
                  {1, 7, 5}});
}

/// The top of a box 10 wide and 10^k high under a sky: the visible edges end long sides.
std::vector<Sweep> towers(const fs::path& assets) {
  std::vector<Sweep> sweeps;
  for (const auto& [name, geometry] :
       {std::pair<const char*, Geometry>{"cube", CubeDescription{}}, {"mesh", mesh_file(assets, "box", box_mesh())}}) {
    Sweep tower{"shape " + std::string(name),
                "a tower, from above",
                "10^k high",
                {2, 4, 5, 6, 7, 8, 9, 12, 15},
                9,
                [geometry = geometry](double k) {
                  SceneDescription scene = empty_stress_scene();
                  const double half = 0.5 * ten_to(k);
                  add_shape(scene, geometry, Transform::translate({0, -half, 0}) * Transform::scale({5, half, 5}),
                            add_bsdf(scene, DiffuseDescription{}));
                  scene.emitters.push_back({{}, "", ConstantLightDescription{}});
                  return StressScene{scene};
                }};
    tower.radiance = 0.5;
    tower.engines = {"path", "photonmapper", "bdpt"};
    sweeps.push_back(tower);
    sweeps.push_back(turned(tower));
    sweeps.back().wanted = 7;  // beyond, rotating so long a box flattens it in double precision
  }
  return sweeps;
}

/// [-1,1]^2 in z = 0 of 71 x 71 squares, each cut in two: ten thousand triangles.
TriangleMesh tile() {
  constexpr std::uint32_t side = 71;
  std::vector<Vec3f> positions;
  std::vector<TriangleMesh::Triangle> triangles;
  const auto at = [](std::uint32_t i) { return 2 * static_cast<float>(i) / side - 1; };
  for (std::uint32_t y = 0; y <= side; ++y)
    for (std::uint32_t x = 0; x <= side; ++x) {
      positions.push_back({at(x), at(y), 0});
      if (x == side || y == side) continue;
      const std::uint32_t corner = y * (side + 1) + x, next_row = corner + side + 1;
      triangles.insert(triangles.end(), {{corner, corner + 1, next_row + 1}, {corner, next_row + 1, next_row}});
    }
  return mesh_of(positions, triangles);
}

/// The floor as copies of one tile, 10^k triangles in all.
Sweep many_copies(const fs::path& assets) {
  const MeshDescription mesh = mesh_file(assets, "tile", tile());
  return {"shape instance",
          "many",
          "10^k triangles in copies of one mesh",
          {4, 6, 8},
          8,
          [mesh](double k) {
            SceneDescription scene = lit_stress_scene();
            const BsdfIndex grey = scene.shapes[0].bsdf;
            ShapeGroupDescription group;
            group.id = "tile";
            ShapeDescription member;
            member.geometry = mesh;
            member.bsdf = grey;
            group.shapes.push_back(member);
            scene.groups.push_back(group);
            scene.shapes.erase(scene.shapes.begin());
            const int side = static_cast<int>(std::lround(ten_to((k - 4) / 2)));
            const double half = 8.0 / side;
            for (int y = 0; y < side; ++y)
              for (int x = 0; x < side; ++x)
                add_shape(scene, InstanceDescription{{0}},
                          lying({half * (2 * x + 1) - 8, 0, half * (2 * y + 1) - 8}, half), grey);
            return StressScene{scene};
          },
          lit};
}

/// Balls of glass that touch up to a gap of 10^-k, and a shell that is as thin.
std::vector<Sweep> touching_and_thin_glass() {
  const std::vector<double> heights{1, 2, 3, 4, 5, 6, 7, 9, 99};
  const auto thin = [](double k) { return k == 99 ? 0 : ten_to(-k); };
  const auto row = [&](const char* sweep_run, const char* measure, const std::function<StressScene(double)>& level) {
    Sweep sweep{"coincident faces", sweep_run, measure, heights, 6, level};
    sweep.radiance = 1;
    sweep.engines = {"path", "photonmapper", "bdpt", "volpath"};
    return sweep;
  };
  const auto touching = [=](double k) {
    SceneDescription scene = ball_in_uniform_sky(DielectricDescription{});
    scene.shapes[0].to_world = standing({-0.6, 0.3, 0}, 0.6);
    add_shape(scene, SphereDescription{}, standing({0.5 + thin(k), 0.3, 0}, 0.5), {0});
    return StressScene{scene};
  };
  const auto shell = [=](double k) {
    SceneDescription scene = ball_in_uniform_sky(DielectricDescription{});
    DielectricDescription air;
    air.int_ior = 1.000277;
    air.ext_ior = 1.5046;
    add_shape(scene, SphereDescription{}, standing({0, 0.3, 0}, 1 - thin(k)), add_bsdf(scene, air));
    return StressScene{scene};
  };
  return {row("glass that touches glass", "balls 10^-k apart; 99: in one point", touching),
          row("a shell of glass", "10^-k thick; 99: without thickness", shell)};
}

/// Two floors of the same material 10^-k apart; 99 stands for the same place.
std::vector<Sweep> near_faces() {
  const std::vector<double> heights{4, 5, 6, 7, 8, 9, 12, 20, 99};
  const auto gap = [](double k) { return k == 99 ? 0 : ten_to(-k); };
  const auto two_floors = [=](double k) {
    SceneDescription scene = lit_stress_scene();
    add_shape(scene, RectangleDescription{}, lying({0, -gap(k), 0}, 8), {0});
    return StressScene{scene};
  };
  // Seen from below: a closed box of nearly no thickness; the only light is above it.
  const auto shell = [](const Geometry& geometry) {
    return [=](double k) {
      SceneDescription scene = lit_stress_scene();
      scene.shapes.erase(scene.shapes.begin());
      add_shape(scene, geometry, Transform::scale({9, 0.5 * ten_to(-k), 9}), {0});
      scene.sensor.to_world = Transform::look_at({0, -4, 7}, {0, 0, 0}, {0, 1, 0});
      return StressScene{scene};
    };
  };
  Sweep box{"coincident faces",      "a thin box, from its dark side", "10^-k thick", {2, 3, 4, 5, 6, 7, 9, 12}, 9,
            shell(CubeDescription{})};
  box.radiance = 0;
  // Glass in glass, with a gap of air of 10^-k between.
  const auto nested = [=](const Geometry& shape) {
    Sweep sweep{"coincident faces", "", "a gap of 10^-k", {1, 2, 3, 4, 5, 6, 7, 9}, 6, [=](double k) {
                  SceneDescription scene = ball_in_uniform_sky(DielectricDescription{});
                  DielectricDescription air;
                  air.int_ior = 1.000277;
                  air.ext_ior = 1.5046;
                  const auto place = [](double size) {
                    return standing({0, 0.3, 0}, size) * Transform::rotate({0, 1, 0}, 30);
                  };
                  add_shape(scene, shape, place(0.5 + gap(k)), add_bsdf(scene, air));
                  add_shape(scene, shape, place(0.5), add_bsdf(scene, DielectricDescription{}));
                  return StressScene{scene};
                }};
    sweep.radiance = 1;
    sweep.engines = {"path", "photonmapper", "bdpt", "volpath"};
    return sweep;
  };
  Sweep glass = nested(SphereDescription{}), boxes = nested(CubeDescription{});
  glass.sweep_run = "glass in glass";
  boxes.sweep_run = "a glass box in a glass box";
  return {{"coincident faces", "two floors", "10^-k apart; 99: in the same place", heights, 99, two_floors, lit},
          box,
          glass,
          boxes};
}

}  // namespace

std::vector<Sweep> shape_sweeps(const fs::path& assets) {
  std::vector<Sweep> sweeps = huge_floors(assets);
  sweeps.push_back(many_copies(assets));
  for (const std::vector<Sweep>& more :
       {bystanders(), odd_triangles(assets), towers(assets), near_faces(), touching_and_thin_glass()})
    sweeps.insert(sweeps.end(), more.begin(), more.end());
  return sweeps;
}

}  // namespace photonproof::inline harness_stress
