// The crops of a figure for a paper: images of one scene, each with the numbers of its engine.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reports/paper/canvas.h"
#include "reports/paper/paper_options.h"
#include "reports/view/view.h"
#include "scenes/images/image.h"

namespace photonproof::inline reports_paper {

/// A column of the figure.
struct FigureColumn {
  std::string title;
  std::string budget;                 ///< "64 spp, 1.25 s wall". The reference has its engine and budget.
  std::string relmse;                 ///< "relMSE 0.0123" of the whole image. The reference has none.
  Image image;                        ///< Linear.
  std::vector<double> crop_relmse{};  ///< One number for each crop. The reference has none.
};

/// The finished images of a scene at each engine's largest budget; the reference is the last column. Throws InputError
/// if an image is missing, is not inside `folder`, or is not the one that was measured. It does so too if an image has
/// another size than the reference, and if a crop is not inside it.
std::vector<FigureColumn> figure_columns(const reports::View& view, const reports::SceneView& scene,
                                         const std::filesystem::path& folder, const std::vector<Inset>& insets);

/// The mean over the pixels and channels of a crop of (image - reference)^2 / (reference^2 + 0.01), as the metric
/// relmse.
double crop_relmse(const Image& image, const Image& reference, const Inset& inset);

/// The crop at an exposure in stops, as 8-bit sRGB.
Pixels crop_pixels(const Image& image, const Inset& inset, double exposure);

/// The squared relative error of each pixel of the crop: the terms of crop_relmse, mean of its channels. Colours are
/// magma's from 1e-4 (dark) to 1 (bright), logarithmic.
Pixels error_pixels(const Image& image, const Image& reference, const Inset& inset);

}  // namespace photonproof::inline reports_paper
