#include "reports/formats/markdown_report.h"

#include <fmt/format.h>

#include <algorithm>

#include "reports/view/cell_details.h"
#include "reports/view/conclusions.h"
#include "reports/view/environment.h"
#include "reports/view/metric_columns.h"
#include "reports/view/numbers.h"
#include "reports/view/races.h"
#include "reports/view/text.h"
#include "reports/view/titles.h"
#include "reports/view/verdicts.h"
#include "reports/view/view.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline reports_formats {
using namespace reports;

namespace {

namespace fs = std::filesystem;
using Row = std::vector<std::string>;

/// Cells are Markdown already. `numbers_from` is the first right-aligned column.
std::string table(const Row& header, const std::vector<Row>& rows, std::size_t numbers_from) {
  const auto line = [](const Row& cells) {
    std::string text = "|";
    for (const std::string& cell : cells) text += " " + cell + " |";
    return text + "\n";
  };
  Row rule;
  for (std::size_t i = 0; i < header.size(); ++i) rule.push_back(i < numbers_from ? ":--" : "--:");
  std::string text = line(header) + line(rule);
  for (const Row& row : rows) text += line(row);
  return text + "\n";
}

/// A code block with a fence longer than any run of backticks inside it.
std::string code_block(const std::string& code) {
  std::size_t longest = 0, run = 0;
  for (const char c : code) {
    run = c == '`' ? run + 1 : 0;
    longest = std::max(longest, run);
  }
  const std::string fence(std::max<std::size_t>(3, longest + 1), '`');
  return fence + "sh\n" + printable(code) + "\n" + fence + "\n\n";
}

std::string seconds(const std::optional<double>& value) {
  return or_dash(value, [](double v) { return significant(v); });
}

std::string value_of(const Result& result, const std::string& name) {
  return or_dash(metric(result, name), [&](double v) { return format_metric(name, v); });
}

std::string cell_name(const Cell& cell) {
  return markdown_text(fmt::format("{}, {}, seed {}", cell.engine, budget_text(cell.budget), cell.seed));
}

class Writer {
 public:
  Writer(const Results& results, const fs::path& results_folder, const fs::path& out)
      : results_(results), view_(arrange(results)) {
    const fs::path from = fs::absolute(out).lexically_normal().parent_path();
    prefix_ = fs::absolute(results_folder).lexically_normal().lexically_relative(from);
  }

  std::string write() const {
    std::string text = header() + races() + at_a_glance() + gates() + changes() + summary() + failures();
    for (const SceneView& scene : view_.scenes) text += scene_section(scene);
    return text + notes() + "\n" + provenance();
  }

 private:
  /// The answers come first: the worst failing gate, how many pass, who is fastest.
  std::string header() const {
    std::string text = "# " + markdown_text(heading(results_)) + "\n\n";
    for (const std::string& answer : {failing_text(view_), verdicts_text(view_.gates), races_sentence(view_)})
      if (!answer.empty()) text += "**" + markdown_text(answer) + ".**\n\n";
    text += "photonproof report: " + totals_text(results_) + ".\n\n";
    for (const std::string& caveat : results_.caveats) text += "* Caveat: " + markdown_text(caveat) + "\n";
    return text + (results_.caveats.empty() ? "" : "\n");
  }

  std::string provenance() const {
    std::string text = "## How it was made\n\n";
    text += "* Made: " + markdown_text(time_text(results_.created)) + "\n";
    text += "* Host: " + markdown_text(host_text(results_.host)) + "\n";
    text += "* Versions: " + markdown_text(versions_text(results_.versions)) + "\n";
    text += "\n";
    text += "Repeat with\n\n" + code_block(results_.command);
    std::vector<Row> rows;
    for (const EngineRecord& engine : view_.engines) {
      rows.push_back({markdown_text(engine.name), markdown_text(engine.title), markdown_text(engine.version)});
    }
    return text + table({"Engine", "Name", "Version"}, rows, 3);
  }

  static std::string plain_table(const PlainTable& plain, std::size_t numbers_from) {
    if (plain.rows.empty()) return {};
    std::vector<Row> rows;
    for (const Row& cells : plain.rows) {
      Row& row = rows.emplace_back();
      for (const std::string& cell : cells) row.push_back(markdown_text(cell));
    }
    return table(plain.header, rows, numbers_from);
  }

