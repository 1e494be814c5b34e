// pbrt's colours and spectra as linear Rec. 709.
#pragma once

#include <optional>

#include "scenes/description/bsdf_description.h"
#include "scenes/description/spectrum.h"
#include "scenes/pbrt/files.h"
#include "scenes/pbrt/parameters.h"

namespace photonproof::inline scenes_pbrt {

class PbrtSpectra {
 public:
  PbrtSpectra(const PbrtSources& sources, const PbrtFiles& files, PbrtLog& log)
      : sources_(sources), files_(files), log_(log) {}

  /// A reflectance, or coefficients of a medium: the parameter "rgb", "spectrum" or "float".
  std::optional<RgbD> colour(const PbrtParameters& parameters, std::string_view name) const;
  /// The colour of a light. pbrt multiplies an rgb by the white of its colour space, and scales every spectrum to a
  /// luminance of 1. So an rgb is itself, and any other spectrum has the luminance 1.
  RgbD light(const PbrtParameters& parameters, std::string_view name) const;
  /// The index of refraction of a dielectric: a number, or a glass by name at 588 nm.
  double index(const PbrtParameters& parameters, std::string_view name, double fallback) const;
  /// eta or k of a metal.
  std::optional<RgbD> metal(const PbrtParameters& parameters, std::string_view name, bool is_k) const;

 private:
  RgbD rgb(const PbrtParameters& parameters, const PbrtParameter& value) const;
  std::vector<SpectrumSample> samples(const PbrtParameters& parameters, const PbrtParameter& value) const;

  const PbrtSources& sources_;
  const PbrtFiles& files_;
  PbrtLog& log_;
};

}  // namespace photonproof::inline scenes_pbrt
