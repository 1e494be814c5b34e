#include "renderer/irradiance/irradiance_cache.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace photonproof::inline renderer_irradiance {
namespace {

constexpr int unit_level = 24;
/// Limit of a point's depth below a record's tangent plane, in radii of the record.
constexpr float behind_part = 0.05f;

int level_of(float reach) {
  return std::clamp(std::ilogb(std::max(2 * reach, 1e-6f)) + 1 + unit_level, 0, 2 * unit_level - 1);
}

std::int64_t coordinate(int level, float x) {
  return static_cast<std::int64_t>(std::floor(std::ldexp(x, unit_level - level)));
}

std::uint64_t key_of(int level, std::int64_t x, std::int64_t y, std::int64_t z) {
  std::uint64_t h = static_cast<std::uint64_t>(level) * 0x9E3779B97F4A7C15u;
  for (const std::int64_t c : {x, y, z}) {
    h = (h ^ static_cast<std::uint64_t>(c)) * 0xD6E8FEB86659FD93u;
    h ^= h >> 32;
  }
  return h;
}

}  // namespace

std::uint64_t IrradianceCache::cell_key(int level, const Vec3f& p) const {
  return key_of(level, coordinate(level, p.x), coordinate(level, p.y), coordinate(level, p.z));
}

template <class Visit>
void IrradianceCache::for_each_near(const Vec3f& p, Visit&& visit) const {
  for (std::uint64_t bits = levels_used_; bits != 0; bits &= bits - 1) {
    const auto found = cells_.find(cell_key(std::countr_zero(bits), p));
    if (found == cells_.end()) continue;
    for (const std::uint32_t i : found->second) visit(i);
  }
}

float IrradianceCache::error(const IrradianceRecord& record, const Vec3f& p, const Vec3f& n) const {
  constexpr float never = std::numeric_limits<float>::infinity();
  const Vec3f way = p - record.p;
  if (dot(record.n, n) <= 0) return never;
  if (dot(way, record.n + n) < -2 * behind_part * record.radius) return never;
  return length(way) / record.radius + std::sqrt(std::max(0.0f, 1 - dot(record.n, n)));
}

void IrradianceCache::insert(const IrradianceRecord& record, float least_radius) {
  IrradianceRecord added = record;
  added.radius = std::max(added.radius, least_radius);
  for_each_near(added.p, [&](std::uint32_t i) {
    IrradianceRecord& other = records_[i];
    const float apart = length(other.p - added.p);
    added.radius = std::max(least_radius, std::min(added.radius, other.radius + apart));
    other.radius = std::max(least_radius_[i], std::min(other.radius, added.radius + apart));
  });
  const auto number = static_cast<std::uint32_t>(records_.size());
  records_.push_back(added);
  least_radius_.push_back(least_radius);
  const float reach = kappa_ * added.radius;
  const int level = level_of(reach);
  levels_used_ |= std::uint64_t{1} << level;
  const auto low = added.p - Vec3f(reach), high = added.p + Vec3f(reach);
  for (std::int64_t z = coordinate(level, low.z); z <= coordinate(level, high.z); ++z)
    for (std::int64_t y = coordinate(level, low.y); y <= coordinate(level, high.y); ++y)
      for (std::int64_t x = coordinate(level, low.x); x <= coordinate(level, high.x); ++x)
        cells_[key_of(level, x, y, z)].push_back(number);
}

bool IrradianceCache::covers(const Vec3f& p, const Vec3f& n) const {
  bool covered = false;
  for_each_near(p, [&](std::uint32_t i) { covered = covered || error(records_[i], p, n) < kappa_; });
  return covered;
}

std::optional<Rgb> IrradianceCache::find(const Vec3f& p, const Vec3f& n) const {
  Rgb sum(0.0f);
  float weights = 0;
  for_each_near(p, [&](std::uint32_t i) {
    const float weight = 1 - error(records_[i], p, n) / kappa_;
    if (!(weight > 0)) return;
    sum += weight * records_[i].at(p, n);
    weights += weight;
  });
  if (!(weights > 0)) return std::nullopt;
  return sum * (1 / weights);
}

float IrradianceCache::doubt(const Vec3f& p, const Vec3f& n) const {
  float weights = 0, sum = 0, squares = 0, steepness = 0;
  for_each_near(p, [&](std::uint32_t i) {
    const IrradianceRecord& record = records_[i];
    const float weight = 1 - error(record, p, n) / kappa_;
    if (!(weight > 0)) return;
    const Rgb said = record.at(p, n);
    const float brightness = said.x + said.y + said.z;
    weights += weight;
    sum += weight * brightness;
    squares += weight * brightness * brightness;
    steepness += weight * length(record.moved[0] + record.moved[1] + record.moved[2]) * reach(record);
  });
  if (!(sum > 0)) return 1;
  return std::min(1.0f, (steepness + std::sqrt(std::max(0.0f, squares * weights - sum * sum))) / sum);
}

const IrradianceRecord* IrradianceCache::nearest(const Vec3f& p, const Vec3f& n) const {
  const IrradianceRecord* best = nullptr;
  float least = std::numeric_limits<float>::infinity();
  for_each_near(p, [&](std::uint32_t i) {
    const IrradianceRecord& record = records_[i];
    const float apart = length(p - record.p);
    if (apart < std::min(least, reach(record)) && dot(record.n, n) > 0.5f) best = &record, least = apart;
  });
  return best;
}

Rgb IrradianceCache::interpolate(const Vec3f& p, const Vec3f& n) const {
  if (const std::optional<Rgb> found = find(p, n)) return *found;
  const IrradianceRecord* best = nullptr;
  float least = std::numeric_limits<float>::infinity();
  for (const IrradianceRecord& record : records_) {
    const float here = length(p - record.p) / record.radius + 4 * (1 - dot(record.n, n));
    if (here < least) best = &record, least = here;
  }
  return best != nullptr ? best->irradiance : Rgb(0.0f);
}

}  // namespace photonproof::inline renderer_irradiance
