#include <fcntl.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <sstream>
#include <string>

#include "harness/verbs/usage/name_hints.h"
#include "harness/verbs/verbs.h"
#include "scenes/base/input_error.h"
#include "scenes/base/utf8.h"

namespace photonproof::inline harness_verbs {
namespace {

/// On standard error, without what a terminal would obey: arguments and exceptions may quote anything.
void print_lines(const std::string& text) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) std::fprintf(stderr, "%s\n", printable(line).c_str());
}

/// Opens closed standard streams, else the first file that is opened would get the number of one and its messages.
void open_standard_streams() {
  int file = 0;
  while ((file = open("/dev/null", O_RDWR)) >= 0 && file <= STDERR_FILENO) {
  }
  if (file > STDERR_FILENO) close(file);
}

/// The exit code of a verb whose output on standard output has arrived; else 2 with a message.
int with_output_written(int exit_code) {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return exit_code;
  std::fprintf(stderr, "photonproof: standard output cannot be written\n");
  return exit_code == 0 ? 2 : exit_code;
}

}  // namespace

int run_program(CLI::App& program, int argc, char** argv, const int& exit_code) {
  open_standard_streams();
  if (argc == 1) {  // what there is, but nothing was done
    std::printf("%s", program.help().c_str());
    return with_output_written(2);
  }
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::ostringstream help, unused;
    const int code = program.exit(error, help, unused);
    std::printf("%s", help.str().c_str());
    if (code == 0) return 0;
    print_lines(complaint_about(program, error));
    return 2;
  } catch (const InputError& error) {
    const bool terminal = isatty(STDERR_FILENO) != 0;
    std::fprintf(stderr, "%s\n", terminal ? error.what() : error.report().c_str());
    return 2;
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "photonproof: out of memory: make the image, the meshes or the number of photons smaller\n");
    return 2;
  } catch (const std::filesystem::filesystem_error& error) {
    // A user's folder is unreadable, was removed meanwhile, or has too long a name.
    print_lines(InputError(error.path1().string(), "cannot be used: " + error.code().message()).summary() + "\n");
    return 2;
  } catch (const std::exception& error) {
    print_lines("photonproof: internal error: " + std::string(error.what()) + "\n");
    return 70;
  }
  return with_output_written(exit_code);
}

}  // namespace photonproof::inline harness_verbs