  std::string gates() const {
    if (view_.gates.empty()) return {};
    std::string text = "## Gates\n\n" + verdicts_text(view_.gates) + ".\n\n" + plain_table(gates_table(view_.gates), 4);
    for (const GateRecord* gate : view_.gates) {
      text += "* " + to_string(gate->verdict) + ": " + markdown_text(gate->name) + ": " +
              markdown_text(gate->sentence) + "\n";
      if (!gate->command.empty()) text += "    * repeat with: " + markdown_text(gate->command) + "\n";
    }
    text += "\n";
    if (view_.tiles.empty()) return text;
    text += "Failing tiles, worst first:\n\n";
    for (const RankedTile& ranked : view_.tiles) {
      const FailingTile& tile = *ranked.tile;
      text += fmt::format("1. {}: {} (at {}, {}; {} × {} pixels{})\n", markdown_text(ranked.gate->name),
                          markdown_text(tile.sentence), tile.x, tile.y, tile.width, tile.height,
                          beyond_noise(*ranked.gate, tile));
    }
    return text + "\n";
  }

  std::string at_a_glance() const {
    const std::vector<EngineGlance> engines = glances(view_);
    if (engines.empty()) return {};
    std::string text = "## At a glance\n\n";
    for (const EngineGlance& glance : engines)
      text += "* " + markdown_text(view_.engines[glance.engine].name) + ": " + markdown_text(glance.text) + "\n";
    return text + "\n";
  }

  static std::string race_rows(const RaceTable& races, const std::string& at) {
    if (races.rows.empty()) return {};
    Row head{"Scene", at};
    for (const std::string& engine : races.engines) head.push_back(markdown_text(engine));
    std::vector<Row> rows;
    for (const RaceTable::Row& race : races.rows) {
      Row& row = rows.emplace_back(Row{markdown_text(race.scene), race.undecided.empty() ? race.at : undefined_number});
      for (const RaceTable::Cell& cell : race.cells) {
        const std::string text = cell.value + (cell.ratio.empty() ? "" : " (" + cell.ratio + ")");
        row.push_back(cell.best ? "**" + text + "**" : text);
      }
    }
    return table(head, rows, 1);
  }

  std::string races() const {
    if (view_.races.empty()) return {};
    std::string text = "## Fastest to the same error\n\n" + race_rows(race_table(view_), "relMSE");
    for (const RaceRecord* race : view_.races) text += "* " + markdown_text(race_text(*race)) + ".\n";
    const std::string errors = race_rows(error_table(view_), "Time");
    return text + "\n" + (errors.empty() ? "" : "Error (relMSE) in the same time:\n\n" + errors);
  }

  std::string changes() const {
    if (view_.changes.empty()) return {};
    return "## Against the older run\n\n" + plain_table(changes_table(view_.changes), 8);
  }

  static std::string convergence(const SceneView& scene) {
    std::string text =
        plain_table(slopes_table(scene.curves), 1) + plain_table(points_table(scene.curves, doubt_mark(scene)), 1);
    for (const Convergence* curve : scene.curves)
      for (const ConvergencePoint& point : curve->points)
        if (point.correctness)
          text += "* " +
                  markdown_text(curve->engine + ", " + budget_text(point.budget) + ": " +
                                to_string(point.correctness->verdict) + ": " + sentence_of(*point.correctness)) +
                  "\n";
    for (const Convergence* curve : scene.curves) {
      for (const std::string& caveat : curve->caveats) {
        text += "* " + markdown_text(curve->engine) + ": " + markdown_text(caveat) + "\n";
      }
    }
    return text.empty() ? text : "Error against time, with 95 % intervals:\n\n" + text + "\n";
  }

