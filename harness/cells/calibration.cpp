#include "harness/cells/calibration.h"

#include <time.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <thread>
#include <utility>

#include "harness/statistics/statistics.h"
#include "scenes/base/timer.h"

namespace photonproof::inline harness_cells {
namespace {

// Names the workload: readings of two different workloads are not comparable.
constexpr const char* workload_name = "1 (" __VERSION__ ")";
constexpr std::uint32_t levels = 15;
constexpr std::uint32_t leaves = 1u << levels;
constexpr int grid = 32;  // grid^3 == leaves
constexpr int rays = 8000;
constexpr std::size_t runs_at_start = 3, most_runs = 20;
constexpr double share_of_engine = 0.005;

// Knuth's linear congruential generator of MMIX; numbers in [0, 1) from its upper bits.
class Numbers {
 public:
  float next() {
    state_ = state_ * 6364136223846793005u + 1442695040888963407u;
    return static_cast<float>(state_ >> 40) * 0x1p-24f;
  }

 private:
  std::uint64_t state_ = 42;
};

// Every third bit of a leaf's number is a bit of its cell's coordinate, so neighbours in number are neighbours in
// space.
int coordinate(std::uint32_t leaf, int axis) {
  int value = 0;
  for (int bit = 0; bit < 5; ++bit) value |= static_cast<int>(leaf >> (3 * bit + axis) & 1u) << bit;
  return value;
}

double thread_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace

CalibrationWorkload::CalibrationWorkload() : boxes_(2 * leaves), spheres_(leaves) {
  Numbers numbers;
  for (std::uint32_t leaf = 0; leaf < leaves; ++leaf) {
    Sphere& sphere = spheres_[leaf];
    sphere.radius = (0.1f + 0.2f * numbers.next()) / grid;
    for (int axis = 0; axis < 3; ++axis) {
      sphere.center[axis] = (static_cast<float>(coordinate(leaf, axis)) + numbers.next()) / grid;
      boxes_[leaves + leaf].low[axis] = sphere.center[axis] - sphere.radius;
      boxes_[leaves + leaf].high[axis] = sphere.center[axis] + sphere.radius;
    }
  }
  for (std::uint32_t i = leaves - 1; i >= 1; --i)
    for (int axis = 0; axis < 3; ++axis) {
      boxes_[i].low[axis] = std::min(boxes_[2 * i].low[axis], boxes_[2 * i + 1].low[axis]);
      boxes_[i].high[axis] = std::max(boxes_[2 * i].high[axis], boxes_[2 * i + 1].high[axis]);
    }
}

// Index of the closest sphere; `leaves` if the ray hits none.
std::uint32_t CalibrationWorkload::closest(const float (&from)[3], const float (&along)[3]) const {
  float inverse[3];
  for (int axis = 0; axis < 3; ++axis) inverse[axis] = 1 / along[axis];
  std::uint32_t stack[levels + 1], depth = 0, hit = leaves;
  float nearest = 1e30f;
  stack[depth++] = 1;
  while (depth > 0) {
    const std::uint32_t i = stack[--depth];
    const Box& box = boxes_[i];
    float enter = 0, leave = nearest;
    for (int axis = 0; axis < 3; ++axis) {
      const float a = (box.low[axis] - from[axis]) * inverse[axis], b = (box.high[axis] - from[axis]) * inverse[axis];
      enter = std::max(enter, std::min(a, b));
      leave = std::min(leave, std::max(a, b));
    }
    if (enter > leave) continue;
    if (i < leaves) {
      // The half on the ray's side is visited first. The axis that level i splits repeats every three levels.
      const int axis = (static_cast<int>(levels) - static_cast<int>(std::bit_width(i))) % 3;
      const std::uint32_t near = along[axis] > 0 ? 0 : 1;
      stack[depth++] = 2 * i + 1 - near;
      stack[depth++] = 2 * i + near;
      continue;
    }
    const Sphere& sphere = spheres_[i - leaves];
    float b = 0, c = -sphere.radius * sphere.radius;
    for (int axis = 0; axis < 3; ++axis) {
      const float offset = sphere.center[axis] - from[axis];
      b += offset * along[axis];
      c += offset * offset;
    }
    const float discriminant = b * b - c;
    if (discriminant < 0) continue;
    const float t = b - std::sqrt(discriminant);
    if (t > 0 && t < nearest) {
      nearest = t;
      hit = i - leaves;
    }
  }
  return hit;
}

std::uint64_t CalibrationWorkload::run() const {
  Numbers numbers;
  std::uint64_t sum = 0;
  for (int ray = 0; ray < rays; ++ray) {
    float from[3], along[3], square = 0;
    for (int axis = 0; axis < 3; ++axis) {
      from[axis] = numbers.next();
      along[axis] = numbers.next() - 0.5f;
      square += along[axis] * along[axis];
    }
    const float scale = 1 / std::sqrt(square + 1e-12f);
    for (float& x : along) x *= scale;
    sum += closest(from, along);
  }
  return sum;
}

std::size_t calibration_runs(double engine_seconds, double run_seconds) {
  return static_cast<std::size_t>(
      std::clamp(share_of_engine * engine_seconds / run_seconds, 1.0, static_cast<double>(most_runs)));
}

Calibration::Calibration(int threads) : threads_(std::max(1, threads)) {
  const Timer timer;
  last_ = read(runs_at_start);
  run_seconds_ = timer.seconds() / static_cast<double>(runs_at_start);
}

double Calibration::read(std::size_t runs) const {
  std::vector<double> seconds(static_cast<std::size_t>(threads_));
  const auto work = [&](std::size_t thread) {
    std::vector<double> times(runs);
    for (double& time : times) {
      const double before = thread_seconds();
      // `volatile` forces the compiler to compute the unused sum.
      [[maybe_unused]] volatile const std::uint64_t sum = workload_.run();
      time = thread_seconds() - before;
    }
    seconds[thread] = median_of(times);
  };
  {
    std::vector<std::jthread> others;
    for (std::size_t thread = 1; thread < seconds.size(); ++thread) others.emplace_back(work, thread);
    work(0);
  }
  return std::accumulate(seconds.begin(), seconds.end(), 0.0) / threads_;
}

bool ReadingSchedule::is_due(const Cell& cell, double engine_seconds) {
  Cell any_seed = cell;
  any_seed.seed = 0;
  since_reading_ += engine_seconds;
  if (since_reading_ < longest_shared && sharing_.insert(any_seed.label()).second) return false;
  since_reading_ = 0;
  sharing_ = {any_seed.label()};  // half of its reading is the next one's
  return true;
}

CalibrationReading Calibration::after_cell(const Cell& cell, double engine_seconds) {
  if (!schedule_.is_due(cell, engine_seconds)) return {workload_name, threads_, last_};
  const double before = std::exchange(last_, read(calibration_runs(engine_seconds, run_seconds_)));
  return {workload_name, threads_, (before + last_) / 2};
}

}  // namespace photonproof::inline harness_cells
