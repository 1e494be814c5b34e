#include "harness/images/image_store.h"

#include "reports/record/file_inside.h"
#include "scenes/files/file_checksum.h"
#include "scenes/images/image.h"

namespace photonproof::inline harness_images {
namespace {

namespace fs = std::filesystem;

// False also for a path that cannot be inspected.
bool is_there(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

// Whether the image file is still the measured one. Without a checksum in the record it only has to exist.
bool has_its_image(const fs::path& results_folder, const Result& result) {
  const fs::path image = results_folder / result.image;
  if (result.image.empty()) return true;
  if (!result.image_checksum.empty()) return file_checksum(image) == result.image_checksum;
  if (!is_there(image)) return false;
  if (result.status != Status::ok) return true;
  try {
    read_image(image.string());
    return true;
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace

int ImageStore::last_number(const std::string& key) const {
  int n = 0;
  while (is_there(folder_ / folder_name(key, n + 1))) ++n;
  return n;
}

bool ImageStore::has_record(const std::string& name) const { return is_there(record_of(name)); }

std::optional<KeptImage> ImageStore::latest(const std::string& key) const {
  return latest(key, [this](const std::string& name) -> std::optional<KeptImage> {
    KeptImage found{read_result(record_of(name).string()), name};
    const Result& result = found.kept.result;
    refuse_link_outside(folder_, result.image);
    refuse_links_outside(folder_, result.pictures);
    if (!has_its_image(folder_, result)) return std::nullopt;
    for (const auto& [role, picture] : result.pictures)
      if (!is_there(folder_ / picture)) found.kept.comparison_key.clear();
    return found;
  });
}

std::string ImageStore::claim(const std::string& key, bool resumes) {
  const std::lock_guard lock(claiming_);
  int n = last_number(key);
  std::string name = folder_name(key, n);
  std::error_code error;
  if (is_alone_ && n > 0 && !has_record(name) && !claimed_.contains(name)) {
    if (resumes) return *claimed_.insert(name).first;
    fs::remove_all(folder_ / name, error);
  } else {
    name = folder_name(key, ++n);
  }
  if (!error) fs::create_directories((folder_ / name).parent_path(), error);
  while (!error && !fs::create_directory(folder_ / name, error) && !error) name = folder_name(key, ++n);
  if (error) throw InputError((folder_ / name).string(), "cannot be made: " + error.message());
  claimed_.insert(name);
  return name;
}

void ImageStore::remove(const std::string& key) const {
  std::error_code ignored;
  for (int n = last_number(key); n > 0; --n) fs::remove_all(folder_ / folder_name(key, n), ignored);
}

std::mutex& ImageStore::drawing(const std::string& key) {
  const std::lock_guard lock(claiming_);
  return drawing_[key];
}

void ImageStore::keep(const KeptImage& image) const { write_result(record_of(image.folder).string(), image.kept); }

}  // namespace photonproof::inline harness_images
