// Renders half of a scene's samples with the photon mapper, and reads pixels and stats.
#include <atomic>
#include <cstdio>

#include "renderer/api/render_scene.h"
#include "scenes/base/input_error.h"
#include "scenes/parser/parser.h"

int main(int argc, char** argv) try {
  using namespace photonproof;
  if (argc != 3) return std::fprintf(stderr, "usage: render_api SCENE.xml IMAGE.exr\n"), 2;
  const SceneDescription scene = parse_scene_file(argv[1]);
  std::atomic<bool> stop = false;
  RenderRequest request{.integrator = "photonmapper", .budget = {.spp = 256}, .interrupt = &stop};
  request.progress = [&](double fraction, const std::string&) { stop = fraction > 0.5; };
  const Rendered rendered = render_scene(scene, request);
  const Image& image = rendered.image.mean;
  const float* middle = image.pixel(image.width / 2, image.height / 2);
  std::printf("%dx%d pixels, %.0f samples each%s\n", image.width, image.height,
              rendered.stats.counts.at("samples_per_pixel"), rendered.stats.interrupted ? ", stopped early" : "");
  std::printf("middle: %g %g %g\n", middle[0], middle[1], middle[2]);
  write_exr(argv[2], rendered.image);
} catch (const photonproof::InputError& error) {
  return std::fprintf(stderr, "%s\n", error.what()), 2;
}
