// The folders of kept images under a results folder: cells/<key>-<n>/ holds the image, the engine's stats and output,
// and, written last, cell.json. A folder without cell.json was interrupted and holds no result. An image that is drawn
// again gets the next n; nothing is overwritten.
#pragma once

#include <filesystem>
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
  /// The store is made inside the results folder on first use. Whether this process is the only one that draws there:
  /// else a folder without record may be another's work, and is left alone.
  explicit ImageStore(std::filesystem::path results_folder, bool is_alone = true)
      : folder_(std::move(results_folder)), is_alone_(is_alone) {}

  /// The latest result of the key. A record does not count where cell.json cannot be read, or where the image is gone
  /// or another than was measured; it is never touched. One whose pictures are gone has to be compared again (no
  /// comparison_key).
  std::optional<KeptImage> latest(const std::string& key) const;

  /// The latest record that `read(folder)` makes something of, `folder` relative to the results folder. Where it gives
  /// nothing or throws InputError the record does not count.
  template <class Read>
  auto latest(const std::string& key, const Read& read) const -> decltype(read(std::string())) {
    for (int n = last_number(key); n > 0; --n) {
      const std::string name = folder_name(key, n);
      if (!has_record(name)) continue;
      try {
        if (auto found = read(name)) return found;
      } catch (const InputError&) {
        // Of another version, or damaged: the same to us as never measured.
      }
    }
    return std::nullopt;
  }

  /// An empty folder for a new image, relative to the results folder; that of an interrupted one where there is one.
  /// May be called on several threads. Throws InputError where it cannot be made.
  std::string claim(const std::string& key);

  /// Completes a folder, or replaces its record after a new comparison.
  void keep(const KeptImage& image) const;

  const std::filesystem::path& folder() const { return folder_; }
  /// Written last into a folder of the store.
  std::filesystem::path record_of(const std::string& name) const { return folder_ / name / "cell.json"; }

 private:
  static std::string folder_name(const std::string& key, int n) { return "cells/" + key + "-" + std::to_string(n); }
  int last_number(const std::string& key) const;
  bool has_record(const std::string& name) const;

  std::filesystem::path folder_;
  bool is_alone_;
  std::mutex claiming_;
  std::set<std::string> claimed_;  ///< by this object: work may still go on there
};

}  // namespace photonproof::inline harness_images
