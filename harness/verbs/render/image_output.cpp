#include "harness/verbs/render/image_output.h"

#include <filesystem>

#include "scenes/base/input_error.h"
#include "scenes/images/netpbm_file.h"

namespace photonproof::inline harness_verbs_render {

ImageFormat output_format(const std::string& name) {
  const std::string ending = std::filesystem::path(name).extension().string();
  if (ending == ".exr") return ImageFormat::exr;
  if (ending == ".pfm") return ImageFormat::pfm;
  if (ending == ".png") return ImageFormat::png;
  throw InputError("--output", "'" + name + "' does not name a format, expected NAME.exr, NAME.pfm or NAME.png");
}

void write_image(const std::string& path, const Rendering& image, double exposure) {
  switch (output_format(path)) {
    case ImageFormat::exr:
      return write_exr(path, image);
    case ImageFormat::pfm:
      return write_pfm(path, image.mean);
    case ImageFormat::png:
      return write_png(path, image.mean, exposure);
  }
}

}  // namespace photonproof::inline harness_verbs_render
