// For code that is compiled once for each instruction set into one program. The linker cannot merge a function that is
// never emitted out of line with its twin from a translation unit of a newer instruction set.
#pragma once

#define PHOTONPROOF_ALWAYS_INLINE [[gnu::always_inline]] inline
/// The same for a lambda: [&](int i) PHOTONPROOF_INLINE_LAMBDA { ... }.
#define PHOTONPROOF_INLINE_LAMBDA __attribute__((always_inline))
