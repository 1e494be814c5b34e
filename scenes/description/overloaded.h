// One function per kind of a std::variant, for std::visit. A kind without a function does not compile.
#pragma once

namespace photonproof::inline scenes_description {

template <class... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};
template <class... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;

}  // namespace photonproof::inline scenes_description
