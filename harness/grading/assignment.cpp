#include "harness/grading/assignment.h"

#include <algorithm>
#include <cmath>
#include <system_error>

#include "harness/grading/assignment_rows.h"
#include "harness/suites/engine_command.h"
#include "harness/suites/suite_rows.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline harness_grading {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t max_assignment_bytes = std::size_t{1} << 20;

AssignmentLimits limits_of(const TomlTable& table, AssignmentLimits limits) {
  const auto megabytes = [&](const char* key, std::uint64_t& value) {
    if (table.has(key)) value = static_cast<std::uint64_t>(bounded_integer(table, key, 1, 1 << 20));
  };
  if (table.has("seconds")) limits.seconds = positive_number(table, "seconds");
  megabytes("memory_mb", limits.memory_mb);
  megabytes("file_mb", limits.file_mb);
  megabytes("disk_mb", limits.disk_mb);
  megabytes("log_mb", limits.log_mb);
  if (table.has("processes")) limits.processes = bounded_integer(table, "processes", 1, 1 << 16);
  return limits;
}

// Checks that a command has only known placeholders, which grading fills in.
void check_placeholders(const TomlTable& table, const std::string& key, const std::vector<std::string>& command,
                        const std::vector<std::string>& known) {
  if (command.empty()) throw table.error(key, "'" + key + "' must not be empty");
  for (std::size_t i = 0; i < command.size(); ++i)
    for (std::size_t at = command[i].find('{'); at != std::string::npos; at = command[i].find('{', at + 1)) {
      const std::size_t end = command[i].find('}', at);
      const std::string name = command[i].substr(at + 1, end == std::string::npos ? end : end - at - 1);
      if (end == std::string::npos || std::ranges::find(known, name) == known.end()) {
        std::string list;
        for (const std::string& one : known) list += (list.empty() ? "{" : ", {") + one + "}";
        throw table.error(key, i,
                          "unknown placeholder '{" + name + "}'" + did_you_mean(name, known) + "; known: " + list);
      }
      if (name == "scene_option" && command[i] != "{scene_option}")
        throw table.error(key, i, "{scene_option} may be several arguments, so it stands alone");
    }
}

void read_build(const TomlTable& document, Assignment& assignment) {
  assignment.build_limits = {.seconds = 120, .memory_mb = 4096, .file_mb = 256, .disk_mb = 1024, .processes = 256};
  if (!document.has("build")) return;
  const TomlTable table = document.table("build");
  assignment.build_command = table.strings("command");
  check_placeholders(table, "command", assignment.build_command, {"threads"});
  if (table.has("overwrite")) {
    assignment.overwrite = assignment.folder / table.string("overwrite");
    std::error_code unreachable;  // for example a name that is too long
    if (!fs::is_directory(assignment.overwrite, unreachable))
      throw table.error("overwrite", "no such folder: " + assignment.overwrite.string());
  }
  assignment.build_limits = limits_of(table, assignment.build_limits);
  table.expect_no_other_keys();
}

void read_run(const TomlTable& document, Assignment& assignment) {
  const TomlTable table = document.table("run");
  assignment.run_command = table.strings("command");
  check_placeholders(table, "command", assignment.run_command,
                     {"scene", "scene_option", "name", "width", "height", "output", "threads", "seed", "params"});
  if (!mentions(assignment.run_command, "{output}"))
    throw table.error("command", "'command' must have {output}, where the image is to be written");
  if (table.has("seeds")) assignment.seeds = table.boolean("seeds");
  if (assignment.seeds && !mentions(assignment.run_command, "{seed}"))
    throw table.error("seeds", "'seeds' is true, but the command has no {seed}");
  table.expect_no_other_keys();
  if (document.has("limits")) {
    const TomlTable limits = document.table("limits");
    assignment.limits = limits_of(limits, assignment.limits);
    limits.expect_no_other_keys();
  }
}

AssignmentImage image_of_assignment(const TomlTable& table) {
  AssignmentImage image;
  const std::vector<std::string> formats{"exr", "pfm", "hdr", "png", "bmp", "tga", "ppm"};
  image.format = one_of(table, "format", formats);
  if (table.has("transfer"))
    image.gamma = transfer_of(table, "transfer");
  else if (image.is_clamped())
    throw table.error("'transfer' is missing: \"linear\", \"srgb\" or a gamma");
  if (table.has("orientation"))
    image.bottom_up = one_of(table, "orientation", {"top-down", "bottom-up"}) == "bottom-up";
  if (table.has("scale")) image.scale = positive_number(table, "scale");
  table.expect_no_other_keys();
  return image;
}

ReferenceSource reference_source(const TomlTable& table) {
  ReferenceSource source;
  std::vector<std::string> sources{"baseline", "files"};
  for (const Engine& engine : builtin_engines()) sources.push_back(engine.name);
  const std::string from = one_of(table, "from", sources);
  if (from == "files") {
    source.kind = ReferenceSource::Kind::files;
  } else if (from != "baseline") {
    source.kind = ReferenceSource::Kind::engine;
    source.engine = from;
    const std::vector<Engine> engines = builtin_engines();
    const Engine& engine = *find_named(engines, from);
    const std::string text = table.string("budget");
    if (const auto problem = budget_problem(text, engine)) throw table.error("budget", *problem);
    source.budget = *budget_from_text(text);
  }
  if (source.kind != ReferenceSource::Kind::files && table.has("seeds"))
    source.seeds = bounded_integer(table, "seeds", 1, 1024);
  if (source.seeds == 1 && source.kind == ReferenceSource::Kind::engine)
    throw table.error("seeds", "'seeds' is 1, but renders by an engine are random: 2 at least");
  table.expect_no_other_keys();
  return source;
}

