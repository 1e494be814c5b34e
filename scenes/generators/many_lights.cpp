#include "scenes/generators/many_lights.h"

#include <array>
#include <cmath>
#include <cstdio>

#include "scenes/generators/gradient_noise.h"

namespace photonproof::inline scenes_generators {
namespace {

constexpr const char* kHead =
    R"(<!-- Blocks and balls among %d small lights, made by `photonproof generate many-lights`. -->
<scene version="3.0.0">
  <default name="size" value="128"/>

  <integrator type="path">
    <integer name="max_depth" value="-1"/>
  </integrator>

  <sensor type="perspective">
    <float name="fov" value="42"/>
    <string name="fov_axis" value="x"/>
    <transform name="to_world">
      <lookat origin="0, 4.2, 7.5" target="0, 0.2, 0" up="0, 1, 0"/>
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

  <bsdf type="diffuse" id="grey">
    <rgb name="reflectance" value="0.6"/>
  </bsdf>
  <bsdf type="diffuse" id="black">
    <rgb name="reflectance" value="0"/>
  </bsdf>

  <!-- Floor, normal +y. -->
  <shape type="rectangle">
    <transform name="to_world">
      <scale value="5"/>
      <rotate x="1" angle="-90"/>
    </transform>
    <ref id="grey"/>
  </shape>
)";

constexpr const char* kBlock = R"(  <shape type="cube">
    <transform name="to_world">
      <scale x="0.3" y="%.2f" z="0.3"/>
      <rotate y="1" angle="%d"/>
      <translate x="%d" y="%.2f" z="%d"/>
    </transform>
    <ref id="grey"/>
  </shape>
)";

constexpr const char* kBall =
    "  <shape type=\"sphere\"><point name=\"center\" value=\"%d,0.4,%d\"/><float name=\"radius\" value=\"0.4\"/>"
    "<ref id=\"grey\"/></shape>\n";

constexpr const char* kLight =
    "  <shape type=\"sphere\"><point name=\"center\" value=\"%.3f,%.3f,%.3f\"/><float name=\"radius\" value=\"0.02\"/>"
    "<ref id=\"black\"/><emitter type=\"area\"><rgb name=\"radiance\" value=\"%.3g,%.3g,%.3g\"/></emitter></shape>\n";

template <class... Values>
std::string text(const char* format, Values... values) {
  std::array<char, 2048> buffer{};
  std::snprintf(buffer.data(), buffer.size(), format, values...);
  return buffer.data();
}

double draw(int light, std::uint32_t dimension, double from, double to) {
  return from + (to - from) * unit_hash(static_cast<std::uint32_t>(light), dimension, 0, 1);
}

/// Above the floor, outside the blocks and balls: each stands on its own unit square's middle, 0.42 from it at most.
Vec3d place(int light) {
  for (std::uint32_t attempt = 0;; attempt += 3) {
    const Vec3d p{draw(light, attempt, -4.5, 4.5), draw(light, attempt + 1, 0.06, 1.8),
                  draw(light, attempt + 2, -4.5, 4.5)};
    const bool over_even_square = static_cast<int>(std::lround(p.x) + std::lround(p.z)) % 2 == 0;
    if (!over_even_square || std::hypot(p.x - std::round(p.x), p.z - std::round(p.z)) > 0.46) return p;
  }
}

/// From red through white to blue, some ten times as bright as others.
RgbD radiance(int light, int lights) {
  const double warmth = draw(light, 1000, 0, 1);
  const double brightness = 13'000.0 / lights * std::pow(10.0, draw(light, 1001, -0.5, 0.5));
  return RgbD{0.5 + warmth, 0.9, 1.5 - warmth} * brightness;
}

}  // namespace

std::string many_lights_scene(int lights) {
  std::string scene = text(kHead, lights);
  for (int z = -4; z <= 4; ++z)
    for (int x = -4; x <= 4; ++x) {
      if ((x + z) % 2 != 0) continue;  // the even squares, as in `place`
      const auto which = static_cast<std::uint32_t>((z + 4) * 9 + x + 4);
      const double height = 0.2 + 0.5 * unit_hash(which, 0, 0, 2);
      scene += which % 4 == 0 ? text(kBall, x, z)
                              : text(kBlock, height, static_cast<int>(90 * unit_hash(which, 1, 0, 2)), x, height, z);
    }
  scene +=
      "\n  <!-- The lights: " + std::to_string(lights) + " balls of radius 0.02, black, so that they only emit. -->\n";
  for (int light = 0; light < lights; ++light) {
    const Vec3d p = place(light);
    const RgbD L = radiance(light, lights);
    scene += text(kLight, p.x, p.y, p.z, L.x, L.y, L.z);
  }
  return scene + "</scene>\n";
}

std::string many_lights_expect(int lights) {
  return "purpose = \"Choosing among " + std::to_string(lights) +
         " small lights: each is bright near by and nothing further away.\"\nexposure = 0.0\n";
}

}  // namespace photonproof::inline scenes_generators
