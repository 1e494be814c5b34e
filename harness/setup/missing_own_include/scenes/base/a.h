// Input that own_includes.py must refuse.
#pragma once

namespace photonproof {

int twice(int x);

}  // namespace photonproof
