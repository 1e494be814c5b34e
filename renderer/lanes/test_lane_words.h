// Common parts of tests of packs against one lane: arrays of lanes, records as words, random arguments.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <type_traits>
#include <utility>

#include "renderer/lanes/test_lanes.h"
#include "scenes/base/vec.h"

namespace photonproof::test {

using LaneBits = UInt<Lanes>;

template <class T>
using Value = std::remove_cvref_t<decltype(std::declval<T>()[0])>;  // of std::array

template <class F>
Vec3<F> vec3(const F* from) {
  return {from[0], from[1], from[2]};
}
template <class F>
std::array<F, 3> words(const Vec3<F>& v) {
  return {v.x, v.y, v.z};
}
template <class F>
F zero_or_one(const Mask<F>& m) {
  return select(m, F(1.0f), F(0.0f));
}

/// A struct of F and nothing else as an array of them.
template <std::size_t m, class F, class Record>
std::array<F, m> lane_words(const Record& record) {
  static_assert(sizeof(Record) == m * sizeof(F) && std::is_trivially_copyable_v<Record>);
  std::array<F, m> out;
  std::memcpy(&out, &record, sizeof record);
  return out;
}
template <class Record, class F>
Record record_of(const F* from) {
  static_assert(sizeof(Record) % sizeof(F) == 0 && std::is_trivially_copyable_v<Record>);
  Record record;
  std::memcpy(static_cast<void*>(&record), from, sizeof record);
  return record;
}

template <std::size_t n>
auto anythings() {
  return [](Random& random) {
    Floats<n> out;
    for (float& v : out) v = anything(random);
    return out;
  };
}
template <std::size_t n>
auto units() {
  return [](Random& random) {
    Floats<n> out;
    for (float& v : out) v = unit(random);
    return out;
  };
}

inline std::uint32_t some_bits(Random& random) { return static_cast<std::uint32_t>(random.next_bits() >> 32); }

/// The same bits in every lane, and lane by lane, of an integer function of k integers.
template <std::size_t k, class Fn>
void expect_same_bits(const char* name, const Fn& f) {
  for (std::uint64_t i = 0; i < 100'000 / width; ++i) {
    std::array<LaneBits, k> columns;
    std::array<std::array<std::uint32_t, k>, width> rows;
    for (std::size_t lane = 0; lane < width; ++lane) {
      Random random(72, i, lane);
      for (std::size_t j = 0; j < k; ++j) {
        rows[lane][j] = random.next() < 0.3f ? static_cast<std::uint32_t>(32 * random.next()) : some_bits(random);
        columns[j][lane] = rows[lane][j];
      }
    }
    const auto packed = f(columns);
    for (std::size_t lane = 0; lane < width; ++lane) {
      const auto alone = f(rows[lane]);
      for (std::size_t r = 0; r < alone.size(); ++r)
        ASSERT_EQ(packed[r][lane], alone[r]) << name << " of " << testing::PrintToString(rows[lane]);
    }
  }
}

}  // namespace photonproof::test
