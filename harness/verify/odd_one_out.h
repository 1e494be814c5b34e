// Which of several witnesses is wrong, from which of them agree. A pure function of the pairs.
//
// A closed form is right: who differs from it is odd. Of engines, those who agree among themselves are believed when
// they come by their picture in more ways than the others do: engines that find their light paths by the same code
// share their mistakes and count once. One that differs from all of them (whose pair is certain enough) is odd. Where
// no side has more ways, nobody can tell which is wrong.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace photonproof::inline harness_verify {

struct Witness {
  std::string name;
  std::string sampling;  ///< whose code finds its light: "path", "bdpt", "povray"; the same: one way
  bool is_closed_form = false;
};

enum class PairVerdict {
  agree,     ///< and an error as large as is asked for would have been seen
  differ,    ///< beyond noise and what is declared
  undecided  ///< noise or declared errors would hide it
};

struct WitnessPair {
  std::size_t first = 0, second = 0;  ///< witnesses
  PairVerdict verdict = PairVerdict::undecided;
};

struct OddOnes {
  enum class End {
    agree,       ///< nobody differs from anybody, and pairs are certain
    odd,         ///< `odd` differ from those who agree
    cannot_tell  ///< some differ, and no side has more ways; or nothing is certain
  } end = End::cannot_tell;
  std::vector<std::size_t> odd;       ///< where `cannot_tell`: all that differ from somebody
  std::vector<std::size_t> believed;  ///< that agree among themselves
  bool by_closed_form = false;        ///< it decided
};

OddOnes odd_ones(const std::vector<Witness>& witnesses, const std::vector<WitnessPair>& pairs);

}  // namespace photonproof::inline harness_verify
