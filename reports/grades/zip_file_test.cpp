#include "reports/grades/zip_file.h"

#include "scenes/base/process.h"
#include "scenes/files/test_folder.h"

namespace photonproof::inline reports_grades {
namespace {

class ZipFile : public FolderTest {};

TEST_F(ZipFile, python_reads_back_names_contents_and_permissions) {
  const std::string long_text(100'000, 'x');
  put("a.zip", zip_bytes({{"bin/run", "#!/bin/sh\n", true}, {"empty", "", false}, {"d/long", long_text, false}}));
  const ProcessOutcome outcome =
      run_process({"python3", "-c",
                   "import sys,zipfile\nz=zipfile.ZipFile(sys.argv[1])\nprint(z.testzip())\nfor i in z.infolist():\n "
                   "print(i.filename,oct(i.external_attr>>16),i.file_size,len(z.read(i)))",
                   (folder_ / "a.zip").string()});
  EXPECT_EQ(outcome.standard_output,
            "None\nbin/run 0o100755 10 10\nempty 0o100644 0 0\nd/long 0o100644 100000 100000\n")
      << outcome.standard_error;
}

TEST_F(ZipFile, the_same_members_are_the_same_bytes) {
  EXPECT_EQ(zip_bytes({{"a", "b", false}}), zip_bytes({{"a", "b", false}}));
}

}  // namespace
}  // namespace photonproof::inline reports_grades
