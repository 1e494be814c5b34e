// Which engine is faster to the same error, by how much, and how sure: sentences and a table, the same in every format.
#pragma once

#include <string>
#include <vector>

#include "reports/view/view.h"

namespace photonproof::reports::inline reports_view {

/// "25 to 31 times", "about 28 times" without an interval, "at least 28 times" for a bound.
std::string times_text(const Estimate& ratio, bool at_least = false);

/// "photonmapper reaches relMSE 0.0010 on cornell 25 to 31 times sooner than path, at least 70 times sooner than
/// povray". Ties and engines without a rank are told as such, and scenes without a judgement with the reason.
std::string race_text(const RaceRecord& race);

/// "In 0.5 s the error of path is 8 to 11 times photonmapper's"; empty where the errors at one time are unknown.
std::string equal_time_text(const RaceRecord& race);

/// Whether an engine is faster than all others whose rank is known, beyond chance.
bool has_winner(const RaceRecord& race);

/// One sentence over all scenes, empty without races: "photonmapper is fastest to the same error on 5 of 7 scenes,
/// 2.1 to 31 times sooner than the next; 2 undecided".
std::string races_sentence(const View& view);

/// Times to an equal error: a row for each race, a column for each engine.
struct RaceTable {
  struct Cell {
    std::string time;   ///< "0.31 s" or "> 9 s". The dash stands for an engine without a known error.
    std::string ratio;  ///< "3.2 to 4.1 times" or "at least 70 times". Empty for the first, and without a rank.
    bool best = false;  ///< Set for the winner.
  };
  struct Row {
    std::string scene, relmse;
    std::vector<Cell> cells;
    std::string undecided;  ///< the reason, instead of cells
  };
  std::vector<std::string> engines;  ///< by name, in the order of the view
  std::vector<Row> rows;
};
RaceTable race_table(const View& view);

}  // namespace photonproof::reports::inline reports_view
