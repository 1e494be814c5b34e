// Titles of scenes and engines in place of their names, for pages that people read.
#pragma once

#include <string>
#include <vector>

#include "reports/record/results.h"

namespace photonproof::reports::inline reports_view {

/// The engine's title without this program's own name in front, or its name where the record has no title.
std::string engine_title(const EngineRecord& engine);

/// The record with titles in the place of names: of scenes and engines, in every cell, race, curve, gate and change. An
/// engine's `title` then holds its name, where the two differ. Two scenes or engines of one title keep their names.
/// Commands, paths and sentences stay as they are.
Results titled(Results results);

}  // namespace photonproof::reports::inline reports_view
