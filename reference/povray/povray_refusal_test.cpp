// Every reason why a scene is not written for POV-Ray, each with the whole message.
#include <gtest/gtest.h>

#include "reference/engines/not_representable.h"
#include "reference/engines/test_refusals.h"
#include "reference/povray/povray_export.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline reference_povray {
namespace {

const std::string kLight = "<emitter type='point'><point name='position' value='0 5 0'/></emitter>\n";
const std::string kGlass = "<shape type='sphere'><bsdf type='dielectric'/></shape>\n";

/// The refusal message for a scene with a camera in line 1 and `content` from line 2 on.
std::string refusal(const std::string& content, const std::string& camera = kCamera,
                    const PovrayOptions& options = {}) {
  return refusal_by([&](const SceneDescription& scene) { export_povray(scene, options); }, content, camera);
}

const std::string kNot = " error: not representable in POV-Ray: ";

std::string ball(const std::string& bsdf) { return "<shape type='sphere'>" + bsdf + "</shape>" + kLight; }

TEST(povray_refuses, what_is_glossy) {
  const std::string why =
      "POV-Ray's glossy highlights answer light_sources only and are no microfacets, and its mirrors are smooth";
  EXPECT_EQ(refusal(ball("<bsdf type='roughconductor'/>")), "2:22:" + kNot + "a rough conductor: " + why);
  EXPECT_EQ(refusal(ball("<bsdf type='roughdielectric'/>")), "2:22:" + kNot + "a rough dielectric: " + why);
  EXPECT_EQ(refusal(ball("<bsdf type='roughplastic'/>")), "2:22:" + kNot + "a rough plastic: " + why);
  EXPECT_EQ(refusal(ball("<bsdf type='phong'/>")),
            "2:22:" + kNot +
                "phong: POV-Ray's is without the cosine of the light's incidence and answers light_sources only");
}

TEST(povray_refuses, principled_bsdfs) {
  const std::string why =
      ": POV-Ray's glossy highlights answer light_sources only and are no microfacets, and its "
      "mirrors are smooth";
  EXPECT_EQ(refusal(ball("<bsdf type='principled'/>")), "2:22:" + kNot + "a principled BSDF" + why);
  EXPECT_EQ(refusal(ball("<bsdf type='principledthin'/>")), "2:22:" + kNot + "a thin principled BSDF" + why);
}

TEST(povray_refuses, diffuse_transmitters) {
  EXPECT_EQ(refusal(ball("<bsdf type='difftrans'/>")), "2:22:" + kNot + "a diffuse transmitter: POV-Ray has none");
}

TEST(povray_refuses, curves_and_signed_distances) {
  EXPECT_EQ(refusal("<shape type='bsplinecurve'><string name='filename' value='../curve_set_corpus/bspline'/></shape>" +
                    kLight),
            "2:1:" + kNot + "curves: POV-Ray's sphere_sweep has round ends, is solid and has no texture coordinates");
}

TEST(povray_refuses, ellipsoids) {
  for (const std::string type : {"ellipsoids", "ellipsoidsmesh"})
    EXPECT_EQ(refusal("<shape type='" + type +
                      "'><string name='filename' value='../ellipsoid_cloud_corpus/plain'/></shape>" + kLight),
              "2:1:" + kNot + "ellipsoids of a file: POV-Ray would see their inside");
}

TEST(povray_refuses, coats_and_maps) {
  EXPECT_EQ(refusal(ball("<bsdf type='plastic'/>")), "no refusal");
  EXPECT_EQ(refusal(ball("<bsdf type='plastic'><texture name='diffuse_reflectance' type='checkerboard'/></bsdf>")),
            "2:22:" + kNot + "a texture of something else than diffuse reflectance or radiance");
  EXPECT_EQ(refusal(ball("<bsdf type='plastic'><float name='ext_ior' value='1.6'/></bsdf>")),
            "2:22:" + kNot + "a coat of a lower index than what is above it");
  EXPECT_EQ(refusal(ball("<bsdf type='layered'><bsdf type='diffuse'/></bsdf>")), "no refusal");
  EXPECT_EQ(refusal(ball("<bsdf type='layered'><bsdf type='conductor'/></bsdf>")),
            "2:22:" + kNot + "a lacquer over something else than a diffuse base");
  EXPECT_EQ(refusal(ball("<bsdf type='bumpmap'><texture type='checkerboard'/><bsdf type='diffuse'/></bsdf>")),
            "2:22:" + kNot + "a bump map: POV-Ray perturbs normals by another rule");
}

TEST(povray_refuses, parts_of_blends_and_masks) {
  EXPECT_EQ(refusal(ball("<bsdf type='blendbsdf'><float name='weight' value='0.5'/><bsdf type='diffuse'/>"
                         "<bsdf type='dielectric'/></bsdf>")),
            "2:22:" + kNot + "a blend with something that transmits");
  EXPECT_EQ(refusal(ball("<bsdf type='mask'><bsdf type='dielectric'/></bsdf>")),
            "2:22:" + kNot + "a mask over a dielectric");
  EXPECT_EQ(refusal(ball("<bsdf type='mask'><bsdf type='diffuse'/></bsdf>")), "no refusal");
}

TEST(povray_refuses, textures_of_meshes_and_scaled_ones) {
  const auto painted = [](const std::string& texture) {
    return ball("<bsdf type='diffuse'><texture name='reflectance' " + texture + "</texture></bsdf>");
  };
  EXPECT_EQ(refusal(painted("type='mesh_attribute'><string name='name' value='face_a'/>")),
            "2:43:" + kNot + "an attribute of a mesh: not written yet");
  EXPECT_EQ(refusal(painted("type='scale'><texture type='checkerboard'/>")),
            "2:43:" + kNot + "a scaled texture: not written yet");
}

TEST(povray_refuses, projectors) {
  EXPECT_EQ(refusal("<emitter type='projector'/><shape type='sphere'/>"),
            "2:1:" + kNot + "a projector: not written yet; a spot with a texture can be");
}

TEST(povray_refuses, neither_sun_nor_sky) {
  EXPECT_EQ(refusal("<emitter type='sunsky'/><shape type='sphere'/>"), "no refusal");
  EXPECT_EQ(refusal("<emitter type='constant'/><shape type='sphere'/>"), "no refusal");
}

TEST(povray_refuses, media_that_scatter_or_stand_beside_lit_surfaces) {
  const auto medium = [](const std::string& albedo) {
    return "<shape type='sphere'><bsdf type='null'/><medium type='homogeneous' name='interior'><float name='albedo' "
           "value='" +
           albedo + "'/></medium></shape>";
  };
  EXPECT_EQ(refusal(medium("0.5") + kLight),
            "2:1:" + kNot +
                "a medium that scatters: POV-Ray scatters light once at most; one that only absorbs can be written");
  EXPECT_EQ(refusal(medium("0") + kLight), "no refusal");
  EXPECT_EQ(
      refusal(medium("0") + "\n<shape type='cube'/>" + kLight),
      "2:1:" + kNot + "a medium that absorbs beside surfaces that are lit: POV-Ray's photons and radiosity ignore it");
}

TEST(povray_refuses, media_that_vary) {
  EXPECT_EQ(
      refusal("<shape type='cube'><bsdf type='null'/><medium type='heterogeneous' name='interior'/></shape>" + kLight),
      "2:1:" + kNot + "a medium that varies: the export writes homogeneous media alone");
}

TEST(povray_refuses, dielectrics_that_reflect_less_than_fresnel_says) {
  const auto body = [](const std::string& kind, const std::string& more) {
    return "<shape type='" + kind + "'><bsdf type='dielectric'><float name='specular_reflectance' value='0.5'/>" +
           more + "</bsdf></shape>" + kLight;
  };
  const std::string total =
      "2:1:" + kNot +
      "a dielectric with specular_reflectance other than 1 that is no ball: POV-Ray reflects totally all the same";
  EXPECT_EQ(refusal(body("sphere", "")), "no refusal") << "what enters it leaves it";
  EXPECT_EQ(refusal(body("sphere", "<float name='ext_ior' value='1.7'/>")), total) << "from outside";
  EXPECT_EQ(refusal(body("cube", "")), total);
}

TEST(povray_refuses, rectangles_of_dielectric) {
  EXPECT_EQ(refusal("<shape type='rectangle'><bsdf type='dielectric'/></shape>" + kLight),
            "2:1:" + kNot + "an open surface of dielectric: POV-Ray's index of refraction belongs to a closed body");
}

TEST(povray_refuses, area_lights_on_mirrors) {
  EXPECT_EQ(refusal("<shape type='sphere'><bsdf type='conductor'><string name='material' value='none'/></bsdf>"
                    "<emitter type='area'/></shape>"),
            "2:1:" + kNot + "an area light on a specular surface; its bsdf must be diffuse");
}

TEST(povray_refuses, hidden_emitters_with_glass) {
  const std::string hide = "<integrator type='path'><boolean name='hide_emitters' value='true'/></integrator>";
  const std::string light =
      "<shape type='rectangle'><transform name='to_world'><translate z='3'/></transform>"
      "<emitter type='area'/></shape>";
  EXPECT_EQ(refusal(hide + light + kGlass),
            "2:1:" + kNot +
                "hide_emitters with glass or a light around the scene: POV-Ray cannot hide a light from the camera and "
                "show it in glass");
  EXPECT_EQ(refusal(hide + light), "no refusal");
}

TEST(povray_refuses, what_lies_inside_glass) {
  const std::string reason = " inside or across the dielectric of " + kScene +
                             ":2:1: POV-Ray does not scale radiance by the squared index of "
                             "refraction";
  const std::string small = "<shape type='sphere'><float name='radius' value='0.5'/></shape>";
  const auto cube_of = [](const std::string& size) {
    return "<shape type='cube'><transform name='to_world'><scale value='" + size + "'/></transform></shape>";
  };
  EXPECT_EQ(refusal(kGlass + cube_of("1") + kLight), "no refusal") << "around the ball, touching it";
  EXPECT_EQ(refusal(kGlass + small + kLight), "3:1:" + kNot + "a surface" + reason);
  EXPECT_EQ(refusal(kGlass + "<shape type='rectangle'/>" + kLight), "3:1:" + kNot + "a surface" + reason);
  EXPECT_EQ(refusal(kGlass + cube_of("0.5") + kLight), "3:1:" + kNot + "a surface" + reason);
  EXPECT_EQ(refusal(kGlass + "<emitter type='point'/>"), "3:1:" + kNot + "a light" + reason);
  EXPECT_EQ(refusal("\n" + kGlass + kLight,
                    "<sensor type='perspective'><film type='hdrfilm'><rfilter type='box'/></film></sensor>"),
            "1:24:" + kNot + "a camera" + reason);
}

TEST(povray_refuses, meshes_inside_glass_but_not_beside_it) {
  const auto mesh = [](const std::string& place) {
    return "<shape type='ply'><string name='filename' value='ascii_quad.ply'/><boolean name='face_normals' "
           "value='true'/>"
           "<transform name='to_world'>" +
           place + "</transform></shape>" + kLight;
  };
  const std::string inside = "3:1:" + kNot + "a surface inside or across the dielectric of " + kScene +
                             ":2:1: POV-Ray does not scale radiance by the squared index of refraction";
  EXPECT_EQ(refusal(kGlass + mesh("<scale value='0.1'/>")), inside);
  EXPECT_EQ(refusal(kGlass + mesh("<translate x='0.9'/>")), inside);
  // The quad's corner (0,0,0) comes to (1,1,0), sqrt(2) from the centre of the ball of radius 1.
  EXPECT_EQ(refusal(kGlass + mesh("<translate x='1' y='1'/>")), "no refusal");
  const std::string box = "<shape type='cube'><bsdf type='dielectric'/></shape>\n";
  EXPECT_EQ(refusal(box + mesh("<translate x='0.9' y='0.9'/>")), inside);
  EXPECT_EQ(refusal(box + mesh("<translate x='1.1'/>")), "no refusal");
}

TEST(povray_refuses, open_meshes_that_refract_or_absorb) {
  const std::string quad = "<shape type='ply'><string name='filename' value='ascii_quad.ply'/>";
  EXPECT_EQ(refusal(quad + "<bsdf type='dielectric'/></shape>" + kLight),
            "2:1:" + kNot +
                "a triangle mesh of dielectric that is open, or whose front is inside: POV-Ray's index of refraction "
                "belongs to a closed body");
  EXPECT_EQ(refusal(quad +
                    "<bsdf type='null'/><medium type='homogeneous' name='interior'><float name='albedo' "
                    "value='0'/></medium></shape>" +
                    kLight),
            "2:1:" + kNot + "a medium in another shape than a sphere, a cube or a closed mesh, their front outside");
}

TEST(povray_refuses, path_lengths_that_it_cannot_cut_at) {
  const auto depth = [](int n) {
    return "<integrator type='path'><integer name='max_depth' value='" + std::to_string(n) + "'/></integrator>";
  };
  const std::string around =
      "<shape type='sphere'><float name='radius' value='50'/><boolean name='flip_normals' value='true'/>"
      "<emitter type='area'/></shape>";
  EXPECT_EQ(refusal(depth(5) + around + kLight),
            "2:1:" + kNot +
                "max_depth in a scene lit both by a light around it and by others: POV-Ray counts their bounces "
                "differently");
  EXPECT_EQ(refusal(depth(-1) + around + kLight), "no refusal");
  EXPECT_EQ(
      refusal(depth(3) + kGlass + kLight),
      "2:1:" + kNot + "max_depth 3 with mirrors or glass: POV-Ray does not count specular bounces as part of a path");
  EXPECT_EQ(refusal(depth(4) + kGlass + kLight), "no refusal");
}

std::string camera_with(const std::string& parameters, const std::string& turn = "") {
  return "<sensor type='perspective'>" + parameters + "<transform name='to_world'>" + turn +
         "<lookat origin='0 0 9' target='0 0 0' up='0 1 0'/></transform><film type='hdrfilm'><rfilter type='box'/>"
         "</film></sensor>\n";
}

TEST(povray_refuses, what_clip_planes_would_cut_out) {
  EXPECT_EQ(
      refusal("<shape type='sphere'/>" + kLight, camera_with("<float name='far_clip' value='8.5'/>")),
      "2:1:" + kNot + "part of this surface lies beyond the camera's far_clip of 8.5, and POV-Ray has no clip planes");
  const std::string near =
      "part of this surface lies before the camera's near_clip of 8.5. POV-Ray has no clip planes, and leaving it out "
      "would change the light";
  EXPECT_EQ(refusal("<shape type='sphere'/>" + kLight, camera_with("<float name='near_clip' value='8.5'/>")),
            "2:1:" + kNot + near);
  // The quad reaches from z = 0 to 0.5; the camera at z = 9 is 8.5 away from its nearest corner.
  const std::string mesh =
      "<shape type='ply'><string name='filename' value='ascii_quad.ply'/><boolean name='face_normals' value='true'/>"
      "</shape>" +
      kLight;
  EXPECT_EQ(refusal(mesh, camera_with("<float name='near_clip' value='8.4'/>")), "no refusal");
  EXPECT_EQ(refusal(mesh, camera_with("<float name='near_clip' value='8.6'/>")),
            "2:1:" + kNot +
                "part of this surface lies before the camera's near_clip of 8.6. POV-Ray has no clip planes, and "
                "leaving it out would change the light");
  EXPECT_EQ(
      refusal(mesh, camera_with("<float name='far_clip' value='8.9'/>")),
      "2:1:" + kNot + "part of this surface lies beyond the camera's far_clip of 8.9, and POV-Ray has no clip planes");
}

TEST(povray_refuses, skewed_cameras) {
  SceneDescription scene = parse_scene_text("<scene version='3.0.0'>" + kCamera + kLight + "</scene>", kScene, {});
  scene.sensor.to_world.m[1] = 0.1;
  try {
    export_povray(scene, {});
    FAIL();
  } catch (const NotRepresentable& error) {
    EXPECT_EQ(error.summary(), kScene + ":1:24:" + kNot + "a camera whose axes are not perpendicular");
  }
}

TEST(povray_refuses, unknown_quality) {
  EXPECT_EQ(refusal(kLight, kCamera, {.quality = 5}), "--quality: error: 5 is not a preset, expected 1, 2, 3 or 4");
}

}  // namespace
}  // namespace photonproof::inline reference_povray
