#include "scenes/generators/showcase_assets.h"

#include "scenes/generators/showcase_pictures.h"
#include "scenes/generators/showcase_shapes.h"
#include "scenes/meshes/ply.h"

namespace photonproof::inline scenes_generators {
namespace {

ShowcaseAsset body(const std::string& path, TriangleMesh (*make)(const Fineness&)) {
  return {path,
          [make](const std::filesystem::path& target, double detail) { write_ply(target, make(Fineness(detail))); }};
}

ShowcaseAsset picture(const std::string& path, Image (*make)()) {
  return {path, [make](const std::filesystem::path& target, double) {
            if (target.extension() == ".exr")
              write_exr(target.string(), {make(), std::nullopt, {}}, ExrColour::single);
            else
              write_png(target.string(), make());
          }};
}

}  // namespace

const std::vector<ShowcaseAsset>& showcase_assets() {
  static const std::vector<ShowcaseAsset> assets = {
      body("door-ajar/knob.ply", door_knob),
      body("door-ajar/table.ply", table),
      body("door-ajar/teapot.ply", teapot),
      picture("door-ajar/boards.png", boards_picture),
      picture("door-ajar/ranges.png", ranges_picture),
      body("foggy-stage/can.ply", lamp_can),
      body("foggy-stage/curtain.ply", curtain),
      body("foggy-stage/pedestal.ply", pedestal),
      {"foggy-stage/prism.ply", [](const std::filesystem::path& target, double) { write_ply(target, prism()); }},
      picture("foggy-stage/boards.png", boards_picture),
      picture("foggy-stage/cold.png", cold_gobo),
      picture("foggy-stage/warm.png", warm_gobo),
      body("gallery/figure.ply", figure),
      body("gallery/knot.ply", knot),
      picture("gallery/blocks.png", blocks_picture),
      picture("gallery/boards.png", boards_picture),
      picture("gallery/circles.png", circles_picture),
      picture("gallery/heights.png", boards_heights),
      picture("gallery/julia.png", julia_picture),
      picture("gallery/ranges.png", ranges_picture),
      picture("gallery/sunset.png", sunset_picture),
      picture("gallery/waves.png", waves_picture),
      body("glass-interior/bottle.ply", bottle),
      body("glass-interior/bowl.ply", bowl),
      body("glass-interior/candle.ply", candle),
      body("glass-interior/flame.ply", flame),
      body("glass-interior/hoops.ply", hoops),
      body("glass-interior/shade.ply", lamp_shade),
      body("glass-interior/table.ply", table),
      body("glass-interior/tumbler.ply", tumbler),
      body("glass-interior/vase.ply", vase),
      body("glass-interior/wine-glass.ply", wine_glass),
      picture("glass-interior/boards.png", boards_picture),
      picture("glass-interior/night.png", night_picture),
      body("murky-pool/ladder.ply", ladder),
      body("murky-pool/ripples.ply", ripples),
      picture("murky-pool/ball.png", ball_picture),
      picture("murky-pool/sky.exr", evening_sky),
      picture("murky-pool/tiles.png", tiles_picture),
      body("ring-caustic/ring.ply", ring),
  };
  return assets;
}

}  // namespace photonproof::inline scenes_generators
