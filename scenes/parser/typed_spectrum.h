// <spectrum type="...">: Mitsuba 3's plugins uniform, d65, srgb, regular, irregular and blackbody.
#pragma once

#include "scenes/description/spectrum.h"
#include "scenes/xml/xml_source.h"

namespace photonproof::scene_xml {

class SceneObjects;

/// The element's linear RGB. `uniform` and `d65` are grey in every place, as in Mitsuba's rgb variants. `regular`,
/// `irregular` and `blackbody` become colours as wavelength:value pairs do; Mitsuba's rgb variants refuse them.
/// `blackbody` is Planck's radiance, W m^-2 sr^-1 nm^-1. A reflectance beyond `most` in a channel becomes `most` there.
/// Throws InputError.
RgbD typed_spectrum_of(SceneObjects& objects, const Element& element, SpectrumKind kind, double most);

}  // namespace photonproof::scene_xml
