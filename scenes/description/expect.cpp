#include "scenes/description/expect.h"

#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>

#include "scenes/base/edit_distance.h"
#include "scenes/base/input_error.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline scenes_description {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{1} << 20;

/// Line `line` (from 1) of `text`.
std::string source_line(const std::string& text, int line) {
  std::size_t start = 0;
  for (int i = 1; i < line && start != std::string::npos; ++i) {
    start = text.find('\n', start);
    if (start != std::string::npos) ++start;
  }
  return start == std::string::npos ? "" : text.substr(start, text.find('\n', start) - start);
}

/// A table whose every key must be read.
class Table {
 public:
  Table(const std::string& text, const std::string& path, const toml::table& table, std::string name)
      : text_(text), path_(path), table_(table), name_(std::move(name)) {}

  const toml::node* find(const std::string& key) {
    known_.push_back(key);
    return table_.get(key);
  }

  const toml::node& get(const std::string& key) {
    const toml::node* node = find(key);
    if (!node) fail(table_.source(), name_ + " needs the key '" + key + "'");
    return *node;
  }

  std::string text(const std::string& key) { return as_text(get(key), key); }

  std::string as_text(const toml::node& node, const std::string& key) const {
    const auto value = node.value_exact<std::string>();
    if (!value || value->empty()) fail(node.source(), "'" + key + "' must be a text that is not empty");
    return *value;
  }

  double number(const std::string& key) { return as_number(get(key), key); }

  double as_number(const toml::node& node, const std::string& key) const {
    const auto value = node.is_number() ? node.value<double>() : std::nullopt;
    if (!value || !std::isfinite(*value)) fail(node.source(), "'" + key + "' must be a finite number");
    return *value;
  }

  void check_no_other_keys() const {
    for (const auto& [key, node] : table_) {
      const std::string name(key.str());
      if (std::find(known_.begin(), known_.end(), name) == known_.end())
        fail(key.source(),
             name_ + " has no key '" + name + "'" + did_you_mean(name, known_) + ", expected " + join_or(known_));
    }
  }

  [[noreturn]] void fail(const toml::source_region& at, const std::string& message) const {
    const auto line = static_cast<int>(at.begin.line);
    throw InputError(path_, line, static_cast<int>(at.begin.column), message, source_line(text_, line));
  }

 private:
  const std::string& text_;
  const std::string& path_;
  const toml::table& table_;
  std::string name_;
  std::vector<std::string> known_;
};

class ExpectReader {
 public:
  explicit ExpectReader(const std::string& path) : path_(path), text_(read_file(path, kMaxBytes)) {}

  Expect run() {
    const toml::table root = parse();
    Table table(text_, path_, root, "expect.toml");
    Expect expect;
    if (table.find("title") != nullptr) expect.title = table.text("title");
    expect.purpose = table.text("purpose");
    expect.exposure = table.number("exposure");
    if (const toml::node* node = table.find("hdr_flip_exposures")) expect.hdr_exposures = exposures(table, *node);
    if (const toml::node* node = table.find("analytic")) expect.analytic = analytic(table, *node);
    if (const toml::node* node = table.find("unsupported")) expect.unsupported = unsupported(table, *node);
    if (const toml::node* node = table.find("tolerance")) expect.tolerances = tolerances(table, *node);
    if (const toml::node* node = table.find("povray")) expect.povray = povray(table, *node);
    if (const toml::node* node = table.find("cycles")) expect.cycles = cycles(table, *node);
    table.check_no_other_keys();
    return expect;
  }

 private:
  toml::table parse() const {
    try {
      return toml::parse(text_, path_);
    } catch (const toml::parse_error& error) {
      const auto at = error.source().begin;
      const auto line = static_cast<int>(at.line);
      throw InputError(path_, line, static_cast<int>(at.column), std::string(error.description()),
                       source_line(text_, line));
    }
  }

  static const toml::table& as_table(const Table& parent, const toml::node& node, const std::string& what) {
    if (!node.is_table()) parent.fail(node.source(), what + " must be a table");
    return *node.as_table();
  }

  static ExposureRange exposures(const Table& table, const toml::node& node) {
    const std::string key = "hdr_flip_exposures";
    const toml::array* list = node.as_array();
    if (!list || list->size() != 3) table.fail(node.source(), "'" + key + "' must be a list of start, stop and count");
    const auto count = list->get(2)->value_exact<std::int64_t>();
    if (!count) table.fail(list->get(2)->source(), "the count of '" + key + "' must be a whole number");
    const ExposureRange range{table.as_number(*list->get(0), key), table.as_number(*list->get(1), key),
                              static_cast<int>(std::clamp<std::int64_t>(*count, 0, 1 << 20))};
    if (!is_usable(range)) table.fail(node.source(), "'" + key + "': " + expected_exposures);
    return range;
  }

