// Packs ask the scalar side about lights that need tables and for choices by position (light_block.h).
#pragma once

#include <cstring>

#include "renderer/light_choice/light_block.h"
#include "renderer/rays/surface_hit.h"

namespace photonproof {

template <class F>
void put(LightBlock::Column3& to, const Vec3<F>& v) {
  store_from(v.x, to[0]);
  store_from(v.y, to[1]);
  store_from(v.z, to[2]);
}
template <class F>
Vec3<F> take3(const LightBlock::Column3& from) {
  Vec3<F> v;
  load_into(v.x, from[0]);
  load_into(v.y, from[1]);
  load_into(v.z, from[2]);
  return v;
}
template <class F>
F take(const LightBlock::Column& from) {
  F v;
  load_into(v, from);
  return v;
}
template <class F>
UInt<F> take_words(const LightBlock::Words& from) {
  UInt<F> v;
  load_into(v, from);
  return v;
}
template <class F>
Mask<F> take_mask(const LightBlock::Words& from) {
  return !equal<F>(take_words<F>(from), UInt<F>(0u));
}

/// A block that asks about these lanes' lights; what lanes do not ask for is answered by zeros.
template <class Block, class F>
Block ask(const UInt<F>& light, const Mask<F>& lanes) {
  Block block{};
  block.active = to_bits(lanes);
  store_from(light, block.light);
  return block;
}

}  // namespace photonproof
