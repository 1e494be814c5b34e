#include "reference/povray/povray_pigments.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <stdexcept>
#include <utility>

#include "reference/optics/sky_lights.h"
#include "reference/povray/sdl_text.h"
#include "scenes/base/text_numbers.h"
#include "scenes/description/overloaded.h"

namespace photonproof::inline reference_povray {
namespace {

std::string file_name(std::size_t texture, const std::string& stem) {
  return stem + "_texture_" + std::to_string(texture) + ".exr";
}

/// Radius of the ball that shows a sky which lights by other means, in radii of the scene. It lies beyond every plane;
/// planes end at a thousand.
constexpr double kSkyDistance = 2500;

std::string sky_name(const std::string& stem) { return stem + "_sky.exr"; }

std::string back_to_uv(const Transform& to_uv) {
  Transform flat = to_uv;  // its x and y rows count, of u and v
  for (const std::size_t i : {2u, 6u, 8u, 9u, 11u}) flat.m[i] = 0;
  flat.m[10] = 1;
  return flat == Transform() ? "" : matrix_sdl(flat.inverse().value());
}

/// The repeated unit of an image that is mirrored at its edges.
std::shared_ptr<const Image> repeated_unit(const BitmapDescription& bitmap) {
  if (bitmap.wrap != TextureWrap::mirror) return bitmap.image;
  const Image& image = *bitmap.image;
  auto unit = std::make_shared<Image>(2 * image.width, 2 * image.height);
  for (int y = 0; y < unit->height; ++y)
    for (int x = 0; x < unit->width; ++x) {
      const float* from =
          image.pixel(x < image.width ? x : unit->width - 1 - x, y < image.height ? y : unit->height - 1 - y);
      std::copy(from, from + 3, unit->pixel(x, y));
    }
  return unit;
}

void collect(const SceneDescription& scene, const Colour& colour, std::set<std::size_t>& used) {
  const auto* index = std::get_if<TextureIndex>(&colour);
  if (index && std::holds_alternative<BitmapDescription>(scene.textures[index->value].pattern))
    used.insert(index->value);
}

void collect(const SceneDescription& scene, const BsdfDescription& side, std::set<std::size_t>& used) {
  if (const auto* diffuse = std::get_if<DiffuseDescription>(&side.model)) collect(scene, diffuse->reflectance, used);
  if (const auto* blend = std::get_if<BlendDescription>(&side.model))
    for (const BsdfIndex part : {blend->first, blend->second}) collect(scene, scene.bsdfs[part.value], used);
}

/// As Mitsuba has them: u and v of a place on the unit sphere, disc or cylinder (from z = 0 to 1) about z.
std::pair<std::string, std::string> round_uv(PovUv uv) {
  const std::string turn = "mod(atan2(y,x)/(2*pi)+1,1)";
  switch (uv) {
    case PovUv::sphere:
      return {turn, "acos(max(-1,min(1,z/sqrt(x*x+y*y+z*z))))/pi"};
    case PovUv::disk:
      return {"sqrt(x*x+y*y)", turn};
    default:
      return {turn, "z"};
  }
}

}  // namespace

std::string matrix_sdl(const Transform& to, double scale) {
  std::string text;
  for (const Vec3d& axis : {Vec3d{1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, 0, 1}}) {
    const Vec3d image = to.vector(axis) * scale;
    text += format_number(image.x) + "," + format_number(image.y) + "," + format_number(image.z) + ", ";
  }
  const Vec3d origin = to.point({0, 0, 0}) * scale;
  return " matrix<" + text + format_number(origin.x) + "," + format_number(origin.y) + "," + format_number(origin.z) +
         ">";
}

std::string map_name(TextureIndex texture) { return "Map_" + std::to_string(texture.value); }

std::string map_declaration(const SceneDescription& scene, TextureIndex texture, const std::string& stem) {
  return "#declare " + map_name(texture) + " = function{" + pigment_sdl(scene, texture, stem) + "}";
}

std::string mapped_pigment(TextureIndex texture, const std::string& u, const std::string& v, double greatest,
                           bool filter) {
  // A pattern is a number from 0 to below 1: a channel each, and their mean times three.
  const double most = greatest > 0 ? greatest * 1.001 : 1;
  std::string entries;
  for (const auto& [channel, axis] : {std::pair{"red", 0}, std::pair{"green", 1}, std::pair{"blue", 2}}) {
    std::string full;
    for (int i = 0; i < 3; ++i) full += format_number(i == axis ? 3 * most : 0) + (i < 2 ? "," : "");
    const std::string black = filter ? "rgbf <0,0,0,1>" : "rgb 0";
    entries += "[1 function{" + map_name(texture) + "(" + u + "," + v + ",0)." + channel + "/" + format_number(most) +
               "} color_map{[0 " + black + "][1 " + (filter ? "rgbf <" + full + ",1>" : "rgb <" + full + ">") + "]}]";
  }
  return "pigment{average pigment_map{" + entries + "}}";
}

std::string pigment_sdl(const SceneDescription& scene, const Colour& colour, const std::string& stem, PovUv uv) {
  if (const auto* rgb = std::get_if<RgbD>(&colour)) return "pigment{" + sdl_rgb(*rgb) + "}";
  if (uv != PovUv::flat) {
    const auto [u, v] = round_uv(uv);
    return mapped_pigment(std::get<TextureIndex>(colour), u, v, range_of(scene, colour).greatest, false);
  }
  const std::size_t index = std::get<TextureIndex>(colour).value;
  return std::visit(
      Overloaded{[&](const BitmapDescription& bitmap) {
                   // POV-Ray's first row is at v = 1: turned about v = 0 the unit square repeats the right way up.
                   return "pigment{image_map{exr \"" + file_name(index, stem) + "\"" +
                          (bitmap.filter == TextureFilter::bilinear ? " interpolate 2" : "") + "} scale <1,-1,1>" +
                          (bitmap.wrap == TextureWrap::mirror ? " scale <2,2,1>" : "") + back_to_uv(bitmap.to_uv) + "}";
                 },
                 [&](const CheckerboardDescription& board) {
                   // Cells of half a unit; z = 0 is in the middle of the lowest layer of them.
                   return "pigment{checker " + sdl_rgb(constant(board.color0)) + ", " +
                          sdl_rgb(constant(board.color1)) + " translate z*-0.5 scale 0.5" + back_to_uv(board.to_uv) +
                          "}";
                 },
                 [](const auto&) -> std::string { throw std::logic_error("range_of refuses other textures"); }},
      scene.textures[index].pattern);
}

std::string sky_sdl(const PovScene& scene, double exposure, double scale, const std::string& stem) {
  if (!scene.sky) return "background{rgb 0}";
  const auto* map = std::get_if<EnvmapDescription>(&scene.sky->light);
  if (!map) return "background{" + sdl_rgb(mean_radiance(*scene.sky) * exposure) + "}";
  // POV-Ray's u is the angle from +x towards +z over a turn; an envmap's middle is towards +z and its +x left of it.
  const Transform turn = map->to_world;
  Transform only_turns = turn;
  for (const std::size_t i : {3u, 7u, 11u}) only_turns.m[i] = 0;
  const std::string seen = "pigment{image_map{exr \"" + sky_name(stem) +
                           "\" map_type 1 interpolate 2} matrix<0,0,-1, 0,1,0, 1,0,0, 0,0,0>" +
                           matrix_sdl(only_turns, 1 / turn.similarity_scale()) + "}";
  if (!scene.sky_as_lights) return "sky_sphere{" + seen + "}";
  const Vec3d middle = scene.center * scale;
  return "background{rgb 0} sphere{0, 1 hollow texture{" + seen + " finish{ambient 0 diffuse 0 emission 1}} scale " +
         format_number(kSkyDistance * scene.radius * scale) + " translate " + sdl_vector(middle) +
         " no_shadow no_radiosity}";
}

std::vector<PovFile> image_files(const PovScene& scene, double exposure, const std::string& stem) {
  const SceneDescription& description = *scene.description;
  std::set<std::size_t> used;
  for (const PovSurface& surface : scene.surfaces) {
    for (const BsdfDescription* side : {surface.sides.front, surface.sides.back})
      if (side) collect(description, *side, used);
    if (surface.shape->radiance) collect(description, *surface.shape->radiance, used);
  }
  for (const EmitterDescription& emitter : description.emitters)
    if (const auto* spot = std::get_if<SpotLightDescription>(&emitter.light); spot && spot->texture)
      collect(description, *spot->texture, used);
  std::vector<PovFile> files;
  for (const std::size_t i : used)
    files.push_back({file_name(i, stem), repeated_unit(std::get<BitmapDescription>(description.textures[i].pattern))});
  if (scene.sky)
    if (const auto* map = std::get_if<EnvmapDescription>(&scene.sky->light))
      files.push_back({sky_name(stem), sky_image(*map, exposure)});
  return files;
}

}  // namespace photonproof::inline reference_povray