  std::string summary() const {
    if (view_.compared.empty() && !view_.gates.empty()) return {};
    Row head{"Scene", "Reference"};
    for (const std::size_t engine : view_.compared) head.push_back(markdown_text(view_.engines[engine].name));
    std::vector<Row> rows;
    for (const SceneView& scene : view_.scenes) {
      Row& row = rows.emplace_back(Row{markdown_text(scene.record.name)});
      row.push_back(markdown_text(reference_text(scene)));
      for (const EngineOutcome& outcome : scene.engines) {
        std::string shown;
        if (outcome.shown) {
          const std::string mark = doubt_mark(scene);
          if (const CorrectnessRecord* verdict = correctness_of(scene, outcome.shown->cell))
            shown = "**" + markdown_text(verdict_text(*verdict)) + "**; ";
          shown += fmt::format("relMSE {}{}, SSIM {}{}, {} s; ", value_of(*outcome.shown, "relmse"), mark,
                               value_of(*outcome.shown, "ssim"), mark, seconds(outcome.shown->wall_seconds));
        }
        row.push_back(shown + state_text(outcome));
      }
    }
    std::string doubts;
    for (const SceneView& scene : view_.scenes)
      if (const std::string doubt = doubt_text(scene); !doubt.empty())
        doubts += markdown_text(scene.record.name + ": " + doubt) + "\n\n";
    return "## Summary\n\nErrors are measured against the reference of each scene. A cell shows the largest budget its "
           "engine finished, first seed.\n\n" +
           table(head, rows, head.size()) + doubts;
  }

  std::string failures() const {
    if (view_.failures.empty()) return {};
    std::string text = "## What did not finish\n\n";
    for (const Failure& failure : view_.failures) {
      const Result& first = *failure.cells.front();
      text += fmt::format("* {}: {}, {}, {}: {}\n", to_string(first.status), markdown_text(first.cell.scene),
                          markdown_text(first.cell.engine), markdown_text(failed_cells_text(failure)),
                          markdown_text(first.detail));
    }
    return text + "\n";
  }

  std::string scene_section(const SceneView& scene) const {
    std::string text = "## Scene " + markdown_text(scene.record.name) + "\n\n";
    if (!scene.record.purpose.empty()) text += "Purpose: " + markdown_text(scene.record.purpose) + "\n\n";
    if (scene.record.width > 0) text += fmt::format("{} × {} pixels, ", scene.record.width, scene.record.height);
    text += "all pictures at " + exposure_text(scene.record.exposure) + ".\n\n";
    if (!scene.reference_problem.empty()) text += "**" + markdown_text(scene.reference_problem) + "**\n\n";
    if (const std::string doubt = doubt_text(scene); !doubt.empty()) text += "**" + markdown_text(doubt) + "**\n\n";
    return text + gallery(scene) + convergence(scene) + measurements(scene) + details(scene);
  }

  std::string picture(const std::string& file, const std::string& alt) const {
    if (file.empty()) return undefined_number;
    return "![" + markdown_text(alt) + "](" + url_path((prefix_ / file).lexically_normal().generic_string()) + ")";
  }

  std::string gallery(const SceneView& scene) const {
    Row head{""}, images{"image"}, flips{"FLIP"}, errors{"relative error"}, captions{""};
    const auto add = [&](const std::string& title, const std::string& caption,
                         const std::map<std::string, std::string>& pictures, const std::string& what) {
      const auto file = [&](const char* role) { return picture_file(pictures, role); };
      head.push_back(markdown_text(title));
      captions.push_back(markdown_text(caption));
      images.push_back(picture(file("image"), what));
      flips.push_back(picture(file("flip"), "FLIP map of " + what));
      errors.push_back(picture(file("error"), "relative error map of " + what));
    };
    if (has_reference(scene)) {
      add("reference", reference_caption(scene), {{"image", reference_picture(scene)}},
          "reference of " + scene.record.name);
      flips.back() = errors.back() = "";
    }
    for (const EngineOutcome& outcome : scene.engines) {
      if (!outcome.shown) continue;
      const Result& shown = *outcome.shown;
      add(shown.cell.engine, budget_text(shown.cell.budget) + ", " + seconds(shown.wall_seconds) + " s", shown.pictures,
          scene.record.name + " by " + shown.cell.engine);
    }
    for (const GateRecord* gate : scene.gates) {
      if (gate->pictures.empty()) continue;
      add(gate->name, to_string(gate->verdict) + ", " + gate->engine, gate->pictures,
          scene.record.name + " by " + gate->engine + " for gate " + gate->name);
    }
    if (head.size() == 1) return {};
    return table(head, {images, captions, flips, errors}, head.size());
  }

