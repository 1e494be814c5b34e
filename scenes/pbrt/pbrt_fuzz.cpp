// Fuzzes the reader of pbrt scenes. Built with libFuzzer (preset fuzz), and run over pbrt_corpus/ by
// pbrt_fuzz_test.cpp. Beside the input lie a text to include, a mesh and an image.
#include "scenes/pbrt/pbrt_fuzz.h"

#include <algorithm>
#include <cmath>

#include "scenes/base/test_fuzz.h"
#include "scenes/images/image.h"
#include "scenes/pbrt/reader.h"
#include "scenes/xml/writer.h"

namespace photonproof::inline scenes_pbrt {
namespace {

class Workplace {
 public:
  Workplace() {
    folder_.put("part.pbrt", "Shape \"sphere\"\nInclude \"part.pbrt\"\n");
    folder_.put("a.ply",
                "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    Rendering image;
    image.mean = Image(2, 2);
    std::fill(image.mean.rgb.begin(), image.mean.rgb.end(), 0.5f);
    write_exr((folder_.path() / "a.exr").string(), image);
  }
  std::string scene() const { return (folder_.path() / "fuzz.pbrt").string(); }

 private:
  FuzzFolder folder_;
};

bool is_finite_place(const Transform& t) {
  return std::all_of(t.m.begin(), t.m.end(), [](double v) { return std::isfinite(v); });
}

}  // namespace

std::string check_pbrt(std::string_view bytes) {
  static const Workplace place;
  PbrtSources sources;
  PbrtLog log(sources);
  try {
    const SceneDescription scene = read_pbrt(sources, log, std::string(bytes), place.scene(), {}, {});
    for (const ShapeDescription& shape : scene.shapes)
      if (!is_finite_place(shape.to_world)) return "a shape's place is not finite";
    if (write_scene(scene).empty()) return "a scene without text";
  } catch (const InputError& error) {
    if (const std::string problem = problem_with_message(error); !problem.empty()) return problem;
  }
  for (const InputError& error : log.obstacles().errors())
    if (const std::string problem = problem_with_message(error); !problem.empty()) return problem;
  return "";
}

}  // namespace photonproof::inline scenes_pbrt

#ifdef PHOTONPROOF_FUZZER
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return photonproof::fuzz_input(photonproof::check_pbrt, data, size);
}
#endif
