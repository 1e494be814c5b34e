#include "harness/stress/faults/fault_rows.h"

namespace photonproof::inline harness_stress_faults {

const std::vector<FaultRow>& fault_rows() {
  static const std::vector<FaultRow> rows{
      {"kill", "SIGKILL, SIGTERM or SIGINT at a random moment, up to four times before the work may finish",
       "finished work is neither lost nor done twice, no process is left, and the result has the same bits", 1, 0, true,
       kill_trial},
      {"full disk", "the results folder is a file system that is smaller than what the work writes, by a random part",
       "one error, no crash, and readable files; with room the work goes on to the same bits", 1, 20, false,
       full_disk_trial},
      {"read-only disk", "the results folder of a half-done run is read-only",
       "one error, no crash, nothing changed; writable again, the work goes on to the same bits", 1, 5, false,
       read_only_disk_trial},
      {"vanishing disk", "the results folder is taken away at a random moment, and put back when the run has ended",
       "the run ends by itself, without a crash; put back, the work goes on to the same bits", 1, 20, false,
       vanishing_disk_trial},
      {"slow disk", "every call that opens, writes, renames or removes a file takes 2 ms longer",
       "the same bits and the same exit code", 1, 5, false, slow_disk_trial},
      {"failing disk", "from a random call on, everything that writes to the results folder fails with EIO",
       "one error, no crash; on a sound disk the work goes on to the same bits", 1, 20, false, failing_disk_trial},
      {"two runs", "a second run is started on the same folder at a random moment",
       "one of them finishes. The other finishes, too, or reports that the folder is in use; the same bits", 1, 20,
       false, two_runs_trial},
      {"clock jumps", "the wall clock jumps back a year, on by ten, and back, at random moments",
       "the same bits and the same exit code", 1, 10, false, clock_jumps_trial},
      {"little memory",
       "a limit of 256 MiB on the address space (ulimit -v), of the work and of an image that cannot fit",
       "it succeeds, or reports in one line what is too large, with exit code 2; it is never killed", 1, 3, false,
       little_memory_trial},
  };
  return rows;
}

}  // namespace photonproof::inline harness_stress_faults
