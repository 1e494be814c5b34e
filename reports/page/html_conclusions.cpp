#include "reports/page/html_conclusions.h"

#include <fmt/format.h>

#include <algorithm>

#include "reports/page/html_data.h"
#include "reports/page/viewer_data.h"
#include "reports/view/numbers.h"
#include "reports/view/races.h"
#include "reports/view/text.h"
#include "reports/view/verdicts.h"

namespace photonproof::reports::inline reports_page {
namespace {

using kainjow::mustache::data;

struct Look {
  const char* style;
  const char* symbol;
};

Look look_of(GateVerdict verdict) {
  if (verdict == GateVerdict::pass) return {"good", "✓"};
  return verdict == GateVerdict::fail ? Look{"poor", "✕"} : Look{"open", "?"};
}

Look look_of(Change change) {
  switch (change) {
    case Change::regression:
      return {"poor", "▲"};
    case Change::improvement:
      return {"good", "▼"};
    case Change::inconclusive:
      return {"open", "?"};
    case Change::unchanged:
      break;
  }
  return {"same", "="};
}

template <class Outcome>
void set_chip(data& object, Outcome outcome) {
  const Look look = look_of(outcome);
  object.set("verdict", to_string(outcome));
  object.set("class", look.style);
  object.set("symbol", look.symbol);
}

/// The cells of a row after the first `from`, numbers from `numbers_from` on.
data cells_data(const std::vector<std::string>& row, std::size_t from, std::size_t numbers_from) {
  data cells(data::type::list);
  for (std::size_t i = from; i < row.size(); ++i) {
    data cell;
    cell.set("text", printable(row[i]));
    cell.set("number", i >= numbers_from);
    cells.push_back(cell);
  }
  return cells;
}

data header_data(const PlainTable& table, std::size_t from, std::size_t numbers_from) {
  return cells_data(table.header, from, numbers_from);
}

}  // namespace

void set_verdict(data& object, GateVerdict verdict) { set_chip(object, verdict); }

void set_correctness(data& object, const CorrectnessRecord& record) {
  data chip;
  chip.set("verdict", verdict_text(record));
  chip.set("class", verdict_class(record));
  chip.set("symbol", verdict_symbol(record.verdict));
  object.set("has_correctness", true);
  object.set("chip", chip);
  object.set("sentence", printable(sentence_of(record)));
}

namespace {

data race_data(const View& view, const RaceTable::Row& row, const std::vector<std::string>& engines) {
  data item, cells(data::type::list);
  for (std::size_t i = 0; i < row.cells.size(); ++i) {
    const RaceTable::Cell& cell = row.cells[i];
    data entry;
    entry.set("engine", printable(engines[i]));
    entry.set("value", cell.value);
    entry.set("ratio", text_or_false(cell.ratio));
    entry.set("best", cell.best);
    entry.set("none", cell.value == undefined_number);
    entry.set("bound", cell.at_least
                           ? data("a bound: the least time that " + printable(engines[i]) +
                                  " may need, over the most that the fastest may need (ends of 95 % intervals)")
                           : data(false));
    cells.push_back(entry);
  }
  item.set("scene", printable(row.scene));
  item.set("href", scene_id(view, row.scene));
  item.set("at", row.at);
  item.set("reason", printable(row.undecided));
  item.set("lead", row.lead.empty() ? undefined_number : printable(row.lead));
  item.set("cells", cells);
  return item;
}

struct RaceHead {
  std::string caption;
  const char *at, *title;
};

data race_table_data(const View& view, const RaceTable& table, const RaceHead& head) {
  data races(data::type::list), undecided(data::type::list), item;
  for (const RaceTable::Row& row : table.rows)
    (row.undecided.empty() ? races : undecided).push_back(race_data(view, row, table.engines));
  item.set("caption", head.caption);
  item.set("at_head", head.at);
  item.set("at_title", head.title);
  item.set("has_rows", races.is_non_empty_list());
  item.set("has_leads", std::ranges::any_of(table.rows, [](const RaceTable::Row& row) { return !row.lead.empty(); }));
  item.set("races", races);
  item.set("has_undecided", undecided.is_non_empty_list());
  item.set("undecided", undecided);
  return item;
}

}  // namespace

void set_races(data& page, const View& view) {
  page.set("has_races", !view.races.empty());
  page.set("races_sentence", printable(races_sentence(view)));
  const std::string clock = capitalised(clock_text(clock_of(view)));
  page.set(
      "times",
      race_table_data(
          view, race_table(view),
          {clock + " to the same error, and how many times as long as the fastest: 95 % intervals. “At least”: only a "
                   "bound is known.",
           "relMSE", "relative mean squared error"}));
  page.set("errors", race_table_data(view, error_table(view),
                                     {"Error (relMSE) in the same time. Ratios to the least: 95 % intervals.", "time",
                                      "time of one image"}));
}

void set_glance(data& page, const View& view) {
  data engines(data::type::list);
  for (const EngineGlance& glance : glances(view)) {
    data item = engine_data(view, glance.engine);
    item.set("text", printable(glance.text));
    engines.push_back(item);
  }
  page.set("has_glance", engines.is_non_empty_list());
  data words(data::type::list);
  const std::span<const VerdictWord> all = verdict_words();
  for (const VerdictWord& word : all) {
    data item;
    item.set("word", word.word);
    item.set("short", word.brief);
    item.set("meaning", word.meaning);
    item.set("more", &word != &all.back());
    words.push_back(item);
  }
  page.set("glance_words", words);
  page.set("glances", engines);
}

data table_data(const PlainTable& table, std::size_t numbers_from) {
  data out, rows(data::type::list);
  for (const std::vector<std::string>& row : table.rows) {
    data item;
    item.set("cells", cells_data(row, 0, numbers_from));
    rows.push_back(item);
  }
  out.set("has_table", !table.rows.empty());
  out.set("header", header_data(table, 0, numbers_from));
  out.set("rows", rows);
  return out;
}

void set_gates(data& object, const std::vector<const GateRecord*>& gates, bool with_commands) {
  constexpr std::size_t numbers_from = 4;
  const PlainTable table = gates_table(gates);
  data rows(data::type::list);
  for (std::size_t i = 0; i < gates.size(); ++i) {
    data row;
    set_verdict(row, gates[i]->verdict);
    row.set("cells", cells_data(table.rows[i], 1, numbers_from));
    row.set("sentence", text_or_false(gates[i]->sentence));
    row.set("command", with_commands ? text_or_false(gates[i]->command) : data(false));
    row.set("width_of_table", std::to_string(table.header.size()));
    rows.push_back(row);
  }
  object.set("has_gates", !gates.empty());
  object.set("gate_header", header_data(table, 1, numbers_from));
  object.set("gates", rows);
}

void set_tiles(data& page, const View& view) {
  data tiles(data::type::list);
  for (const RankedTile& ranked : view.tiles) {
    const FailingTile& tile = *ranked.tile;
    const auto scene =
        std::ranges::find(view.scenes, ranked.gate->scene, [](const SceneView& s) { return s.record.name; });
    const std::vector<RankedTile> own = scene_tiles(*scene);
    const auto place = std::ranges::find(own, ranked.tile, &RankedTile::tile) - own.begin();
    data item;
    item.set("href", scene_id(view, ranked.gate->scene));
    item.set("place", std::to_string(place));
    item.set("scene", printable(ranked.gate->scene));
    item.set("gate", printable(ranked.gate->name));
    item.set("sentence", printable(tile.sentence));
    item.set("where", fmt::format("{} × {} pixels at ({}, {})", tile.width, tile.height, tile.x, tile.y));
    item.set("beyond_noise", beyond_noise(*ranked.gate, tile));
    tiles.push_back(item);
  }
  page.set("has_tiles", !view.tiles.empty());
  page.set("tiles", tiles);
}

void set_changes(data& page, const View& view) {
  constexpr std::size_t numbers_from = 5;
  const PlainTable table = changes_table(view.changes);
  data rows(data::type::list);
  for (std::size_t i = 0; i < view.changes.size(); ++i) {
    data row;
    set_chip(row, view.changes[i]->change);
    std::vector<std::string> cells = table.rows[i];
    const std::string sentence = cells.back();
    cells.pop_back();
    row.set("cells", cells_data(cells, 1, numbers_from));
    row.set("sentence", printable(sentence));
    rows.push_back(row);
  }
  std::vector<std::string> header = table.header;
  header.pop_back();
  page.set("has_changes", !view.changes.empty());
  page.set("change_header", cells_data(header, 1, numbers_from));
  page.set("changes", rows);
}

std::string scene_id(const View& view, const std::string& scene) {
  const auto found = std::ranges::find(view.scenes, scene, [](const SceneView& s) { return s.record.name; });
  return "scene-" + std::to_string(found - view.scenes.begin() + 1);
}

}  // namespace photonproof::reports::inline reports_page
