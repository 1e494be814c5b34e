// One function a kind of a std::variant, for std::visit: a kind that none of them takes does not compile.
#pragma once

namespace photonproof::inline scenes_description {

template <class... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};
template <class... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;

}  // namespace photonproof::inline scenes_description
