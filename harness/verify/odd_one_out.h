// Finds the outliers among several pictures of a scene from the pairs that agree. A pure function of the pairs.
//
// A closed form is right: an engine that differs from it is an outlier. Engines that certain agreements connect are
// believed if they find light in more ways than the others. Engines that find their light paths by the same code share
// their mistakes and count once. An engine that differs from a believed one is an outlier. If no side has more ways, or
// if two engines differ only from each other, the wrong one is unknown.
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
  agree,     ///< and the minimum detectable error is as small as requested
  differ,    ///< beyond noise and what is declared
  undecided  ///< noise or declared errors would hide a difference
};

struct WitnessPair {
  std::size_t first = 0, second = 0;  ///< indices into the witnesses
  PairVerdict verdict = PairVerdict::undecided;
};

struct OddOnes {
  enum class End {
    agree,       ///< no pair differs, and pairs are certain
    odd,         ///< `odd` differ from the believed ones
    cannot_tell  ///< some differ, and no side has more ways; or nothing is certain
  } end = End::cannot_tell;
  std::vector<std::size_t> odd;       ///< with `cannot_tell`: all that differ from another
  std::vector<std::size_t> believed;  ///< that agree among themselves
  bool by_closed_form = false;        ///< it decided the result
};

OddOnes odd_ones(const std::vector<Witness>& witnesses, const std::vector<WitnessPair>& pairs);

/// An open case once some of the differing ones are known to be wrong. It is decided if the others do not differ from
/// each other, else unchanged.
OddOnes decided_by_known_wrong(const OddOnes& open, const std::vector<std::size_t>& wrong,
                               const std::vector<WitnessPair>& pairs);

}  // namespace photonproof::inline harness_verify
