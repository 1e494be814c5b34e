// photonproof generate: writes scenes that are made rather than stored.

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "harness/verbs.h"
#include "scenes/input_error.h"
#include "scenes/million.h"

namespace photonproof {
namespace {

namespace fs = std::filesystem;

struct GenerateArguments {
  std::string triangles;
  std::string folder;
  bool force = false;
};

/// "1000000" or "1e6"; throws InputError on anything else and outside the range.
std::uint64_t triangle_count(const std::string& text) {
  double count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  const bool whole = error == std::errc{} && end == text.data() + text.size() && count == std::floor(count);
  if (!whole || count < static_cast<double>(kFewestTriangles) || count > static_cast<double>(kMostTriangles))
    throw InputError("--triangles", "'" + text + "' is not a whole number from 1e3 to 1e7");
  return static_cast<std::uint64_t>(count);
}

/// Throws InputError when a file would be overwritten without leave.
void check_free(const fs::path& folder, bool force) {
  for (const std::string& file : million_files())
    if (!force && fs::exists(folder / file))
      throw InputError((folder / file).string(), "already exists (--force overwrites it)");
}

int run_million(const GenerateArguments& arguments) {
  const MillionPlan plan = plan_million(triangle_count(arguments.triangles));
  const fs::path folder = arguments.folder;
  check_free(folder, arguments.force);
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError(folder.string(), "cannot be made: " + error.message());
  write_million(folder, plan);
  std::printf("%s: %llu triangles, of which %u rocks of %d\n", (folder / "scene.xml").c_str(),
              static_cast<unsigned long long>(plan.triangles()), plan.rocks, 20 << (2 * plan.rock_level));
  return 0;
}

}  // namespace

void add_generate_verb(CLI::App& program, int& exit_code) {
  CLI::App* verb = program.add_subcommand("generate", "Write a scene that is made rather than stored");
  verb->require_subcommand(1);
  auto arguments = std::make_shared<GenerateArguments>();
  CLI::App* million = verb->add_subcommand("million", "A landscape of as many triangles as asked for");
  million->add_option("--triangles", arguments->triangles, "from 1e3 to 1e7, met within 1 %")->required();
  million->add_option("-o,--output", arguments->folder, "folder to write; made when it does not exist")->required();
  million->add_flag("--force", arguments->force, "overwrite the files of an earlier scene");
  million->callback([arguments, &exit_code] { exit_code = run_million(*arguments); });
}

}  // namespace photonproof
