#include "renderer/scene/mixed_mirrors.h"

#include <cmath>
#include <cstring>

namespace photonproof::inline renderer_scene {
namespace {

/// Calls visit(record) for the record of this kind.
template <class Visit>
void with_record(std::uint32_t kind, const float* words, const Visit& visit) {
  BsdfKinds::for_each([&]<template <class> class Kind>(std::uint32_t index) {
    if (index != kind) return;
    Kind<float> record;
    std::memcpy(static_cast<void*>(&record), words, sizeof record);
    visit(record);
  });
}

struct Smooth {
  Rgb value{0.0f};  ///< with the cosine
  float pdf = 0;
};

Smooth evaluated(std::uint32_t kind, const float* words, const Vec3f& wo, const Vec3f& wi) {
  Smooth smooth;
  with_record(kind, words, [&](const auto& bsdf) {
    smooth = {Rgb(bsdf.eval(wo, wi) * std::abs(wi.z)), bsdf.pdf(wo, wi)};
  });
  return smooth;
}

}  // namespace

void mix_mirror(std::uint32_t kind, float* mirror, float share, std::uint32_t other_kind, const float* other,
                const Vec3f& wo) {
  with_record(kind, mirror, [&]<class Record>(Record record) {
    if constexpr (!Record::has_smooth && requires { record.reflectance; }) {
      const Rgb reflectance = record.reflectance;
      record.reflectance = Rgb(1.0f);
      const BsdfSample<float> drawn = record.sample(wo, 0, {0, 0}, TransportMode::radiance);  // 0: it reflects
      const Rgb& fresnel = drawn.weight;
      const bool reflects = drawn.valid && drawn.wi_local.z * wo.z > 0;
      if (!reflects || !(fresnel.x > 0 && fresnel.y > 0 && fresnel.z > 0)) return;
      const Smooth beside = evaluated(other_kind, other, wo, drawn.wi_local);
      const float own = share * drawn.pdf, rest = 1 - share;
      const float density = own + rest * beside.pdf;
      if (!(density > 0)) return;
      record.reflectance = (reflectance * fresnel * own + beside.value * rest) / (fresnel * density);
      std::memcpy(mirror, &record, sizeof record);
    }
  });
}

}  // namespace photonproof::inline renderer_scene
