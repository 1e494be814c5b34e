// Values that volumes give: albedos of homogeneous media, weights of blended phase functions, textures.
#include <gtest/gtest.h>

#include "scenes/files/atomic_file.h"
#include "scenes/files/scratch_folder.h"
#include "scenes/parser/parser.h"

namespace photonproof::inline scenes_xml {
namespace {

/// A folder with grids of a cell: 0.25 in one channel, 0.25 in three, and 1.5 in one.
class VolumeValues : public ::testing::Test {
 protected:
  VolumeValues() {
    write("quarter.vol", 1, 0.25f);
    write("colour.vol", 3, 0.25f);
    write("bright.vol", 1, 1.5f);
  }

  SceneDescription parse(const std::string& content) const {
    return parse_scene_text(
        "<scene version='3.0.0'><sensor type='perspective'/><emitter type='point'/>" + content + "</scene>",
        (scratch_.path() / "scene.xml").string());
  }
  template <class Model>
  Model medium(const std::string& content) const {
    return std::get<Model>(parse("<medium type='homogeneous' id='m'>" + content + "</medium>").media.at(0).model);
  }
  /// The weight of a blend.
  VolumeNumber weight(const std::string& content) const {
    const auto fog = medium<HomogeneousDescription>("<phase type='blendphase'>" + content +
                                                    "<phase type='hg'/><phase type='isotropic'/></phase>");
    return std::get<BlendPhaseDescription>(fog.phase).weight;
  }
  VolumeColour texture(const std::string& content) const {
    const auto scene =
        parse("<bsdf type='diffuse' id='b'><texture type='volume' name='reflectance'>" + content + "</texture></bsdf>");
    return std::get<VolumeTextureDescription>(scene.textures.at(0).pattern).volume;
  }
  template <class Read>
  static std::string refusal(Read&& read) {
    try {
      read();
      return "";
    } catch (const InputError& error) {
      const std::string message = error.what();
      const std::size_t at = message.find("error: ") + 7;
      return message.substr(at, message.find('\n') - at);
    }
  }

 private:
  void write(const std::string& name, int channels, float value) const {
    std::string bytes("VOL\x03\x01\0\0\0\x01\0\0\0\x01\0\0\0\x01\0\0\0", 20);
    bytes += std::string{static_cast<char>(channels), 0, 0, 0};
    for (const float word : {0.f, 0.f, 0.f, 1.f, 1.f, 1.f})
      bytes.append(reinterpret_cast<const char*>(&word), sizeof word);
    for (int c = 0; c < channels; ++c) bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
    write_file_atomically(scratch_.path() / name, bytes);
  }
  const ScratchFolder scratch_{"volume-values-test"};
};

std::string grid(const std::string& name, const std::string& file) {
  return "<volume type='gridvolume' name='" + name + "'><string name='filename' value='" + file + "'/></volume>";
}

TEST_F(VolumeValues, give_the_albedo_of_a_homogeneous_medium) {
  const auto fog = medium<HomogeneousDescription>(grid("albedo", "colour.vol"));
  EXPECT_EQ(std::get<GridVolumeDescription>(fog.albedo).grid->channels, 3);
  EXPECT_FALSE(
      parse("<medium type='homogeneous' id='m'>" + grid("albedo", "colour.vol") + "</medium>").media[0].varies());
  EXPECT_EQ(refusal([&] { medium<HomogeneousDescription>(grid("albedo", "bright.vol")); }),
            "parameter 'albedo' of medium 'homogeneous' has values up to 1.5, expected from 0 to 1");
  EXPECT_EQ(refusal([&] { medium<HomogeneousDescription>(grid("sigma_t", "quarter.vol")); }),
            "parameter 'sigma_t' of medium 'homogeneous' is <volume>, expected <rgb>, <spectrum> or <float>");
}

TEST_F(VolumeValues, give_the_weight_of_a_blended_phase_function) {
  EXPECT_EQ(weight("<float name='weight' value='0.3'/>"), VolumeNumber(0.3));
  EXPECT_EQ(std::get<GridVolumeDescription>(weight(grid("weight", "quarter.vol"))).filename, "quarter.vol");
  EXPECT_EQ(weight("<volume type='constvolume' name='weight'><float name='value' value='0.2'/></volume>"),
            VolumeNumber(0.2));
  // 0.212671 x 0.5, Rec. 709; the same of a volume that is placed.
  EXPECT_EQ(weight("<volume type='constvolume' name='weight'><rgb name='value' value='0.5,0,0'/></volume>"),
            VolumeNumber(0.5 * 0.212671));
  EXPECT_EQ(weight("<volume type='constvolume' name='weight'><rgb name='value' value='0.5,0,0'/>"
                   "<transform name='to_world'><scale value='2'/></transform></volume>"),
            VolumeNumber(0.5 * 0.212671));
  EXPECT_EQ(refusal([&] { weight(grid("weight", "colour.vol")); }),
            "parameter 'weight' of phase 'blendphase' has values of three channels, expected one");
  EXPECT_EQ(refusal([&] { weight(grid("weight", "bright.vol")); }),
            "parameter 'weight' of phase 'blendphase' has values up to 1.5, expected from 0 to 1");
}

TEST_F(VolumeValues, are_textures) {
  EXPECT_EQ(std::get<GridVolumeDescription>(texture(grid("volume", "colour.vol"))).grid->channels, 3);
  EXPECT_EQ(texture("<volume type='constvolume' name='volume'><rgb name='value' value='0.1,0.2,0.3'/></volume>"),
            VolumeColour(RgbD(0.1, 0.2, 0.3)));
  EXPECT_EQ(refusal([&] { texture(""); }), "parameter 'volume' of texture 'volume' is missing, expected a volume");
  EXPECT_EQ(refusal([&] { texture(grid("volume", "bright.vol")); }),
            "parameter 'reflectance' of bsdf 'diffuse' has texels up to 1.5, expected from 0 to 1");
}

}  // namespace
}  // namespace photonproof::inline scenes_xml
