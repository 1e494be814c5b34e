// Loops over all cores through oneTBB, whose headers no other header includes.
#pragma once

#include <cstddef>
#include <functional>

namespace photonproof::inline renderer_core {

/// A number of worker threads for the loops run inside `run`; 0 means every core. More than the machine has is allowed
/// (the determinism tests use 7).
class Threads {
 public:
  explicit Threads(int count);
  int count() const { return count_; }
  /// Calls body(i) for every i in [0, n), in any order, on any thread. Rethrows the first exception.
  void for_each(std::size_t n, const std::function<void(std::size_t)>& body) const;

  /// All indices that `for_each_in_order` has between `body` and `commit` at any time lie within this many.
  std::size_t in_flight() const { return 4 * static_cast<std::size_t>(count_); }
  /// For i = first, first + 1, ... below n: body(i) in any order on any thread, then commit(i) in the order of i. It
  /// calls stop() before each i; indices begun by then are committed. Returns the first i that was not begun, or n. The
  /// slot i % in_flight() is used by no other index between its body and its commit.
  std::size_t for_each_in_order(std::size_t first, std::size_t n, const std::function<bool()>& stop,
                                const std::function<void(std::size_t)>& body,
                                const std::function<void(std::size_t)>& commit) const;

 private:
  int count_;
};

/// Pixels with x0 <= x < x1 and y0 <= y < y1.
struct Tile {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  bool contains(int x, int y) const { return x >= x0 && x < x1 && y >= y0 && y < y1; }
  friend bool operator==(const Tile&, const Tile&) = default;
};

/// A window cut into tiles of 16x16 pixels, row by row; smaller ones at its right and lower border.
class Tiles {
 public:
  explicit Tiles(const Tile& window);
  std::size_t count() const { return across_ * down_; }
  Tile at(std::size_t i) const;

 private:
  static constexpr int size = 16;
  Tile window_;
  std::size_t across_, down_;
};

}  // namespace photonproof::inline renderer_core
