// Ends a test program on a processor that lacks the instruction set it was compiled for. It runs before everything
// else, static constructors included; CTest takes the exit code for "skipped".
#include <unistd.h>

__attribute__((constructor(101))) static void skip_without_the_instruction_set() {
#if defined(__x86_64__)
  __builtin_cpu_init();
  if (__builtin_cpu_supports(PHOTONPROOF_CPU) == 0) _exit(77);
#endif
}
