// Records whose members are columns: what holds a value of each kind is a parameter, so that one list of members serves
// for a single record, for arrays, for pointers into them, and for a kernel's lanes.
#pragma once

#include <type_traits>

namespace photonproof {

template <class T>
using OneValue = T;
template <class T>
using Pointer = T*;
template <class T>
using ConstPointer = const T*;

}  // namespace photonproof
