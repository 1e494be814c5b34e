// Where reports put the files of the programs they run.
#pragma once

#include "scenes/temporary_folder.h"

namespace photonproof::reports {

class TemporaryFolder : public photonproof::TemporaryFolder {
 public:
  TemporaryFolder() : photonproof::TemporaryFolder("report") {}
};

}  // namespace photonproof::reports
