#include "reference/povray/povray_materials.h"

#include <set>
#include <stdexcept>

#include "scenes/text/text_numbers.h"

namespace photonproof {
namespace {

struct Material {
  std::string explanation;
  std::string texture;
  std::string interior;  ///< empty when there is none
};

Material material(const DiffuseDescription& diffuse) {
  return {"diffuse: radiance is pigment times irradiance over pi, with POV-Ray's diffuse and no ambient",
          "pigment{" + sdl_rgb(constant(diffuse.reflectance)) + "} finish{ambient 0 diffuse 1/Brightness emission 0}",
          ""};
}

Material material(const ConductorDescription& conductor) {
  return {"conductor without an index: reflects the same share at every angle",
          "pigment{rgb 0} finish{ambient 0 diffuse 0 reflection{" + sdl_rgb(constant(conductor.specular_reflectance)) +
              "}}",
          ""};
}

template <class Other>
Material material(const Other&) {
  throw std::logic_error("lower_scene lets no such bsdf through");
}

Material material(const DielectricDescription& glass) {
  // A filter multiplies what passes a surface by the pigment, once a crossing and not on total internal reflection:
  // just what specular_transmittance does.
  const Vec3d& t = constant(glass.specular_transmittance);
  const std::string filter = "<" + format_number(t.x) + "," + format_number(t.y) + "," + format_number(t.z) + ",1>";
  return {
      "dielectric: Fresnel reflection, the rest refracted and filtered by specular_transmittance at each crossing; "
      "ior is interior over exterior",
      "pigment{rgbf " + filter + "} finish{ambient 0 diffuse 0 reflection{0,1 fresnel on} conserve_energy}",
      "ior " + format_number(glass.int_ior / glass.ext_ior)};
}

}  // namespace

std::size_t bsdf_number(const PovScene& scene, const PovSurface& surface) {
  return static_cast<std::size_t>(surface.bsdf - scene.description->bsdfs.data());
}

void write_materials(const PovScene& scene, SdlWriter& out) {
  std::set<std::size_t> used;
  for (const PovSurface& surface : scene.surfaces) used.insert(bsdf_number(scene, surface));
  out.explain("one-sided surfaces are black from behind: their interior_texture");
  out.line("#declare Black = texture{pigment{rgb 0} finish{ambient 0 diffuse 0 emission 0}}");
  out.line("#declare Clear = texture{pigment{rgbt 1} finish{ambient 0 diffuse 0 emission 0}}");
  for (const std::size_t i : used) {
    const BsdfDescription& bsdf = scene.description->bsdfs[i];
    const Material m = std::visit([](const auto& model) { return material(model); }, bsdf.model);
    const std::string number = std::to_string(i);
    out.explain("bsdf '" + bsdf.id + "' of " + scene.description->where(bsdf.loc) + ": " + m.explanation);
    out.line("#declare Bsdf_" + number + " = texture{" + m.texture + "}");
    if (!m.interior.empty()) out.line("#declare Interior_" + number + " = interior{" + m.interior + "}");
  }
}

}  // namespace photonproof
