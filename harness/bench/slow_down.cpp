// slow_down FRACTION PROGRAM [ARGUMENT...]: runs the program and then computes for FRACTION of its processor time, so
// that it seems slower by exactly that. A planted regression of known size (power_of_against.sh).

#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

namespace {

double seconds_of(const rusage& usage) {
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

double own_seconds() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: slow_down FRACTION PROGRAM [ARGUMENT...]\n");
    return 2;
  }
  const double fraction = std::strtod(argv[1], nullptr);
  const pid_t child = fork();
  if (child < 0) return 2;
  if (child == 0) {
    execv(argv[2], argv + 2);
    _exit(127);
  }
  int status = 0;
  rusage usage{};
  if (wait4(child, &status, 0, &usage) != child) return 2;
  // The program's own start counts too: the whole becomes slower, not only the child.
  const double own = own_seconds(), end = own + fraction * (own + seconds_of(usage));
  while (own_seconds() < end) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}
