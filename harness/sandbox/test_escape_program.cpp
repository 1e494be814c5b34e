// The program that escapes_test.cpp runs contained: NAME FOLDER GRADER PORT ABSTRACT ADDRESS MARKER. Without arguments
// it is the grader under attack: it prints the address of the token in its memory, and waits.
#include <unistd.h>

#include <cstdlib>
#include <cstring>

#include "harness/sandbox/test_escapes.h"

int main(int argc, char** argv) {
  using namespace photonproof::escapes;
  if (argc == 1) {
    std::printf("%lu\n", reinterpret_cast<unsigned long>(token));
    std::fflush(stdout);
    for (;;) pause();
  }
  if (argc != 8) return 2;
  const Target target{argv[2], std::atoi(argv[3]), std::atoi(argv[4]), argv[5], std::strtoul(argv[6], nullptr, 10),
                      argv[7]};
  for (const auto rows :
       {file_attempts(), process_attempts(), network_attempts(), kernel_attempts(), greedy_attempts()})
    for (const Attempt& attempt : rows)
      if (std::strcmp(attempt.name, argv[1]) == 0) {
        attempt.run(target);
        std::printf("tried\n");
        return 0;
      }
  return 2;
}
