// A library with the functions of Open Image Denoise that are used, for tests without it. Its filter is a formula:
// 2 colour(w - 1 - x, y) + albedo + 10 normal. The environment variable FAKE_OIDN names what fails; calls are lines of
// the file FAKE_OIDN_RECORD.

#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <map>
#include <string>

namespace {

struct Pixels {
  char* data;
  int format;
  std::size_t width, height, pixel_stride, row_stride;

  float& at(std::size_t x, std::size_t y, std::size_t c) const {
    const std::size_t pixel = pixel_stride > 0 ? pixel_stride : 12, row = row_stride > 0 ? row_stride : width * pixel;
    return *reinterpret_cast<float*>(data + y * row + x * pixel + c * sizeof(float));
  }
};

struct Filter {
  std::map<std::string, Pixels> images;
  bool (*monitor)(void*, double) = nullptr;
  void* user = nullptr;
};

int error_code = 0;
const char* error_words = nullptr;

bool is_asked(const char* failure) {
  const char* asked = std::getenv("FAKE_OIDN");
  return asked != nullptr && std::strcmp(asked, failure) == 0;
}

void record(const std::string& call) {
  const char* file = std::getenv("FAKE_OIDN_RECORD");
  if (file == nullptr) return;
  std::FILE* out = std::fopen(file, "a");
  std::fprintf(out, "%s\n", call.c_str());
  std::fclose(out);
}

void fail(int code, const char* words) {
  if (error_code != 0) return;
  error_code = code;
  error_words = words;
}

/// Unused in the library that lacks functions.
[[maybe_unused]] void filter_pixels(const Filter& filter) {
  const Pixels &out = filter.images.at("output"), &colour = filter.images.at("color"),
               &albedo = filter.images.at("albedo"), &normal = filter.images.at("normal");
  for (std::size_t y = 0; y < out.height; ++y)
    for (std::size_t x = 0; x < out.width; ++x)
      for (std::size_t c = 0; c < 3; ++c)
        out.at(x, y, c) = 2 * colour.at(out.width - 1 - x, y, c) + albedo.at(x, y, c) + 10 * normal.at(x, y, c);
  if (is_asked("nan")) out.at(0, 0, 1) = std::numeric_limits<float>::quiet_NaN();
}

}  // namespace

extern "C" {

void* oidnNewDevice(int type) {
  static int device;
  record("device of type " + std::to_string(type));
  if (!is_asked("device")) return &device;
  fail(5, "unsupported processor");
  return nullptr;
}
void oidnCommitDevice(void*) {
  record("commit device");
  if (is_asked("commit")) fail(1, "no threads");
}
void oidnReleaseDevice(void*) { record("release device"); }
void oidnSetDeviceBool(void*, const char* name, bool value) { record(std::string(name) + (value ? " on" : " off")); }
void oidnSetDeviceInt(void*, const char* name, int value) { record(name + (" " + std::to_string(value))); }
int oidnGetDeviceInt(void*, const char* name) { return std::strcmp(name, "version") == 0 ? 20304 : -1; }
int oidnGetDeviceError(void*, const char** words) {
  const int code = error_code;
  *words = error_words;
  error_code = 0;
  error_words = nullptr;
  return code;
}
void* oidnNewFilter(void*, const char* type) {
  record(std::string("filter ") + type);
  return new Filter;
}
void oidnCommitFilter(void*) { record("commit filter"); }
#ifndef FAKE_OIDN_PARTIAL
void oidnExecuteFilter(void* filter) {
  const Filter& f = *static_cast<Filter*>(filter);
  record("execute");
  for (const auto& [name, image] : f.images)
    if (image.format != 3) return fail(2, "a format that is not three floats");
  if (is_asked("execute")) return fail(4, nullptr);
  if (is_asked("memory")) return fail(4, "out of memory");
  if (f.monitor != nullptr && !f.monitor(f.user, 0.5)) return fail(6, "cancelled");
  filter_pixels(f);
}
#endif
void oidnReleaseFilter(void* filter) {
  record("release filter");
  delete static_cast<Filter*>(filter);
}
void oidnSetFilterBool(void*, const char* name, bool value) { record(std::string(name) + (value ? " on" : " off")); }
void oidnSetSharedFilterImage(void* filter, const char* name, void* data, int format, std::size_t width,
                              std::size_t height, std::size_t offset, std::size_t pixel_stride,
                              std::size_t row_stride) {
  record(std::string(name) + " " + std::to_string(width) + "x" + std::to_string(height));
  static_cast<Filter*>(filter)->images[name] = {
      static_cast<char*>(data) + offset, format, width, height, pixel_stride, row_stride};
}
void oidnSetFilterProgressMonitorFunction(void* filter, bool (*monitor)(void*, double), void* user) {
  static_cast<Filter*>(filter)->monitor = monitor;
  static_cast<Filter*>(filter)->user = user;
}
}