  std::string measurements(const SceneView& scene) const {
    Row head{"Engine", "Status", "Budget", "Seed"};
    for (const MetricColumn& column : metric_columns()) head.push_back(column.title);
    head.insert(head.end(), {"wall s", "CPU s", "peak MB"});
    std::vector<Row> rows;
    std::string remarks;
    const auto add = [&](const Result& result, const char* suffix) {
      const Cell& cell = result.cell;
      Row& row = rows.emplace_back(Row{markdown_text(cell.engine) + suffix, status_text(result.status),
                                       markdown_text(budget_text(cell.budget)), std::to_string(cell.seed)});
      for (const MetricColumn& column : metric_columns())
        row.push_back(value_of(result, column.metric) + doubt_mark(scene));
      row.push_back(seconds(result.wall_seconds));
      row.push_back(seconds(result.cpu_seconds));
      row.push_back(or_dash(result.peak_bytes, megabytes));
      for (const std::string& remark : {reason_text(result), caveats_text(result)}) {
        if (!remark.empty()) remarks += "* " + cell_name(cell) + ": " + markdown_text(remark) + "\n";
      }
    };
    if (scene.reference) add(*scene.reference, " (reference)");
    for (const EngineOutcome& outcome : scene.engines) {
      for (const Result* cell : outcome.cells) add(*cell, "");
    }
    if (rows.empty()) return scene.gates.empty() ? "Nothing was measured.\n\n" : "";
    for (const MetricParameters& entry : scene.parameters) {
      remarks += "* " + markdown_text(entry.metric) + " is computed with " + markdown_text(entry.parameters) + "\n";
    }
    return table(head, rows, 2) + (remarks.empty() ? "" : remarks + "\n");
  }

  std::string details(const SceneView& scene) const {
    std::string text;
    const auto add = [&](const Result& result) {
      text += "* " + cell_name(result.cell) + "\n";
      for (const Detail& detail : cell_details(result)) {
        for (const std::string& line : detail.texts) {
          text += "    * " + detail.term + ": " + markdown_text(line) + "\n";
        }
      }
      if (!result.command.empty()) text += "    * command: " + markdown_text(result.command) + "\n";
    };
    if (scene.reference) add(*scene.reference);
    for (const EngineOutcome& outcome : scene.engines) {
      for (const Result* cell : outcome.cells) add(*cell);
    }
    for (const GateRecord* gate : scene.gates) {
      for (const std::string& skip : gate->skipped) {
        text += "* " + markdown_text(gate->name) + ", skipped: " + markdown_text(skip) + "\n";
      }
    }
    if (text.empty()) return {};
    return "<details><summary>Phases, counts, skipped passes and commands</summary>\n\n" + text + "\n</details>\n\n";
  }

  std::string notes() const {
    std::string text = "## Reading the numbers\n\n";
    std::vector<MetricParameters> others = view_.parameters;
    for (const MetricColumn& column : metric_columns()) {
      text += std::string("* ") + column.title + ": " + column.meaning;
      const auto own = std::ranges::find(others, column.metric, &MetricParameters::metric);
      if (own != others.end()) {
        text += " (" + markdown_text(own->parameters) + ")";
        others.erase(own);
      }
      text += "\n";
    }
    for (const MetricParameters& entry : merged(others)) {
      text += "* " + markdown_text(entry.metric) + ": " + markdown_text(entry.parameters) + "\n";
    }
    return text +
           "* wall s and CPU s are of the engine's process with everything it starts, peak MB its largest resident "
           "memory in 10⁶ bytes\n* – is not defined or not measured\n";
  }

  const Results& results_;
  View view_;
  fs::path prefix_;  ///< from the report's folder to the results
};

}  // namespace

void write_markdown_report(const Results& results, const fs::path& results_folder, const fs::path& out) {
  write_file_atomically(out, Writer(titled(results), results_folder, out).write());
}

}  // namespace photonproof::inline reports_formats
