#include <malloc.h>
#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>

#include "harness/stress/soak/soak_run.h"
#include "scenes/base/json_text.h"
#include "scenes/files/atomic_file.h"
#include "scenes/files/file_checksum.h"

namespace photonproof::inline harness_stress_soak {
namespace {

double resident_bytes() {
  std::ifstream statm("/proc/self/statm");
  double all = 0, resident = 0;
  statm >> all >> resident;
  return resident * static_cast<double>(sysconf(_SC_PAGESIZE));
}

/// The bytes that malloc has allocated and that are not freed, large blocks included.
double heap_bytes() {
  const auto info = mallinfo2();
  return static_cast<double>(info.uordblks) + static_cast<double>(info.hblkhd);
}

}  // namespace

void soak_within(const std::filesystem::path& folder,
                 const std::function<void(const std::vector<std::string>& arguments)>& render) {
  const nlohmann::ordered_json job = nlohmann::ordered_json::parse(read_file(folder / "within.json"));
  const auto renders = job.at("renders").get<std::vector<std::vector<std::string>>>();
  const auto images = job.at("images").get<std::vector<std::string>>();
  nlohmann::ordered_json samples = {{"heap", nlohmann::ordered_json::array()},
                                    {"resident", nlohmann::ordered_json::array()},
                                    {"checksums", nlohmann::ordered_json::array()}};
  const int cycles = job.at("cycles");
  for (int cycle = 0; cycle < cycles; ++cycle) {
    nlohmann::ordered_json checksums = nlohmann::ordered_json::array();
    for (std::size_t i = 0; i < renders.size(); ++i) {
      render(renders[i]);
      checksums.push_back(file_checksum(images[i]));
    }
    // Measured before the record itself grows.
    const double heap = heap_bytes(), resident = resident_bytes();
    // Keeps the first cycle's checksums, and later ones only if they differ: the record itself must not grow.
    if (cycle == 0) samples["checksums"] = checksums;
    if (checksums != samples["checksums"]) samples["other_bits"] = {{"cycle", cycle}, {"checksums", checksums}};
    samples["heap"].push_back(heap);
    samples["resident"].push_back(resident);
    std::fprintf(stderr, ".");  // one for each cycle, as progress
  }
  write_file_atomically(folder / "within-samples.json", json_text(samples) + "\n");
}

}  // namespace photonproof::inline harness_stress_soak
