// One number per row, so that a row always means the same, and a spreadsheet or data frame can pivot it. The columns:
//   record    cell, curve, race, gate or change
//   name      of a gate; of a race the error or the time at which engines are compared
//   quantity  a metric, wall_seconds, relmse, observed, ratio ...
//   value     in full; low and high are the ends of its 95 % interval, empty when none is known
//   outcome   how a cell ended, a gate's verdict, a budget's (right, noisy, biased, unknown), a change's kind
//   text      the reason, in a sentence
// A cell that did not finish is one row without a value.
#include <fmt/format.h>

#include "reports/formats/exchange_reports.h"
#include "reports/view/text.h"
#include "reports/view/view.h"
#include "scenes/files/atomic_file.h"

namespace photonproof::inline reports_formats {
using namespace reports;

namespace {

struct Subject {
  std::string record, name, scene, engine, budget_kind, budget, seed, outcome, text;
};

class Table {
 public:
  Table() : text_("record,name,scene,engine,budget_kind,budget,seed,quantity,value,low,high,outcome,text\r\n") {}

  void add(const Subject& s, const std::string& quantity, const std::optional<Estimate>& estimate) {
    const auto number = [](double value) { return fmt::format("{}", value); };
    const bool bounded = estimate && estimate->interval;
    std::string row;
    for (const std::string& cell :
         {csv_cell(s.record), csv_cell(s.name), csv_cell(s.scene), csv_cell(s.engine), csv_cell(s.budget_kind),
          s.budget, s.seed, csv_cell(quantity), estimate ? number(estimate->value) : "",
          bounded ? number(estimate->interval->low) : "", bounded ? number(estimate->interval->high) : "",
          csv_cell(s.outcome), csv_cell(s.text)}) {
      row += (row.empty() ? "" : ",") + cell;
    }
    text_ += row + "\r\n";
  }
  void add_if(const Subject& subject, const std::string& quantity, const std::optional<Estimate>& estimate) {
    if (estimate) add(subject, quantity, estimate);
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

template <class T>
std::optional<Estimate> estimate(const std::optional<T>& value) {
  return value ? std::optional(Estimate{static_cast<double>(*value), {}}) : std::nullopt;
}

void add_cell_rows(Table& table, const Result& result) {
  const Cell& cell = result.cell;
  const Subject subject{"cell",
                        "",
                        cell.scene,
                        cell.engine,
                        cell.budget.kind,
                        cell.budget.amount_text(),
                        std::to_string(cell.seed),
                        to_string(result.status),
                        result.detail};
  if (result.status != Status::ok) return table.add(subject, "", std::nullopt);
  for (const MetricValue& metric : result.metrics) table.add(subject, metric.name, Estimate{metric.value, {}});
  table.add_if(subject, "wall_seconds", estimate(result.wall_seconds));
  table.add_if(subject, "cpu_seconds", estimate(result.cpu_seconds));
  table.add_if(subject, "peak_bytes", estimate(result.peak_bytes));
  table.add_if(subject, "instructions", estimate(result.instructions));
}

/// Adds the estimate; without one, an empty value with the reason as its text if there is a reason.
void add_or_why(Table& table, Subject subject, const std::string& quantity, const std::optional<Estimate>& estimate,
                const Reasons& undefined) {
  const auto why = undefined.find(quantity);
  if (!estimate && why == undefined.end()) return;
  if (!estimate) subject.text = why->second;
  table.add(subject, quantity, estimate);
}

/// The target is named by its error, as "relmse=0.001". If only a bound on the time is known, the reason gives it.
void add_target(Table& table, Subject subject, const TargetTime& target) {
  subject.name = fmt::format("relmse={}", target.relmse);
  if (target.more_than)
    subject.text = fmt::format("more than {}: the largest budget's error is above", *target.more_than);
  if (target.at_most) subject.text = fmt::format("at most {}: the smallest budget's error is below", *target.at_most);
  if (!target.undefined.empty()) subject.text = target.undefined;
  table.add(subject, "seconds_to_target", target.seconds);
}

void add_curve_rows(Table& table, const Convergence& curve) {
  Subject subject{"curve", "", curve.scene, curve.engine, "", "", "", "", ""};
  for (const ConvergencePoint& point : curve.points) {
    subject.budget_kind = point.budget.kind;
    subject.budget = point.budget.amount_text();
    table.add(subject, "seconds", point.seconds);
    table.add_if(subject, "relmse", point.relmse);
    add_or_why(table, subject, "bias2", point.bias2, point.undefined);
    add_or_why(table, subject, "variance", point.variance, point.undefined);
    if (const auto& correctness = point.correctness) {
      Subject verdict = subject;
      verdict.outcome = to_string(correctness->verdict);
      verdict.text = correctness->sentence;
      table.add(verdict, "relative_error_of_mean", correctness->whole);
    }
  }
  subject.budget_kind = subject.budget = "";
  add_or_why(table, subject, "slope", curve.slope, curve.undefined);
  add_or_why(table, subject, "efficiency", curve.efficiency, curve.undefined);
  for (const TargetTime& target : curve.targets) add_target(table, subject, target);
}

/// Times and errors of the engines, and their ratios to the best one's. A ratio's lower bound has the outcome
/// "at_least".
void add_race_rows(Table& table, const RaceRecord& race) {
  Subject subject{"race", fmt::format("relmse={}", race.relmse), race.scene, "", "", "", "", "", race.undecided};
  if (race.times.empty()) return table.add(subject, "", std::nullopt);
  for (const RaceRecord::Time& time : race.times) {
    subject.engine = time.engine;
    subject.outcome = time.at_most ? "at_most" : time.more_than ? "more_than" : "";
    table.add(subject, "seconds_to_error", Estimate{time.seconds, time.interval});
    subject.outcome = time.at_least ? "at_least" : "";
    table.add_if(subject, "ratio_of_seconds", time.ratio);
  }
  subject.name = fmt::format("seconds={}", race.seconds);
  subject.outcome = "";
  for (const RaceRecord::Error& error : race.errors) {
    subject.engine = error.engine;
    table.add(subject, "relmse_at_time", error.relmse);
    table.add_if(subject, "ratio_of_relmse", error.ratio);
  }
}

void add_gate_rows(Table& table, const GateRecord& gate) {
  const Subject subject{"gate", gate.name, gate.scene, gate.engine, "", "", "", to_string(gate.verdict), gate.sentence};
  table.add(subject, gate.metric, gate.observed);
  table.add_if(subject, "bound", estimate(gate.bound));
  table.add(subject, "seconds", Estimate{gate.seconds, {}});
  table.add(subject, "samples", Estimate{static_cast<double>(gate.samples), {}});
}

}  // namespace

void write_csv_report(const Results& results, const std::filesystem::path&, const std::filesystem::path& out) {
  Table table;
  for (const Result& result : results.results) add_cell_rows(table, result);
  for (const Convergence& curve : results.convergence) add_curve_rows(table, curve);
  for (const RaceRecord& race : results.races) add_race_rows(table, race);
  for (const GateRecord& gate : results.gates) add_gate_rows(table, gate);
  for (const ChangeRecord& change : results.changes) {
    table.add({"change", "", change.scene, change.engine, change.budget.kind, change.budget.amount_text(), "",
               to_string(change.change), change.sentence},
              change.quantity + " ratio", change.ratio);
  }
  write_file_atomically(out, table.text());
}

}  // namespace photonproof::inline reports_formats
