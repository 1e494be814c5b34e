#include "scenes/pbrt/sources.h"

#include "scenes/base/text_position.h"

namespace photonproof::inline scenes_pbrt {

void PbrtSources::fail(const Place& at, const std::string& message) const {
  fail_at_offset(name(at.file), text(at.file), at.offset, message);
}

std::string PbrtSources::where(const Place& at) const {
  try {
    fail(at, "");
  } catch (const InputError& error) {
    return error.place();
  }
}

std::string PbrtSources::line(const std::string& file, int number) const {
  for (const File& candidate : files_) {
    if (candidate.name != file) continue;
    std::size_t begin = 0;
    for (int i = 1; i < number && begin != std::string::npos; ++i) begin = candidate.text.find('\n', begin) + 1;
    return candidate.text.substr(begin, candidate.text.find('\n', begin) - begin).substr(0, 4096);
  }
  return {};
}

}  // namespace photonproof::inline scenes_pbrt
