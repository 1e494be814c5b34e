// Records whose members are columns. The container of each column's values is a parameter, so one list of members
// serves for a single record, for arrays, for pointers into them, and for a kernel's lanes.
#pragma once

#include <cstddef>

namespace photonproof::inline renderer_core {

template <class T>
using OneValue = T;
template <class T>
using Pointer = T*;
template <class T>
using ConstPointer = const T*;

/// The number of columns that `zip` visits in a record of single values; it ensures that none is forgotten.
template <class Record, class Zip>
consteval std::size_t columns_visited(const Zip& zip) {
  std::size_t columns = 0;
  Record record{};
  zip([&columns](auto&) { ++columns; }, record);
  return columns;
}

}  // namespace photonproof::inline renderer_core
