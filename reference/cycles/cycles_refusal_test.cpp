// Every reason why a scene is not written for Cycles, each with the whole message.
#include <gtest/gtest.h>

#include "reference/cycles/cycles_export.h"
#include "reference/engines/test_refusals.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline reference_cycles {
namespace {

const std::string kLight = "<emitter type='constant'/>\n";

/// The refusal message for a scene with a camera in line 1 and `content` from line 2 on.
std::string refusal(const std::string& content, const std::string& camera = kCamera) {
  return refusal_by([](const SceneDescription& scene) { export_cycles(scene, {}); }, content, camera);
}

const std::string kNot = " error: not representable in Cycles: ";

const std::string kCoat =
    "light enters its coat by the light's direction, and the colour of Cycles' diffuse reflection depends on the "
    "viewer's alone";

std::string ball(const std::string& bsdf) { return "<shape type='sphere'>" + bsdf + "</shape>" + kLight; }

TEST(cycles_refuses, roughness_that_differs_by_place_or_direction) {
  for (const auto& [type, what] : {std::pair<std::string, std::string>{"roughconductor", "a rough conductor"},
                                   {"roughdielectric", "a rough dielectric"}}) {
    const auto rough = [&, type = type](const std::string& alpha) {
      return ball("<bsdf type='" + type + "'>" + alpha + "</bsdf>");
    };
    EXPECT_EQ(refusal(rough("")), "no refusal");
    EXPECT_EQ(refusal(rough("<float name='alpha_u' value='0.1'/><float name='alpha_v' value='0.2'/>")),
              "2:22:" + kNot + what + " that is rougher along one tangent than along the other");
    EXPECT_EQ(refusal(rough("<texture name='alpha' type='checkerboard'/>")),
              "2:22:" + kNot + what + " whose alpha is a texture; a number can be written");
  }
  EXPECT_EQ(refusal(ball("<bsdf type='phong'><texture name='exponent' type='checkerboard'/></bsdf>")),
            "2:22:" + kNot + "phong whose exponent is a texture; a number can be written");
}

TEST(cycles_refuses, principled_bsdfs) {
  const std::string why = ": Cycles' principled shader has other lobes than Burley's of 2012 and 2015";
  EXPECT_EQ(refusal(ball("<bsdf type='principled'/>")), "2:22:" + kNot + "a principled BSDF" + why);
  EXPECT_EQ(refusal(ball("<bsdf type='principledthin'/>")), "2:22:" + kNot + "a thin principled BSDF" + why);
}

TEST(cycles_refuses, diffuse_transmitters) {
  EXPECT_EQ(refusal(ball("<bsdf type='difftrans'/>")), "2:22:" + kNot + "a diffuse transmitter: not written yet");
}

TEST(cycles_refuses, curves_and_signed_distances) {
  EXPECT_EQ(refusal("<shape type='linearcurve'><string name='filename' value='../curve_set_corpus/linear'/></shape>" +
                    kLight),
            "2:1:" + kNot + "curves: Cycles draws its own kinds of them, and sees their inside");
}

TEST(cycles_refuses, ellipsoids) {
  for (const std::string type : {"ellipsoids", "ellipsoidsmesh"})
    EXPECT_EQ(refusal("<shape type='" + type +
                      "'><string name='filename' value='../ellipsoid_cloud_corpus/plain'/></shape>" + kLight),
              "2:1:" + kNot + "ellipsoids of a file: Cycles would see their inside");
}

TEST(cycles_refuses, coats_and_maps) {
  EXPECT_EQ(refusal(ball("<bsdf type='roughplastic'/>")), "2:22:" + kNot + "a rough plastic: " + kCoat);
  EXPECT_EQ(refusal(ball("<bsdf type='layered'><bsdf type='diffuse'/></bsdf>")),
            "2:22:" + kNot + "a lacquer: " + kCoat);
  EXPECT_EQ(refusal(ball("<bsdf type='bumpmap'><texture type='checkerboard'/><bsdf type='diffuse'/></bsdf>")),
            "2:22:" + kNot + "a bump map: Cycles perturbs normals by another rule");
  EXPECT_EQ(refusal(ball("<bsdf type='normalmap'><texture name='normalmap' type='checkerboard'/><bsdf type='diffuse'/>"
                         "</bsdf>")),
            "2:22:" + kNot + "a normal map: Cycles bends mapped normals by a rule of its own where they look away");
}

TEST(cycles_refuses, dielectrics_with_a_priority) {
  EXPECT_EQ(refusal(ball("<bsdf type='dielectric'><integer name='priority' value='1'/></bsdf>")),
            "2:22:" + kNot + "a dielectric with a priority: Cycles has no nested bodies");
}

TEST(cycles_refuses, textures_of_meshes_and_scaled_ones) {
  const auto painted = [](const std::string& texture) {
    return ball("<bsdf type='diffuse'><texture name='reflectance' " + texture + "</texture></bsdf>");
  };
  EXPECT_EQ(refusal(painted("type='mesh_attribute'><string name='name' value='face_a'/>")),
            "2:43:" + kNot + "an attribute of a mesh: not written yet");
  EXPECT_EQ(refusal(painted("type='scale'><texture type='checkerboard'/>")),
            "2:43:" + kNot + "a scaled texture: not written yet");
}

TEST(cycles_refuses, lights_it_has_no_equal_of) {
  EXPECT_EQ(refusal("<emitter type='projector'/>"),
            "2:1:" + kNot + "a projector: not written yet; a spot with a texture can be");
  EXPECT_EQ(refusal("<emitter type='sunsky'/>"),
            "2:1:" + kNot +
                "a sun and its sky: Cycles' sky is of another model; an envmap and a directional light can be written");
}

TEST(cycles_refuses, lights_that_its_paths_cannot_find) {
  const std::string light = "<emitter type='point'/>",
                    mirror = "<shape type='sphere'><bsdf type='conductor'/></shape>\n";
  EXPECT_EQ(refusal("<shape type='cube'/>" + mirror + light),
            "3:1:" + kNot +
                "a light without size beside mirrors or glass: its caustics can be sampled from the light only, and "
                "Cycles' paths start at the camera");
  EXPECT_EQ(refusal("<shape type='cube'/>" + light), "no refusal");
  EXPECT_EQ(refusal(mirror + light), "no refusal") << "nothing that a light lights";
  EXPECT_EQ(refusal("<shape type='cube'><bsdf type='plastic'/></shape>\n" + light),
            "3:1:" + kNot +
                "a light without size beside rough metal with an index, rough glass, plastic or phong: Cycles has no "
                "such lobes and meets lights by chance only");
}

TEST(cycles_refuses, media_that_overlap) {
  const auto body = [](const std::string& x, const std::string& side = "interior") {
    return "<shape type='cube'><transform name='to_world'><translate x='" + x +
           "'/></transform><bsdf type='null'/><medium type='homogeneous' name='" + side + "'/></shape>\n";
  };
  EXPECT_EQ(refusal(body("0") + body("1") + kLight),
            "3:1:" + kNot + "a medium where another is: Cycles adds up media that overlap");
  EXPECT_EQ(refusal(body("0") + body("3") + kLight), "no refusal");
  EXPECT_EQ(refusal(body("0", "exterior") + kLight),
            "2:1:" + kNot + "a medium before a surface: Cycles' volumes are inside of bodies");
}

TEST(cycles_refuses, media_that_vary_and_other_phase_functions) {
  const auto body = [](const std::string& medium) {
    return "<shape type='cube'><bsdf type='null'/>\n" + medium + "</shape>\n";
  };
  EXPECT_EQ(refusal(body("<medium type='heterogeneous' name='interior'/>") + kLight),
            "3:1:" + kNot + "a medium that varies: the export writes homogeneous media alone");
  const std::string other = "a phase function other than isotropic and hg: the export writes those two alone";
  EXPECT_EQ(refusal(body("<medium type='homogeneous' name='interior'><phase type='rayleigh'/></medium>") + kLight),
            "3:1:" + kNot + other);
}

TEST(cycles_refuses, path_lengths_that_it_cannot_cut_at) {
  const auto depth = [](int n) {
    return "<integrator type='path'><integer name='max_depth' value='" + std::to_string(n) + "'/></integrator>";
  };
  const std::string pane = ball("<bsdf type='thindielectric'/>");
  EXPECT_EQ(refusal(depth(1) + kLight), "2:1:" + kNot + "max_depth 1: Cycles has no end of paths before direct light");
  EXPECT_EQ(refusal(depth(5) + pane),
            "2:1:" + kNot + "max_depth with a thin dielectric: Cycles does not count what passes it as part of a path");
  EXPECT_EQ(refusal(depth(-1) + pane), "no refusal");
}

TEST(cycles_refuses, cameras_and_films) {
  const auto camera = [](const std::string& filter) {
    return "<sensor type='perspective'><film type='hdrfilm'>" + filter + "</film></sensor>\n";
  };
  EXPECT_EQ(refusal(kLight, camera("<rfilter type='tent'/>")),
            "1:24:" + kNot + "a tent filter: Cycles has none; a box or a Gaussian can be written");
  EXPECT_EQ(refusal(kLight, camera("<rfilter type='gaussian'><float name='stddev' value='3'/></rfilter>")),
            "1:24:" + kNot + "a Gaussian filter of a deviation above 2.5 pixels: Cycles has none so wide");
  EXPECT_EQ(refusal(kLight, camera("<integer name='crop_width' value='4'/><integer name='crop_height' value='4'/>")),
            "no refusal");
  EXPECT_EQ(refusal(kLight,
                    "<sensor type='fisheye'><film type='hdrfilm'><integer name='width' value='9'/></film>"
                    "</sensor>\n"),
            "1:24:" + kNot + "a fisheye camera's picture that is not square, or has another filter than box");
}

TEST(cycles_refuses, textures_that_are_mirrored_beyond_their_edges) {
  const std::string wall =
      "<shape type='sphere'><bsdf type='diffuse'><texture name='reflectance' type='bitmap'><string name='filename' "
      "value='rgb8.png'/><string name='wrap_mode' value='mirror'/></texture></bsdf></shape>";
  const std::string folder = PHOTONPROOF_CORPORA "/png_corpus/";
  const SceneDescription scene =
      parse_scene_text("<scene version='3.0.0'>" + kCamera + wall + kLight + "</scene>", folder + "scene.xml", {});
  try {
    export_cycles(scene, {});
    FAIL();
  } catch (const NotRepresentable& error) {
    EXPECT_EQ(error.summary(),
              folder + "scene.xml:2:43:" + kNot +
                  "a texture that is mirrored beyond its edges; repeated and clamped ones can be written");
  }
}

}  // namespace
}  // namespace photonproof::inline reference_cycles
