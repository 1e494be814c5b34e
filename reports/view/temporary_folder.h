// Where reports put the files of the programs they run.
#pragma once

#include "scenes/files/scratch_folder.h"

namespace photonproof::reports::inline reports_view {

class TemporaryFolder : public ScratchFolder {
 public:
  TemporaryFolder() : ScratchFolder("report") {}
};

}  // namespace photonproof::reports::inline reports_view
