// Every reason why a scene is not written for Mitsuba, each with the whole message.
#include <gtest/gtest.h>

#include "reference/engines/test_refusals.h"
#include "reference/mitsuba/mitsuba_export.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline reference_mitsuba {
namespace {

const std::string kLight = "<emitter type='constant'/>\n";
const std::string kNot = " error: not representable in Mitsuba: ";

/// The refusal message for a scene with a camera in line 1 and `content` from line 2 on.
std::string refusal(const std::string& content, const std::string& camera = kCamera) {
  return refusal_by([](const SceneDescription& scene) { export_mitsuba(scene, {}); }, content, camera);
}

std::string ball(const std::string& bsdf) { return "<shape type='sphere'>" + bsdf + "</shape>" + kLight; }

std::string camera_with(const std::string& filter) {
  return "<sensor type='perspective'><film type='hdrfilm'>" + filter + "</film></sensor>\n";
}

TEST(mitsuba_refuses, what_only_this_program_has) {
  EXPECT_EQ(refusal(ball("<bsdf type='layered'><bsdf type='diffuse'/></bsdf>")),
            "2:22:" + kNot + "a lacquer over another BSDF: Mitsuba 3 has none; its model is this program's own");
  EXPECT_EQ(refusal(ball("<bsdf type='difftrans'/>")), "2:22:" + kNot + "a diffuse transmitter: Mitsuba 3 has none");
  EXPECT_EQ(refusal(ball("<bsdf type='dielectric'><integer name='priority' value='1'/></bsdf>")),
            "2:22:" + kNot + "a priority of bodies that overlap: Mitsuba has none");
}

TEST(mitsuba_refuses, filters_that_it_lacks) {
  EXPECT_EQ(refusal(kLight, camera_with("<rfilter type='tent'><float name='radius' value='0.5'/></rfilter>")),
            "1:24:" + kNot + "a tent of a radius of half a pixel or less: Mitsuba filters by a box");
  EXPECT_EQ(refusal(kLight, camera_with("<rfilter type='tent'/>")), "no refusal");
  EXPECT_EQ(refusal(kLight, camera_with("<rfilter type='sinc'/>")),
            "1:24:" + kNot + "a sinc filter: Mitsuba has none; a lanczos works");
  EXPECT_EQ(refusal(kLight, camera_with("<rfilter type='mitchell'><float name='radius' value='3'/></rfilter>")),
            "1:24:" + kNot + "a mitchell filter of another radius than 2: Mitsuba's has none");
}

TEST(mitsuba_refuses, caustics_of_lights_without_size) {
  const std::string lamp = "<emitter type='point'/>", wall = "<shape type='rectangle'/>";
  const std::string glass = "<shape type='sphere'><bsdf type='dielectric'/></shape>";
  EXPECT_EQ(refusal(lamp + glass + wall),
            "2:1:" + kNot +
                "a light without size beside mirrors or glass: its caustics can be sampled from the light only, and "
                "Mitsuba's paths start at the camera");
  EXPECT_EQ(refusal(lamp + glass), "no refusal");
  EXPECT_EQ(refusal(lamp + wall), "no refusal");
}

TEST(mitsuba_refuses, lights_that_it_samples_wrongly) {
  EXPECT_EQ(refusal("<shape type='rectangle'><emitter type='directionalarea'/></shape>"),
            "2:1:" + kNot + "a light that shines along its normal: Mitsuba's path tracers do not sample it");
  EXPECT_EQ(refusal("<shape type='heightfield'><emitter type='area'><texture name='radiance' type='checkerboard'/>"
                    "</emitter></shape>"),
            "2:1:" + kNot +
                "a mesh with a texture as radiance: Mitsuba samples one of the faces that share a place in the "
                "texture");
}

TEST(mitsuba_refuses, a_principal_point_of_a_thin_lens) {
  const std::string camera =
      "<sensor type='thinlens'><float name='aperture_radius' value='1'/><float "
      "name='principal_point_offset_x' value='0.1'/></sensor>\n";
  EXPECT_EQ(refusal(kLight, camera),
            "1:24:" + kNot + "a principal point beside the middle of a thin lens: Mitsuba's has none");
}

TEST(mitsuba_refuses, what_is_not_written_yet) {
  const std::string camera =
      "<sensor type='radiancemeter'><film type='hdrfilm'><integer name='width' value='1'/><integer "
      "name='height' value='1'/></film></sensor>\n";
  EXPECT_EQ(refusal(kLight, camera), "1:24:" + kNot + "a meter or a batch of cameras: not written yet");
  EXPECT_EQ(refusal(ball("<bsdf type='diffuse'><texture name='reflectance' type='checkerboard'><texture name='color0' "
                         "type='checkerboard'/></texture></bsdf>")),
            "2:43:" + kNot + "a checkerboard whose colours are textures: not written yet");
}

}  // namespace
}  // namespace photonproof::inline reference_mitsuba
