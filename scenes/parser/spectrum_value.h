// <spectrum>: one number, "wavelength:value" pairs, or a file of them.
#pragma once

#include "scenes/description/spectrum.h"
#include "scenes/xml/xml_source.h"

namespace photonproof::scene_xml {

class SceneObjects;

/// The element's linear RGB. A single number is the same at all wavelengths: grey as a reflectance, the white of equal
/// energy as an emission. A reflectance of pairs that exceeds `most` in a channel, outside the gamut, becomes `most`
/// there, as in Mitsuba. So the caller still sees a single number out of range.
RgbD spectrum_of(SceneObjects& objects, const Element& element, SpectrumKind kind, double most);

/// The linear RGB of a spectrum of pairs. Throws at `element` where they do not ascend, or one is negative.
RgbD rgb_of_samples(const Sources& sources, const Element& element, const std::vector<SpectrumSample>& samples,
                    SpectrumKind kind, double most);

}  // namespace photonproof::scene_xml
