// The folders of kept images in a results folder. cells/<key>-<n>/ holds the image, the engine's stats and output, and
// cell.json, which is written last. A folder without cell.json was interrupted and holds no result. A repeated image
// gets the next n; no file is overwritten.
#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "reports/record/results.h"
#include "scenes/base/input_error.h"

namespace photonproof::inline harness_images {

/// A result and the folder, relative to the results folder, that holds its image.
struct KeptImage {
  KeptResult kept;
  std::string folder;
};

class ImageStore {
 public:
  /// Makes the store in the results folder on first use. `is_alone`: no other process renders there. If false, a folder
  /// without a record may be in use and is left alone.
  explicit ImageStore(std::filesystem::path results_folder, bool is_alone = true)
      : folder_(std::move(results_folder)), is_alone_(is_alone) {}

  /// The latest result of the key. A record does not count if cell.json cannot be read, or if the image is gone or is
  /// not the measured one; such a record is never touched. A result without its pictures must be compared again (no
  /// comparison_key).
  std::optional<KeptImage> latest(const std::string& key) const;

  /// The latest record for which `read(folder)` returns a value, with `folder` relative to the results folder. A record
  /// does not count where `read` returns nothing or throws InputError.
  template <class Read>
  auto latest(const std::string& key, const Read& read) const -> decltype(read(std::string())) {
    for (int n = last_number(key); n > 0; --n) {
      const std::string name = folder_name(key, n);
      if (!has_record(name)) continue;
      try {
        if (auto found = read(name)) return found;
      } catch (const InputError&) {
        // The record is damaged or of another version: treated as never measured.
      }
    }
    return std::nullopt;
  }

  /// A folder for a new image, relative to the results folder; reuses that of an interrupted one. It is empty, or with
  /// `resumes` has the interrupted one's files, from which the engine continues. May be called on several threads.
  /// Throws InputError where it cannot be made.
  std::string claim(const std::string& key, bool resumes = false);

  /// Completes a folder, or replaces its record after a new comparison.
  void keep(const KeptImage& image) const;

  /// Removes all images of the key.
  void remove(const std::string& key) const;

  /// Held by the thread that draws the image of the key, so that others wait for it instead of drawing it again.
  std::mutex& drawing(const std::string& key);

  const std::filesystem::path& folder() const { return folder_; }
  /// This file is written last into a folder of the store.
  std::filesystem::path record_of(const std::string& name) const { return folder_ / name / "cell.json"; }

 private:
  static std::string folder_name(const std::string& key, int n) { return "cells/" + key + "-" + std::to_string(n); }
  int last_number(const std::string& key) const;
  bool has_record(const std::string& name) const;

  std::filesystem::path folder_;
  bool is_alone_;
  std::mutex claiming_;
  std::set<std::string> claimed_;              ///< by this object, and possibly still in use
  std::map<std::string, std::mutex> drawing_;  ///< by key
};

}  // namespace photonproof::inline harness_images
