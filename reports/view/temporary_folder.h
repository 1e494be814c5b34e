// Where reports put the files of the programs they run.
#pragma once

#include "scenes/text/scratch_folder.h"

namespace photonproof::reports {

class TemporaryFolder : public ScratchFolder {
 public:
  TemporaryFolder() : ScratchFolder("report") {}
};

}  // namespace photonproof::reports
