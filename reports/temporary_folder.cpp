#include "reports/temporary_folder.h"

#include <cstdlib>
#include <string>
#include <system_error>

#include "scenes/input_error.h"

namespace photonproof::reports {

TemporaryFolder::TemporaryFolder() {
  std::error_code error;
  const std::filesystem::path parent = std::filesystem::temp_directory_path(error);
  std::string name = ((error ? std::filesystem::path("/tmp") : parent) / "photonproof-report-XXXXXX").string();
  if (!mkdtemp(name.data())) throw InputError(name, "cannot create a folder for temporary files");
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;  // a leftover in the temporary folder is no reason to fail
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace photonproof::reports
