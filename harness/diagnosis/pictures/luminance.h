// The brightness of a pixel as one number, for diagnosis.
#pragma once

namespace photonproof::inline harness_diagnosis_pictures {

/// Relative luminance of three linear values with the primaries of sRGB (Rec. ITU-R BT.709).
inline float luminance_of_pixel(const float* rgb) { return 0.2126f * rgb[0] + 0.7152f * rgb[1] + 0.0722f * rgb[2]; }

}  // namespace photonproof::inline harness_diagnosis_pictures
