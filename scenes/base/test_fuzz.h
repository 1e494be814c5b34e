// Common parts of fuzz targets: input as a file, where a reader needs one, and checks of every message. The stored
// corpora also run as ordinary tests, so every build checks past findings.
#pragma once

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>

#include "scenes/base/input_error.h"
#include "scenes/base/utf8.h"

namespace photonproof::inline scenes_base {

/// A folder of this process's own, for files that are written repeatedly; removed with the object.
class FuzzFolder {
 public:
  FuzzFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "photonproof-fuzz-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) std::abort();
    path_ = name;
  }
  ~FuzzFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  FuzzFolder(const FuzzFolder&) = delete;
  FuzzFolder& operator=(const FuzzFolder&) = delete;

  std::filesystem::path put(const std::string& name, std::string_view bytes) const {
    std::filesystem::path file = path_ / name;
    std::error_code ignored;
    std::filesystem::remove(file, ignored);  // ext4 waits for the disk where a file is cut to nothing and written anew
    std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    return file;
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Empty when the message is valid UTF-8, begins as its report does, and has a summary of one line; else the problem.
inline std::string problem_with_message(const InputError& error) {
  const std::string what = error.what();
  if (find_invalid_utf8(what) != std::string::npos) return "a message is not valid UTF-8";
  const auto first_line = [](const std::string& text) { return text.substr(0, text.find('\n')); };
  if (error.summary().empty() || first_line(what) != first_line(error.report()))
    return "a message without its report: " + what;
  return error.summary().find('\n') != std::string::npos ? "a summary of several lines: " + error.summary() : "";
}

/// The function that libFuzzer calls for every input: it ends the program where `check` finds a problem.
template <class Check>
int fuzz_input(Check check, const std::uint8_t* data, std::size_t size) {
  const std::string problem = check(std::string_view(reinterpret_cast<const char*>(data), size));
  if (problem.empty()) return 0;
  std::fprintf(stderr, "%s\n", problem.c_str());
  std::abort();
}

}  // namespace photonproof::inline scenes_base
