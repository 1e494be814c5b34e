// Irradiance interpolated between few points where it was computed (Ward, Rubinstein and Clear 1988). The split-sphere
// error of record i at a point is |p - p_i| / R_i + sqrt(1 - n . n_i). A record is used where the error is less than
// kappa, with the weight 1 - error / kappa, so that no edge shows where it ends. Neighbours bound each other's R by
// geometry, R_i <= R_j + |p_i - p_j| (Krivanek et al. 2006). A record whose rays missed a near wall thus gets a bound
// from one whose rays hit it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "renderer/irradiance/irradiance_record.h"

namespace photonproof::inline renderer_irradiance {

class IrradianceCache {
 public:
  /// kappa: the error at which records end.
  explicit IrradianceCache(float kappa) : kappa_(kappa) {}

  /// Adds the record with R of at least `least_radius`. Not safe while other threads read.
  void insert(const IrradianceRecord& record, float least_radius);
  /// Whether some record is used at the point.
  bool covers(const Vec3f& p, const Vec3f& n) const;
  /// Weighted mean of the records used at the point; empty without any.
  std::optional<Rgb> find(const Vec3f& p, const Vec3f& n) const;
  /// Estimated relative error of the cache at the point, at most 1. It sums the disagreement of records and their
  /// change within their reach, which is never less than some pixels.
  float doubt(const Vec3f& p, const Vec3f& n) const;
  /// As `find`, but where no record is used at the point, the value of the record with the least error; 0 without
  /// records.
  Rgb interpolate(const Vec3f& p, const Vec3f& n) const;
  /// Nearest record whose reach includes the point and whose normal is within 60 degrees of n; null if none.
  const IrradianceRecord* nearest(const Vec3f& p, const Vec3f& n) const;
  /// Distance up to which a record is used on a flat surface.
  float reach(const IrradianceRecord& record) const { return kappa_ * record.radius; }
  const std::vector<IrradianceRecord>& records() const { return records_; }

 private:
  /// Error of the record at the point; infinite where the point lies behind the record or faces away from it.
  float error(const IrradianceRecord& record, const Vec3f& p, const Vec3f& n) const;
  std::uint64_t cell_key(int level, const Vec3f& p) const;
  /// Calls visit(record's number) for all records whose reach may include p.
  template <class Visit>
  void for_each_near(const Vec3f& p, Visit&& visit) const;

  static constexpr int levels = 48;
  float kappa_;
  std::vector<IrradianceRecord> records_;
  std::vector<float> least_radius_;
  std::uint64_t levels_used_ = 0;
  /// Cells have the side 2^(level - 24). A record is in all cells that its reach touches, at most 8, of the level that
  /// allows this.
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

}  // namespace photonproof::inline renderer_irradiance
