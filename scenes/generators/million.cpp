#include "scenes/generators/million.h"

#include <algorithm>
#include <cmath>

#include "scenes/files/atomic_file.h"
#include "scenes/generators/terrain.h"
#include "scenes/meshes/ply.h"

namespace photonproof::inline scenes_generators {
namespace {

const char* const kGround = "terrain.ply";
const char* const kRocks = "rocks.ply";

std::uint64_t rock_triangles(const MillionPlan& plan) {
  return std::uint64_t{plan.rocks} * 20 << (2 * plan.rock_level);
}

/// The squarest grid within a thousandth of `cells` cells. Otherwise it is the grid nearest to `cells` among those
/// whose cells are at most half as long again as wide.
void plan_grid(double cells, MillionPlan& plan) {
  const auto side = static_cast<std::uint32_t>(std::sqrt(cells));
  double least = cells;
  for (std::uint32_t away = 0; away <= side / 6 && least > 1e-3 * cells; ++away)
    for (const std::uint32_t columns : {side - away, side + away}) {
      const auto rows = static_cast<std::uint32_t>(std::lround(cells / columns));
      const double error = std::abs(cells - static_cast<double>(columns) * rows);
      if (error >= least) continue;
      least = error;
      plan.columns = columns;
      plan.rows = rows;
    }
}

const char* const kView = R"(<scene version="3.0.0">
  <default name="size" value="256"/>

  <integrator type="path">
    <integer name="max_depth" value="5"/>
  </integrator>

  <sensor type="perspective">
    <float name="fov" value="44"/>
    <string name="fov_axis" value="smaller"/>
    <float name="near_clip" value="0.01"/>
    <float name="far_clip" value="1000"/>
    <transform name="to_world">
      <lookat origin="0, 4.6, 11.5" target="0, 0.9, -2" up="0, 1, 0"/>
    </transform>
    <film type="hdrfilm">
      <integer name="width" value="$size"/>
      <integer name="height" value="$size"/>
      <string name="component_format" value="float32"/>
      <rfilter type="box"/>
    </film>
    <sampler type="independent">
      <integer name="sample_count" value="16"/>
    </sampler>
  </sensor>

)";

const char* const kLand = R"(  <shape type="ply" id="ground">
    <string name="filename" value="terrain.ply"/>
    <boolean name="face_normals" value="true"/>
    <bsdf type="diffuse">
      <rgb name="reflectance" value="0.34, 0.36, 0.17"/>
    </bsdf>
  </shape>
  <shape type="ply" id="rocks">
    <string name="filename" value="rocks.ply"/>
    <boolean name="face_normals" value="true"/>
    <bsdf type="diffuse">
      <rgb name="reflectance" value="0.5, 0.48, 0.46"/>
    </bsdf>
  </shape>

)";

const char* const kLakeAndSky = R"(  <!-- The lake, normal +y. -->
  <shape type="rectangle" id="lake">
    <transform name="to_world">
      <scale value="10"/>
      <rotate x="1" angle="-90"/>
      <translate y="-0.3"/>
    </transform>
    <bsdf type="diffuse">
      <rgb name="reflectance" value="0.06, 0.16, 0.24"/>
    </bsdf>
  </shape>
  <!-- The sky is a painted wall behind the mountains, normal +z. -->
  <shape type="rectangle" id="sky">
    <transform name="to_world">
      <scale x="40" y="25"/>
      <translate y="12" z="-14"/>
    </transform>
    <bsdf type="diffuse">
      <rgb name="reflectance" value="0.4, 0.6, 0.85"/>
    </bsdf>
  </shape>

)";

const char* const kSkylight = R"(  <shape type="rectangle" id="light">
    <transform name="to_world">
      <scale value="5"/>
      <lookat origin="-14, 20, 8" target="0, 0, -2" up="0, 1, 0"/>
    </transform>
    <bsdf type="diffuse">
      <rgb name="reflectance" value="0"/>
    </bsdf>
    <emitter type="area">
      <rgb name="radiance" value="30, 27, 22"/>
    </emitter>
  </shape>
</scene>
)";

std::string scene_text(const MillionPlan& plan) {
  return "<!-- A procedural landscape of " + std::to_string(plan.triangles()) +
         R"( triangles, made by `photonproof generate million`: mountains behind
     hills, rocks on them, a lake, and one large light high above on the left. -->
)" + kView +
         kLand + kLakeAndSky + kSkylight;
}

std::string expect_text(const MillionPlan& plan) {
  std::string text =
      "purpose = \"A landscape of a thousand to ten million triangles from one parameter: how an engine's time and "
      "memory "
      "grow with the scene.\"\nexposure = 0.0\n";
  if (plan.triangles() > 1'050'000)
    text +=
        "\n[unsupported]\npovray = \"A million triangles take POV-Ray's parser some 250 MB and seconds; more are not a "
        "comparison worth their while.\"\n";
  return text;
}

}  // namespace

std::uint64_t MillionPlan::triangles() const { return std::uint64_t{2} * columns * rows + rock_triangles(*this); }

MillionPlan plan_million(std::uint64_t triangles) {
  MillionPlan plan;
  plan.rocks = static_cast<std::uint32_t>(std::min<std::uint64_t>(300, triangles / 100));
  // Rocks get a fifth of the triangles at most.
  for (MillionPlan finer = plan; rock_triangles(finer) <= triangles / 5; ++finer.rock_level)
    plan.rock_level = finer.rock_level;
  plan_grid(static_cast<double>(triangles - rock_triangles(plan)) / 2, plan);
  return plan;
}

std::vector<std::string> million_files() { return {"scene.xml", "expect.toml", kGround, kRocks}; }

void write_million(const std::filesystem::path& folder, const MillionPlan& plan) {
  write_ply(folder / kGround, make_ground(plan.columns, plan.rows));
  write_ply(folder / kRocks, make_rocks(plan.rocks, plan.rock_level));
  write_file_atomically(folder / "expect.toml", expect_text(plan));
  write_file_atomically(folder / "scene.xml", scene_text(plan));  // last: a scene's meshes are there before it is
}

}  // namespace photonproof::inline scenes_generators
