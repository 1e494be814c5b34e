// A boolean without a default, for facts that every kind of a description must state.
#pragma once

namespace photonproof::inline scenes_description {

/// A kind that omits one from its traits does not compile.
struct GivenBool {
  constexpr GivenBool(bool given) : value(given) {}
  constexpr operator bool() const { return value; }
  bool value;
};

}  // namespace photonproof::inline scenes_description
