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

/// Whether an engine is faster than all others whose rank is known, beyond chance.
bool has_winner(const RaceRecord& race);

/// "photonmapper: 6.2 to 8.8 times less": its error in the time of one image, beside the next engine's. Empty where
/// none leads beyond noise.
std::string error_lead_text(const RaceRecord& race);

/// A sentence over all scenes: "photonmapper is fastest to the same error on 5 of 7 scenes, 2.1 to 31 times sooner than
/// the next; 1 not judged". Ties count as "1 without a winner". A winner that is not right on all has one more: "Where
/// pm wins, it is right on 2, biased on 3 by up to 1.9 % of a block's light". Empty without races.
std::string races_sentence(const View& view);

/// Results of races: a row for each race, a column for each engine.
struct RaceTable {
  struct Cell {
    std::string value;      ///< "0.31 s", "> 9 s" or an error. The dash stands for an engine without a known one.
    std::string ratio;      ///< "3.2 to 4.1 times" or "at least 70 times". Empty for the first, and without a rank.
    bool best = false;      ///< Set for the winner.
    bool at_least = false;  ///< The ratio is a bound: one of the ends of intervals.
  };
  struct Row {
    std::string scene;
    std::string at;  ///< the error or the time at which engines are compared
    std::vector<Cell> cells;
    std::string undecided;  ///< the reason, instead of cells
    std::string lead{};     ///< of errors in the same time, see error_lead_text
  };
  std::vector<std::string> engines;  ///< by name, in the order of the view
  std::vector<Row> rows;
};

/// Times to an equal error.
RaceTable race_table(const View& view);

/// Errors in an equal time, of the scenes where two engines have a budget around one time.
RaceTable error_table(const View& view);

}  // namespace photonproof::reports::inline reports_view
