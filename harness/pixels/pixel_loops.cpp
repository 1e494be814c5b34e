// See pixel_loops.h. This file is compiled for several instruction sets into one program. Everything except the table
// has internal linkage, and nothing of the standard library is called. So code for a newer processor is never linked
// into what an older one runs.

#include "harness/pixels/pixel_loops.h"

namespace photonproof::inline harness_pixels {
namespace {

#define restrict __restrict__

// --- elementary functions ------------------------------------------------------------------------------------------

inline double unit_clamp(double v) {
  const double low = v > 0 ? v : 0;
  return low < 1 ? low : 1;
}

/// Cube root of t in [0.001, 1] within 2e-14. The first guess has a third of the exponent (within 3.5 %). Halley's
/// iteration y (y^3 + 2t) / (2y^3 + t) cubes the error, once in float and once in double.
inline double cube_root(double t) {
  const auto ft = static_cast<float>(t);
  const auto third = static_cast<float>(__builtin_bit_cast(std::int32_t, ft)) * (1.0f / 3) + 709965728.0f;
  const float guess = __builtin_bit_cast(float, static_cast<std::int32_t>(third));
  const float guess3 = guess * guess * guess;
  const float close = guess * (guess3 + 2 * ft) / (2 * guess3 + ft);
  const auto y = static_cast<double>(close);
  const double y3 = y * y * y;
  return y * (y3 + 2 * t) / (2 * y3 + t);
}

/// v^(5/12) of v in [0.003, 1] within 1e-14, without roots and divisions. Starts z = v^(-1/12) from minus a twelfth of
/// the exponent (within 3.5 %). Three of Newton's iterations z (13 - v z^12) / 12 in float each square the error, times
/// 6.5. Then z (1 + r/12 + 13 r^2 / 288 + ...) in double, with r = 1 - v z^12, cubes it; v^(5/12) = v z^7.
inline double power_5_12(double v) {
  const auto fv = static_cast<float>(v);
  const auto twelfth = 1153700000.0f - static_cast<float>(__builtin_bit_cast(std::int32_t, fv)) * (1.0f / 12);
  float close = __builtin_bit_cast(float, static_cast<std::int32_t>(twelfth));
  for (int i = 0; i < 3; ++i) {
    const float z2 = close * close, z4 = z2 * z2;
    close = close * ((13.0f / 12) - (1.0f / 12) * fv * (z4 * z4 * z4));
  }
  const auto near = static_cast<double>(close);
  const double n2 = near * near, n4 = n2 * n2;
  const double r = 1 - v * (n4 * n4 * n4);
  const double z = near + near * (r * (1.0 / 12 + r * (13.0 / 288)));
  const double z2 = z * z, z3 = z2 * z;
  return v * (z3 * z3) * z;
}

/// log2 of a normal x > 0 within 1e-12.
inline double log2_of(double x) {
  const auto bits = __builtin_bit_cast(std::uint64_t, x);
  // The exponent as a double: its bits are placed below those of 2^52.
  const double exponent = __builtin_bit_cast(double, (bits >> 52) | 0x4330000000000000u) - (4503599627370496.0 + 1023);
  const double m = __builtin_bit_cast(double, (bits & 0xfffffffffffffu) | 0x3ff0000000000000u);  // [1, 2)
  // log m = log(sqrt 2) + 2 artanh s, |s| <= 0.1716; the series to s^13 leaves 2 s^15 / 15 = 4e-13.
  constexpr double root2 = 1.4142135623730951;
  const double s = (m - root2) / (m + root2), s2 = s * s;
  const double series =
      1 + s2 * (1.0 / 3 + s2 * (1.0 / 5 + s2 * (1.0 / 7 + s2 * (1.0 / 9 + s2 * (1.0 / 11 + s2 * (1.0 / 13))))));
  return exponent + 0.5 + 2.8853900817779268 * s * series;
}

/// 2^y for |y| < 1000 within 1e-13.
inline double exp2_of(double y) {
  constexpr double shift = 6755399441055744.0;  // 1.5 x 2^52: adding it leaves the nearest integer in the low bits
  const double shifted = y + shift;
  const double r = (y - (shifted - shift)) * 0.6931471805599453;  // |r| <= 0.347; r^11 / 11! = 2e-13 is left out
  const double p =
      1 +
      r * (1 +
           r * (1.0 / 2 +
                r * (1.0 / 6 +
                     r * (1.0 / 24 +
                          r * (1.0 / 120 +
                               r * (1.0 / 720 + r * (1.0 / 5040 + r * (1.0 / 40320 +
                                                                       r * (1.0 / 362880 + r * (1.0 / 3628800))))))))));
  return p * __builtin_bit_cast(double, (__builtin_bit_cast(std::uint64_t, shifted) << 52) + 0x3ff0000000000000u);
}

/// x^p for x >= 0; 0 of 0.
inline double power(double x, double p) {
  const double normal = x > 1e-300 ? x : 1e-300;
  const double value = exp2_of(p * log2_of(normal));
  return x > 0 ? value : 0;
}

// --- values ----------------------------------------------------------------------------------------------------------

void split_rgb(const float* restrict rgb, std::size_t n, float* restrict r, float* restrict g, float* restrict b) {
  for (std::size_t i = 0; i < n; ++i) {
    r[i] = rgb[3 * i];
    g[i] = rgb[3 * i + 1];
    b[i] = rgb[3 * i + 2];
  }
}

void expose(const float* restrict linear, std::size_t n, double scale, double* restrict out) {
  for (std::size_t i = 0; i < n; ++i) out[i] = unit_clamp(scale * static_cast<double>(linear[i]));
}

void tone_map(const float* restrict linear, std::size_t n, double scale, double* restrict out) {
  for (std::size_t i = 0; i < n; ++i) {
    const auto v = static_cast<double>(linear[i]);
    const double positive = v > 0 ? v : 0;
    const double x = scale * (positive < 65536 ? positive : 65536);
    out[i] = unit_clamp((0.36 * 2.51 * x * x + 0.6 * 0.03 * x) / (0.36 * 2.43 * x * x + 0.6 * 0.59 * x + 0.14));
  }
}

void encode(const double* restrict linear, std::size_t n, double* restrict out) {
  for (std::size_t i = 0; i < n; ++i) {
    const double v = linear[i];
    const double bright = v > 0.0031308 ? v : 0.0031308;
    const double curve = 1.055 * power_5_12(bright) - 0.055;  // the standard's exponent is 1 / 2.4
    const double line = 12.92 * v;
    out[i] = v > 0.0031308 ? curve : line;
  }
}

// --- filters ---------------------------------------------------------------------------------------------------------

// One row for one to three kernels: values are loaded and folded once for all of them. `ivdep`: the results never
// overlap the input.

template <int radius>
inline void row_even(const double* in, std::ptrdiff_t step, std::size_t width, const double* weight, double* out) {
#pragma GCC ivdep
  for (std::size_t x = 0; x < width; ++x) {
    const double* middle = in + x;
    double sum = weight[0] * *middle;
#pragma GCC unroll 10
    for (int k = 1; k <= radius; ++k) sum += weight[k] * (middle[k * step] + middle[-k * step]);
    out[x] = sum;
  }
}

template <int radius>
inline void row_twice(const double* in, std::ptrdiff_t step, std::size_t width, const double* weight_a,
                      const double* weight_b, double* out_a, double* out_b) {
#pragma GCC ivdep
  for (std::size_t x = 0; x < width; ++x) {
    const double* middle = in + x;
    double a = weight_a[0] * *middle, b = weight_b[0] * *middle;
#pragma GCC unroll 10
    for (int k = 1; k <= radius; ++k) {
      const double fold = middle[k * step] + middle[-k * step];
      a += weight_a[k] * fold;
      b += weight_b[k] * fold;
    }
    out_a[x] = a;
    out_b[x] = b;
  }
}

template <int radius>
inline void row_odd_even(const double* in, std::ptrdiff_t step, std::size_t width, const double* weight_odd,
                         const double* weight_even, double* out_odd, double* out_even) {
#pragma GCC ivdep
  for (std::size_t x = 0; x < width; ++x) {
    const double* middle = in + x;
    double odd = 0, even = weight_even[0] * *middle;
#pragma GCC unroll 10
    for (int k = 1; k <= radius; ++k) {
      const double before = middle[-k * step], after = middle[k * step];
      odd += weight_odd[k] * (after - before);
      even += weight_even[k] * (after + before);
    }
    out_odd[x] = odd;
    out_even[x] = even;
  }
}

template <int radius>
void filter_of(const FilterSpan& span, const FilterResult& even) {
  for (std::size_t y = 0; y < span.height; ++y)
    row_even<radius>(span.in + y * span.in_stride, span.step, span.width, even.taps.weight,
                     even.out + y * even.out_stride);
}

void filter(const FilterSpan& span, const FilterResult& even) {
  switch (even.taps.radius) {
    case 5:
      return filter_of<5>(span, even);
    case 7:
      return filter_of<7>(span, even);
    case 9:
      return filter_of<9>(span, even);
    case 10:
      return filter_of<10>(span, even);
    default:
      __builtin_trap();
  }
}

void filter_rows(const double* const* rows, const Taps& taps, std::size_t width, double* restrict out) {
  if (taps.radius != 5) __builtin_trap();
  const double *a5 = rows[0], *a4 = rows[1], *a3 = rows[2], *a2 = rows[3], *a1 = rows[4], *middle = rows[5],
               *b1 = rows[6], *b2 = rows[7], *b3 = rows[8], *b4 = rows[9], *b5 = rows[10];
  const double* weight = taps.weight;
#pragma GCC ivdep
  for (std::size_t x = 0; x < width; ++x)
    out[x] = weight[0] * middle[x] + weight[1] * (a1[x] + b1[x]) + weight[2] * (a2[x] + b2[x]) +
             weight[3] * (a3[x] + b3[x]) + weight[4] * (a4[x] + b4[x]) + weight[5] * (a5[x] + b5[x]);
}

void filter_twice(const FilterSpan& span, const FilterResult& a, const FilterResult& b) {
  if (a.taps.radius != 10 || b.taps.radius != 10) __builtin_trap();
  for (std::size_t y = 0; y < span.height; ++y)
    row_twice<10>(span.in + y * span.in_stride, span.step, span.width, a.taps.weight, b.taps.weight,
                  a.out + y * a.out_stride, b.out + y * b.out_stride);
}

void filter_odd_even(const FilterSpan& span, const FilterResult& odd, const FilterResult& even) {
  if (odd.taps.radius != 9 || even.taps.radius != 9) __builtin_trap();
  for (std::size_t y = 0; y < span.height; ++y)
    row_odd_even<9>(span.in + y * span.in_stride, span.step, span.width, odd.taps.weight, even.taps.weight,
                    odd.out + y * odd.out_stride, even.out + y * even.out_stride);
}

// --- ssim ------------------------------------------------------------------------------------------------------------

void sum_and_difference(const double* restrict r, const double* restrict x, std::size_t n, double* restrict s,
                        double* restrict d, double* restrict ss, double* restrict dd) {
  for (std::size_t i = 0; i < n; ++i) {
    const double sum = r[i] + x[i], difference = r[i] - x[i];
    s[i] = sum;
    d[i] = difference;
    ss[i] = sum * sum;
    dd[i] = difference * difference;
  }
}

void similarity(const double* restrict s, const double* restrict d, const double* restrict ss,
                const double* restrict dd, std::size_t n, double* restrict ssim, double* restrict structure) {
  constexpr double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;
  for (std::size_t i = 0; i < n; ++i) {
    const double s2 = s[i] * s[i], d2 = d[i] * d[i];
    const double var_s = ss[i] - s2, var_d = dd[i] - d2;
    // var_r + var_x = (var_s + var_d)/2 and 2 cov = (var_s - var_d)/2; the same of the squared means. One division
    // for both ratios.
    const double cs_above = 0.5 * (var_s - var_d) + c2, cs_below = 0.5 * (var_s + var_d) + c2;
    const double l_above = 0.5 * (s2 - d2) + c1, l_below = 0.5 * (s2 + d2) + c1;
    const double inverse = 1 / (cs_below * l_below);
    structure[i] = cs_above * l_below * inverse;
    ssim[i] = cs_above * l_above * inverse;
  }
}

// --- flip ------------------------------------------------------------------------------------------------------------

// XYZ relative to the white point from linear Rec.709 RGB: ratios of integers, each row summing to 1.
constexpr double kXr = 10135552.0 / 23359437, kXg = 8788810.0 / 23359437, kXb = 4435075.0 / 23359437;
constexpr double kYr = 2613072.0 / 12288897, kYg = 8788810.0 / 12288897, kYb = 887015.0 / 12288897;
constexpr double kZr = 1425312.0 / 80288307, kZg = 8788810.0 / 80288307, kZb = 70074185.0 / 80288307;
// The inverse: cofactors over the determinant.
constexpr double kDet = kXr * (kYg * kZb - kYb * kZg) - kXg * (kYr * kZb - kYb * kZr) + kXb * (kYr * kZg - kYg * kZr);
constexpr double kRx = (kYg * kZb - kYb * kZg) / kDet, kRy = (kXb * kZg - kXg * kZb) / kDet,
                 kRz = (kXg * kYb - kXb * kYg) / kDet;
constexpr double kGx = (kYb * kZr - kYr * kZb) / kDet, kGy = (kXr * kZb - kXb * kZr) / kDet,
                 kGz = (kXb * kYr - kXr * kYb) / kDet;
constexpr double kBx = (kYr * kZg - kYg * kZr) / kDet, kBy = (kXg * kZr - kXr * kZg) / kDet,
                 kBz = (kXr * kYg - kXg * kYr) / kDet;

void opponents(const double* restrict r, const double* restrict g, const double* restrict b, std::size_t n,
               double* restrict out_y, double* restrict out_xy, double* restrict out_yz) {
  for (std::size_t i = 0; i < n; ++i) {
    const double x = kXr * r[i] + kXg * g[i] + kXb * b[i];
    const double y = kYr * r[i] + kYg * g[i] + kYb * b[i];
    const double z = kZr * r[i] + kZg * g[i] + kZb * b[i];
    out_y[i] = y;
    out_xy[i] = x - y;
    out_yz[i] = y - z;
  }
}

/// The non-linearity of L*a*b*.
inline double lab_curve(double t) {
  constexpr double delta = 6.0 / 29;
  const double bright = t > delta * delta * delta ? t : delta * delta * delta;
  const double root = cube_root(bright);
  const double line = t * (1 / (3 * delta * delta)) + 4.0 / 29;
  return t > delta * delta * delta ? root : line;
}

void perceived(const double* restrict in_y, const double* restrict in_xy, const double* restrict wide,
               const double* restrict narrow, double share, std::size_t n, LabPlanes lab) {
  double* restrict out_l = lab.l, * restrict out_a = lab.a, * restrict out_b = lab.b;
  for (std::size_t i = 0; i < n; ++i) {
    const double filtered_y = in_y[i];
    const double filtered_x = filtered_y + in_xy[i];
    const double filtered_z = filtered_y - (share * wide[i] + (1 - share) * narrow[i]);
    const double r = unit_clamp(kRx * filtered_x + kRy * filtered_y + kRz * filtered_z);
    const double g = unit_clamp(kGx * filtered_x + kGy * filtered_y + kGz * filtered_z);
    const double b = unit_clamp(kBx * filtered_x + kBy * filtered_y + kBz * filtered_z);
    const double fx = lab_curve(kXr * r + kXg * g + kXb * b);
    const double fy = lab_curve(kYr * r + kYg * g + kYb * b);
    const double fz = lab_curve(kZr * r + kZg * g + kZb * b);
    const double lightness = 116 * fy - 16;
    out_l[i] = lightness;
    out_a[i] = 0.01 * lightness * 500 * (fx - fy);
    out_b[i] = 0.01 * lightness * 200 * (fy - fz);
  }
}

void magnitude(const double* restrict a, const double* restrict b, std::size_t n, double* restrict out) {
  for (std::size_t i = 0; i < n; ++i) out[i] = __builtin_sqrt(a[i] * a[i] + b[i] * b[i]);
}

void flip_error(LabPlanes lab_a, LabPlanes lab_b, FeaturePlanes features_a, FeaturePlanes features_b, double greatest,
                std::size_t n, std::uint32_t* restrict steps) {
  constexpr double qc = 0.7, pc = 0.4, pt = 0.95;
  const double knee = pc * greatest, below = pt / knee, above = (1 - pt) / (greatest - knee);
  const double* restrict la = lab_a.l, * restrict aa = lab_a.a, * restrict ba = lab_a.b;
  const double* restrict lb = lab_b.l, * restrict ab = lab_b.a, * restrict bb = lab_b.b;
  const double* restrict edge_a = features_a.edge, * restrict point_a = features_a.point;
  const double* restrict edge_b = features_b.edge, * restrict point_b = features_b.point;
  for (std::size_t i = 0; i < n; ++i) {
    const double da = aa[i] - ab[i], db = ba[i] - bb[i];
    const double hyab = __builtin_fabs(la[i] - lb[i]) + __builtin_sqrt(da * da + db * db);
    const double distance = power(hyab, qc);
    const double low = below * distance, high = pt + above * (distance - knee);
    const double colour = distance < knee ? low : high;
    const double edge = __builtin_fabs(edge_a[i] - edge_b[i]), point = __builtin_fabs(point_a[i] - point_b[i]);
    const double feature = __builtin_sqrt((edge > point ? edge : point) * 0.70710678118654752);
    const double error = power(colour, 1 - feature);
    steps[i] = static_cast<std::uint32_t>(static_cast<std::int32_t>((error < 1 ? error : 1) * flip_steps + 0.5));
  }
}

}  // namespace

extern const PixelLoops PHOTONPROOF_PIXEL_LOOPS;
const PixelLoops PHOTONPROOF_PIXEL_LOOPS = {
    PHOTONPROOF_ISA, split_rgb,          expose,     tone_map,  encode,    filter,    filter_rows, filter_twice,
    filter_odd_even, sum_and_difference, similarity, opponents, perceived, magnitude, flip_error};

}  // namespace photonproof::inline harness_pixels