  Analytic analytic(const Table& parent, const toml::node& node) const {
    Table table(text_, path_, as_table(parent, node, "[analytic]"), "[analytic]");
    Analytic result;
    result.formula = table.text("formula");
    if (const toml::node* mean = table.find("mean")) {
      const toml::array* list = mean->as_array();
      if (!list || list->size() != 3) table.fail(mean->source(), "'mean' must be a list of three numbers");
      result.mean = RgbD(table.as_number(*list->get(0), "mean"), table.as_number(*list->get(1), "mean"),
                         table.as_number(*list->get(2), "mean"));
    }
    table.check_no_other_keys();
    return result;
  }

  static std::map<std::string, std::string> unsupported(const Table& parent, const toml::node& node) {
    std::map<std::string, std::string> reasons;
    const toml::table& table = as_table(parent, node, "[unsupported]");
    for (const auto& [engine, reason] : table)
      reasons[std::string(engine.str())] = parent.as_text(reason, std::string(engine.str()));
    return reasons;
  }

  PovrayResidual povray(const Table& parent, const toml::node& node) const {
    Table table(text_, path_, as_table(parent, node, "[povray]"), "[povray]");
    PovrayResidual result;
    result.quality = static_cast<int>(table.number("quality"));
    read_residual(table, result);
    if (!result.is_small() && !result.cause)
      table.fail(node.source(), "[povray] needs a 'cause': its mean is off by more than 0.5 % or its ssim below 0.98");
    return result;
  }

  CyclesResidual cycles(const Table& parent, const toml::node& node) const {
    Table table(text_, path_, as_table(parent, node, "[cycles]"), "[cycles]");
    CyclesResidual result;
    result.spp = static_cast<int>(table.number("spp"));
    result.noise_percent = table.number("noise_percent");
    read_residual(table, result);
    if (!result.is_small() && !result.cause)
      table.fail(node.source(),
                 "[cycles] needs a 'cause': its mean is off by more than 0.3 % and by more than three standard errors");
    return result;
  }

  PairsResidual pairs(const Table& parent, const toml::node& node) const {
    Table table(text_, path_, as_table(parent, node, "'pairs'"), "'pairs'");
    PairsResidual result;
    result.count = static_cast<int>(table.number("count"));
    result.mean_percent = table.number("mean_percent");
    result.noise_percent = table.number("noise_percent");
    table.check_no_other_keys();
    return result;
  }

  /// Fields that the residuals of all engines have.
  template <class Residual>
  void read_residual(Table& table, Residual& result) const {
    result.size = static_cast<int>(table.number("size"));
    result.mean_percent = table.number("mean_percent");
    result.relmse = table.number("relmse");
    result.ssim = table.number("ssim");
    result.seconds = table.number("seconds");
    if (const toml::node* node = table.find("pairs")) result.pairs = pairs(table, *node);
    if (table.find("cause")) result.cause = table.text("cause");
    table.check_no_other_keys();
  }

  std::vector<Tolerance> tolerances(const Table& parent, const toml::node& node) const {
    if (!node.is_array_of_tables()) parent.fail(node.source(), "[[tolerance]] must be a list of tables");
    std::vector<Tolerance> result;
    for (const toml::node& entry : *node.as_array()) {
      Table table(text_, path_, *entry.as_table(), "[[tolerance]]");
      Tolerance tolerance{table.text("engine"), table.text("metric"), table.number("value"), table.text("reason")};
      if (table.find("block")) tolerance.block = table.number("block");
      if (!(tolerance.value > 0)) table.fail(entry.source(), "'value' must be more than 0");
      if (tolerance.block && !(*tolerance.block > 0)) table.fail(entry.source(), "'block' must be more than 0");
      result.push_back(std::move(tolerance));
      table.check_no_other_keys();
    }
    return result;
  }

  const std::string& path_;
  std::string text_;
};

}  // namespace

Expect read_expect(const std::string& path) { return ExpectReader(path).run(); }

std::string expect_path_of(const std::string& scene_path) {
  return (std::filesystem::path(scene_path).parent_path() / "expect.toml").string();
}

}  // namespace photonproof::inline scenes_description
