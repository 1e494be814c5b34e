#include "harness/gates/gate_mutants.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "harness/pixels/display.h"

namespace photonproof::inline harness_gates {
namespace {

template <class Change>
Image each_value(Image image, const Change& change) {
  for (float& value : image.rgb) value = change(value);
  return image;
}

Image more_energy(const Image& image) {
  return each_value(image, [](float value) { return 1.02f * value; });
}

/// The image moved right by one pixel; the left column is doubled.
Image shifted(const Image& image) {
  Image out = image;
  for (int y = 0; y < image.height; ++y)
    for (int x = 1; x < image.width; ++x) std::copy_n(image.pixel(x - 1, y), 3, out.pixel(x, y));
  return out;
}

/// A black hole of a twelfth of the sides, off the centre and off the grid of blocks.
Image with_hole(const Image& image) {
  Image out = image;
  const int side = std::max(1, std::min(image.width, image.height) / 12);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x)
      std::fill_n(out.pixel(std::min(image.width / 3 + x, image.width - 1),
                            std::min(2 * image.height / 3 + y, image.height - 1)),
                  3, 0.0f);
  return out;
}

Image with_nan(const Image& image) {
  Image out = image;
  out.pixel(image.width / 2, image.height / 2)[1] = std::numeric_limits<float>::quiet_NaN();
  return out;
}

/// Mean over 3 x 3 pixels.
Image blurred(const Image& image) {
  Image out = image;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < 3; ++c) {
        float sum = 0;
        for (int dy = -1; dy <= 1; ++dy)
          for (int dx = -1; dx <= 1; ++dx)
            sum += image.pixel(std::clamp(x + dx, 0, image.width - 1), std::clamp(y + dy, 0, image.height - 1))[c];
        out.pixel(x, y)[c] = sum / 9;
      }
  return out;
}

/// Encodes by the sRGB curve and decodes by a power of 2.2, a common mistake: right at 1, some per cent off below.
Image wrong_gamma(const Image& image) {
  return each_value(image, [](float value) {
    if (value <= 0 || value >= 1) return value;
    return static_cast<float>(std::pow(encode_srgb(double{value}), 2.2));
  });
}

Image swapped_channels(const Image& image) {
  Image out = image;
  for (std::size_t i = 0; i < out.rgb.size(); i += 3) std::swap(out.rgb[i], out.rgb[i + 2]);
  return out;
}

const std::vector<std::string> with_kernels{"direct", "path", "photonmapper"};

std::vector<GateVariant> all_variants() {
  std::vector<GateVariant> variants;
  const auto renderer = [&](std::vector<std::string> integrators, const char* name, const char* what) {
    variants.push_back(
        {.name = name, .what = what, .planted = PlantedIn::renderer, .integrators = std::move(integrators)});
  };
  renderer(with_kernels, "dropped-cosine", "direct light is not multiplied by the cosine at the surface");
  renderer(with_kernels, "missing-caustic", "light that comes by mirrors or glass is lost after a diffuse surface");
  renderer({"photonmapper"}, "half-photons", "half the photons that were asked for are traced");
  renderer(with_kernels, "uniform-diffuse",
           "a diffuse surface scatters evenly over the hemisphere, with a cosine's density and weight");
  renderer(with_kernels, "part-of-lamp",
           "points are drawn on nine tenths of a rectangular light, with the density of all of it");
  renderer(with_kernels, "unweighted-hits", "hits on lights count in full, without the weight against light sampling");
  renderer(with_kernels, "unpaid-roulette", "paths that survive roulette do not carry the light of those that end");
  renderer({"photonmapper"}, "dim-caustic", "caustic photons carry 5 % too little");
  renderer({"photonmapper"}, "density-radius",
           "the density of photons uses the area of a radius 10 % larger than the gather's");
  renderer({"photonmapper"}, "same-photons", "photons ignore the seed");
  renderer(with_kernels, "same-samples", "samples of camera paths ignore the seed");
  renderer({}, "wide-filter", "samples spread 20 % wider than the reconstruction filter");
  renderer({}, "flipped-v", "bitmaps are read upside down");
  renderer({}, "raw-srgb", "bitmaps' values are taken for linear ones");
  renderer({"volpath"}, "thin-medium", "media take 10 % too little light");
  renderer({"volpath"}, "backward-phase", "the phase function's g has the wrong sign");
  renderer({}, "fov-axis", "the field of view is across the height, even where the scene has another axis");
  renderer({}, "spot-angle", "a spot's half-angles are taken for whole ones");
  renderer({}, "turned-sky", "an environment is turned the other way");
  renderer({}, "swapped-ior", "glass has the index of its outside, and the outside that of glass");
  renderer(with_kernels, "single-reflection", "a pane reflects with its front alone");
  renderer({}, "flat-normals", "normals of meshes are not interpolated");

  const auto harness = [&](PlantedIn where, const char* name, const char* what) {
    variants.push_back({.name = name, .what = what, .planted = where});
  };
  harness(PlantedIn::drawing, "repeated-seed", "all images of an engine are drawn with one seed");
  harness(PlantedIn::drawing, "upside-down", "engines' images are read upside down");
  harness(PlantedIn::drawing, "quarter-budget", "engines get a quarter of the budget");
  harness(PlantedIn::judging, "red-for-all", "engines' green and blue are replaced by red");
  harness(PlantedIn::judging, "certain-noise", "the noise of a block's mean is divided by the number of images twice");

  const auto edit = [&](Image (*change)(const Image&), const char* name, const char* what) {
    variants.push_back({.name = name, .what = what, .planted = PlantedIn::image, .change = change});
  };
  edit(more_energy, "2 % energy", "2 % too bright");
  edit(shifted, "one-pixel shift", "moved to the right");
  edit(with_hole, "hole", "a square of a twelfth of the sides is black");
  edit(with_nan, "NaN", "one value is not a number");
  edit(blurred, "blur", "means over 3 x 3 pixels");
  edit(wrong_gamma, "wrong gamma", "encoded as sRGB, decoded by a power of 2.2");
  edit(swapped_channels, "swapped channels", "red and blue exchanged");

  variants.push_back({.name = "other seeds", .what = "nothing"});
  variants.push_back({.name = "3 threads", .what = "nothing", .threads = 3});
  variants.push_back(
      {.name = "scalar kernels", .what = "nothing", .integrators = with_kernels, .further = {"--isa", "scalar"}});
  return variants;
}

}  // namespace

std::span<const GateVariant> gate_variants() {
  static const std::vector<GateVariant> variants = all_variants();
  return variants;
}

std::vector<std::string> kernels_with_faults(const std::string& integrator) {
  if (std::find(with_kernels.begin(), with_kernels.end(), integrator) == with_kernels.end()) return {};
#if defined(__x86_64__)
  return {"--isa", "v2"};
#else
  return {"--isa", "native"};
#endif
}

}  // namespace photonproof::inline harness_gates
