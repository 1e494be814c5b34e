// Ends a test program on a processor that has not what it was compiled for, before anything of it runs, static
// constructors included; CTest takes the exit code for "skipped".
#include <unistd.h>

__attribute__((constructor(101))) static void skip_without_the_instruction_set() {
#if defined(__x86_64__)
  __builtin_cpu_init();
  if (__builtin_cpu_supports(PHOTONPROOF_CPU) == 0) _exit(77);
#endif
}
