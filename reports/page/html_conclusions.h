// The harness's conclusions as values for the page templates.
#pragma once

#include <kainjow/mustache.hpp>
#include <string>
#include <vector>

#include "reports/view/conclusions.h"
#include "reports/view/view.h"

namespace photonproof::reports::inline reports_page {

/// {verdict, class, symbol}: a chip that is readable without its colour.
void set_verdict(kainjow::mustache::data& object, GateVerdict verdict);

/// {has_correctness, verdict, class, symbol, sentence}: the same for a budget's images, green only for right.
void set_correctness(kainjow::mustache::data& object, const CorrectnessRecord& record);

/// {has_glance, glances: {swatch, text}}: verdicts of each engine over all scenes.
void set_glance(kainjow::mustache::data& page, const View& view);

/// {has_races, races_sentence, times, errors}: which engine is faster to the same error, and more exact in the same
/// time. The tables are {caption, at_head, at_title, has_rows, races, has_undecided, undecided}.
void set_races(kainjow::mustache::data& page, const View& view);

/// {has_table, header, rows: {cells: {text, number}}}: cells from `numbers_from` on are right-aligned.
kainjow::mustache::data table_data(const PlainTable& table, std::size_t numbers_from);

/// {has_gates, gate_header, gates}: each gate with its row and sentence, and with its command on request.
void set_gates(kainjow::mustache::data& object, const std::vector<const GateRecord*>& gates, bool with_commands);

/// {has_tiles, tiles}: all failing tiles, worst first, each with its scene and its place in the viewer.
void set_tiles(kainjow::mustache::data& page, const View& view);

/// {has_changes, changes}.
void set_changes(kainjow::mustache::data& page, const View& view);

/// The id of a scene's section: "scene-1".
std::string scene_id(const View& view, const std::string& scene);

}  // namespace photonproof::reports::inline reports_page
