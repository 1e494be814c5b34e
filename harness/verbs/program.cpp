#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <sstream>
#include <string>

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

/// The first argument where it should name a verb and names none; CLI11 says only that one is required.
std::string unknown_verb(const CLI::App& program, int argc, char** argv) {
  const std::string first = argc > 1 ? argv[1] : "";
  const auto has_that_name = [&](const CLI::App* verb) { return verb->get_name() == first; };
  return first.starts_with('-') || !program.get_subcommands(has_that_name).empty() ? "" : first;
}

}  // namespace

int run_program(CLI::App& program, int argc, char** argv, const int& exit_code) {
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    std::ostringstream help, complaint;
    const int code = program.exit(error, help, complaint);
    const std::string unknown = unknown_verb(program, argc, argv);
    if (code != 0 && !unknown.empty()) complaint.str("'" + unknown + "' is no verb; --help lists them");
    std::printf("%s", help.str().c_str());
    print_lines(complaint.str());
    return code == 0 ? 0 : 2;
  } catch (const InputError& error) {
    const bool terminal = isatty(STDERR_FILENO) != 0;
    std::fprintf(stderr, "%s\n", terminal ? error.what() : error.summary().c_str());
    return 2;
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr, "photonproof: out of memory: make the image, the meshes or the number of photons smaller\n");
    return 2;
  } catch (const std::filesystem::filesystem_error& error) {
    // Of a user's folder: unreadable, gone in the meantime, a name too long.
    print_lines(InputError(error.path1().string(), "cannot be used: " + error.code().message()).summary() + "\n");
    return 2;
  } catch (const std::exception& error) {
    print_lines("photonproof: internal error: " + std::string(error.what()) + "\n");
    return 70;
  }
  return exit_code;
}

}  // namespace photonproof::inline harness_verbs
