// Loops over all cores through oneTBB, kept out of the headers of everything else.
#pragma once

#include <cstddef>
#include <functional>

namespace photonproof {

/// A number of worker threads for the loops run inside `run`; 0 asks for every core. More than the machine has is
/// allowed (the determinism tests use 7).
class Threads {
 public:
  explicit Threads(int count);
  int count() const { return count_; }
  /// Calls body(i) for every i in [0, n), in any order, on any thread. Rethrows the first exception.
  void for_each(std::size_t n, const std::function<void(std::size_t)>& body) const;

 private:
  int count_;
};

struct Tile {
  int x0, y0, x1, y1;
};

/// Calls body(tile) for 16x16 tiles that cover the image.
void for_each_tile(const Threads& threads, int width, int height, const std::function<void(const Tile&)>& body);

}  // namespace photonproof
