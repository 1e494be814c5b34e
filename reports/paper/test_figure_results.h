// A record with images for figures.
#pragma once

#include "reports/view/test_sample_results.h"
#include "scenes/images/image.h"

namespace photonproof::inline reports_paper {

inline Image even_image(int width, int height, float r, float g, float b) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      image.pixel(x, y)[0] = r;
      image.pixel(x, y)[1] = g;
      image.pixel(x, y)[2] = b;
    }
  return image;
}

/// The sample's scene box by photon, povray and its reference, each of 8 x 8 equal pixels, as EXRs in `folder`.
inline Results figure_results(const std::filesystem::path& folder) {
  Results results = reports::sample_results();
  for (Result& result : results.results) result.image = result.cell.scene == "box" ? result.cell.engine + ".exr" : "";
  write_exr((folder / "path.exr").string(), {even_image(8, 8, 1, 1, 1), {}, {}});
  write_exr((folder / "photon.exr").string(), {even_image(8, 8, 0.5f, 0.5f, 0.5f), {}, {}});
  write_exr((folder / "povray.exr").string(), {even_image(8, 8, 1, 0, 0), {}, {}});
  return results;
}

}  // namespace photonproof::inline reports_paper