// `key` is its place in the table.
const MetricRow* known_metric(const TomlTable& table, const std::string& key, const std::string& name) {
  if (const MetricRow* row = find_metric(name)) return row;
  std::vector<std::string> names;
  for (const MetricRow& row : metric_rows()) names.push_back(row.name);
  throw table.error(key, "unknown metric '" + name + "'" + did_you_mean(name, names));
}

PartialCredit partial_credit(const TomlTable& table) {
  PartialCredit partial;
  partial.metric = known_metric(table, "metric", table.string("metric"));
  partial.full = table.number("full");
  partial.none = table.number("none");
  const bool more_is_better = partial.metric->bound == BoundKind::minimum;
  if (partial.full == partial.none || (partial.full > partial.none) != more_is_better)
    throw table.error("none", std::string("'none' must be ") + (more_is_better ? "less" : "more") + " than 'full'");
  table.expect_no_other_keys();
  return partial;
}

CorrectnessRule correctness_rule(const TomlTable& table) {
  CorrectnessRule rule;
  if (table.has("metrics")) {
    const TomlTable metrics = table.table("metrics");
    for (const std::string& name : metrics.keys())
      rule.metrics.push_back({known_metric(metrics, name, name), metrics.number(name)});
  }
  if (table.has("partial")) rule.partial = partial_credit(table.table("partial"));
  if (table.has("blocks")) {
    const TomlTable blocks = table.table("blocks");
    rule.blocks = {positive_number(blocks, "relative"), positive_number(blocks, "alpha")};
    if (rule.blocks->alpha >= 0.5)
      throw blocks.error("alpha", "'alpha' is the chance that a right image fails: below 0.5");
    blocks.expect_no_other_keys();
  }
  if (rule.metrics.empty() && !rule.blocks)
    throw table.error("needs 'metrics', 'blocks' or both, or any image is right");
  if (table.has("runs")) rule.runs = bounded_integer(table, "runs", 1, 64);
  table.expect_no_other_keys();
  return rule;
}

void read_points(const TomlTable& document, Assignment& assignment) {
  if (!document.has("points")) return;
  const TomlTable table = document.table("points");
  if (table.has("correctness")) assignment.correctness_points = table.number("correctness");
  if (assignment.correctness_points < 0) throw table.error("correctness", "'correctness' must not be negative");
  table.expect_no_other_keys();
}

}  // namespace

double positive_number(const TomlTable& table, const std::string& key) {
  const double value = table.number(key);
  if (value <= 0) throw table.error(key, "'" + key + "' must be positive");
  return value;
}

std::string one_of(const TomlTable& table, const std::string& key, const std::vector<std::string>& known) {
  const std::string value = table.string(key);
  if (std::ranges::find(known, value) == known.end())
    throw table.error(key, "'" + key + "' is '" + value + "', expected " + join_or(known) + did_you_mean(value, known));
  return value;
}

std::optional<double> transfer_of(const TomlTable& table, const std::string& key) {
  if (table.is_string(key)) {
    const std::string name = one_of(table, key, {"linear", "srgb"});
    return name == "srgb" ? std::nullopt : std::optional<double>(1.0);
  }
  return positive_number(table, key);
}

bool Assignment::is_timed(const std::string& scene) const {
  return performance && std::ranges::find(performance->timed, scene) != performance->timed.end();
}

Assignment read_assignment(const fs::path& file) {
  Assignment assignment;
  assignment.file = file;
  assignment.folder = fs::absolute(file).parent_path().lexically_normal();
  assignment.text = read_file(file, max_assignment_bytes);
  const TomlTable document = TomlTable::parse(assignment.text, file.string());
  assignment.name = file_name(document, "name");
  assignment.title = document.has("title") ? document.string("title") : assignment.name;
  read_build(document, assignment);
  read_run(document, assignment);
  assignment.image = image_of_assignment(document.table("image"));
  const TomlTable baseline = document.table("baseline");
  assignment.baseline = assignment.folder / baseline.string("submission");
  std::error_code unreachable;  // for example a name that is too long
  if (!fs::exists(assignment.baseline, unreachable))
    throw baseline.error("submission", "no such file or folder: " + assignment.baseline.string());
  baseline.expect_no_other_keys();
  if (document.has("reference")) {
    const TomlTable reference = document.table("reference");
    assignment.reference = reference_source(reference);
    if (assignment.reference.seeds == 1 && assignment.seeds)
      throw reference.error("seeds", "'seeds' is 1, but the command of [run] has {seed}: expected 2 at least");
  }
  assignment.correctness = correctness_rule(document.table("correctness"));
  read_points(document, assignment);
  read_assignment_scenes(document, assignment);
  if (document.has("performance")) assignment.performance = performance_rule(document.table("performance"), assignment);
  document.expect_no_other_keys();
  return assignment;
}

}  // namespace photonproof::inline harness_grading
