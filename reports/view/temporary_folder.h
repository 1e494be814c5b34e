// The folder for files of the programs that reports run.
#pragma once

#include "scenes/files/scratch_folder.h"

namespace photonproof::reports::inline reports_view {

class TemporaryFolder : public ScratchFolder {
 public:
  TemporaryFolder() : ScratchFolder("report") {}
};

}  // namespace photonproof::reports::inline reports_view
