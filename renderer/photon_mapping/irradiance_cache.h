// Irradiance between few points where it was computed (Ward, Rubinstein and Clear 1988). A record stands for a point
// with the split-sphere error |p - p_i| / R_i + sqrt(1 - n . n_i) where that is less than kappa, with the weight
// 1 - error / kappa, which leaves no edge where a record ends. Neighbours bound each other's R by what geometry allows,
// R_i <= R_j + |p_i - p_j| (Krivanek et al. 2006): one that missed a near wall learns of it from one that did not.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "renderer/photon_mapping/irradiance_record.h"

namespace photonproof::inline renderer_photon_mapping {

class IrradianceCache {
 public:
  /// kappa: the error at which records end.
  explicit IrradianceCache(float kappa) : kappa_(kappa) {}

  /// Its R is kept above `least_radius`. Not while others look up.
  void insert(const IrradianceRecord& record, float least_radius);
  /// Whether some record stands for the point.
  bool covers(const Vec3f& p, const Vec3f& n) const;
  /// Weighted mean of what records say; nothing where none stands for the point.
  std::optional<Rgb> find(const Vec3f& p, const Vec3f& n) const;
  /// A guess of how wrong the cache is at the point, as a part of its irradiance, 1 at most: how far records disagree,
  /// and how much they say changes within their reach, which is never less than some pixels.
  float doubt(const Vec3f& p, const Vec3f& n) const;
  /// As `find`, or where no record stands for the point what the one of least error says; 0 without records.
  Rgb interpolate(const Vec3f& p, const Vec3f& n) const;
  /// Of those whose reach includes the point and that face as it does, the nearest one; null: none.
  const IrradianceRecord* nearest(const Vec3f& p, const Vec3f& n) const;
  /// How far from it a record is used where surfaces are flat.
  float reach(const IrradianceRecord& record) const { return kappa_ * record.radius; }
  const std::vector<IrradianceRecord>& records() const { return records_; }

 private:
  /// Error of the record at the point; infinite where the point sees what lies behind it.
  float error(const IrradianceRecord& record, const Vec3f& p, const Vec3f& n) const;
  std::uint64_t cell_key(int level, const Vec3f& p) const;
  /// Calls visit(record's number) for all whose reach, at most, includes p.
  template <class Visit>
  void for_each_near(const Vec3f& p, Visit&& visit) const;

  static constexpr int levels = 48;
  float kappa_;
  std::vector<IrradianceRecord> records_;
  std::vector<float> least_radius_;
  std::uint64_t levels_used_ = 0;
  /// Cells of side 2^(level - 24): a record is in those that its reach touches, of the level where these are at most 8.
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

}  // namespace photonproof::inline renderer_photon_mapping
