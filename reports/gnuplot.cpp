#include "reports/gnuplot.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string_view>

#include "reports/temporary_folder.h"
#include "scenes/atomic_file.h"

extern char** environ;

namespace photonproof::reports {
namespace {

/// 0 on success, otherwise an errno; `exit_status` is waitpid's.
int spawn_and_wait(const std::string& program, const std::string& script, const std::string& errors, int& exit_status) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  std::string defaults = "-d";  // no ~/.gnuplot: the same picture for everybody
  std::string program_copy = program, script_copy = script;
  char* argv[] = {program_copy.data(), defaults.data(), script_copy.data(), nullptr};
  pid_t child = 0;
  const int error = posix_spawnp(&child, program.c_str(), &actions, nullptr, argv, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) return error;
  while (waitpid(child, &exit_status, 0) < 0) {
    if (errno != EINTR) return errno;
  }
  return 0;
}

void replace_all(std::string& text, std::string_view from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
    text.replace(at, from.size(), to);
  }
}

/// Removes every element `<open ...>...</close>`; gnuplot nests none of those asked for.
void remove_elements(std::string& text, std::string_view open, std::string_view close) {
  for (std::size_t at = text.find(open); at != std::string::npos; at = text.find(open, at)) {
    const std::size_t end = text.find(close, at);
    if (end == std::string::npos) return;
    text.erase(at, end + close.size() - at);
  }
}

}  // namespace

PlotOutcome run_gnuplot(const std::string& script, const std::string& program) {
  const TemporaryFolder folder;
  const std::filesystem::path output = folder.path() / "plot.svg", errors = folder.path() / "errors.txt";
  const std::filesystem::path script_file = folder.path() / "plot.gp";
  std::string quoted = output.string();
  replace_all(quoted, "'", "''");
  write_file_atomically(script_file, "set output '" + quoted + "'\n" + script);
  int status = 0;
  const int error = spawn_and_wait(program, script_file.string(), errors.string(), status);
  if (error == ENOENT) return {{}, program + " is not installed"};
  if (error != 0) return {{}, program + " did not start: " + std::strerror(error)};
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0 || !std::filesystem::exists(output)) {
    return {{}, program + " failed: " + read_file(errors)};
  }
  return {read_file(output), {}};
}

std::string inline_svg(const std::string& svg, const std::string& id_prefix, const std::string& attributes) {
  const std::size_t box = svg.find("viewBox=\"");
  const std::size_t box_end = box == std::string::npos ? box : svg.find('"', box + 9);
  const std::size_t body = svg.find("<g id=\"gnuplot_canvas\">");
  const std::size_t end = svg.rfind("</svg>");
  if (box_end == std::string::npos || body == std::string::npos || end == std::string::npos || body > end) return {};
  std::string drawing = svg.substr(body, end - body);
  remove_elements(drawing, "<title>", "</title>");
  remove_elements(drawing, "<filter ", "</filter>");
  replace_all(drawing, "id=\"", "id=\"" + id_prefix);
  replace_all(drawing, "id='", "id='" + id_prefix);
  replace_all(drawing, "xlink:href='#", "href='#" + id_prefix);
  return "<svg " + svg.substr(box, box_end + 1 - box) + " " + attributes + ">\n" + drawing + "</svg>";
}

}  // namespace photonproof::reports
