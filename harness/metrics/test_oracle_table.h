// Reads the tables of expected values in harness/oracles, for the tests that compare metrics with them.
#pragma once

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "scenes/images/image.h"

namespace photonproof::inline harness_metrics {

/// An image pair of harness/oracles and an oracle's values for it.
struct OraclePair {
  std::string name;
  Image reference, test;
  double exposure = 0;                     ///< stops
  std::map<std::string, double> expected;  ///< by metric name
};

/// The rows of harness/oracles/<file>; a missing file or image throws or gives no rows, which a test must check.
inline std::vector<OraclePair> read_oracle_table(const std::string& file) {
  const std::string folder = PHOTONPROOF_SOURCE_DIR "/harness/oracles/";
  std::ifstream in(folder + file);
  std::vector<std::string> columns;
  std::vector<OraclePair> pairs;
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with('#')) continue;
    std::vector<std::string> fields;
    std::istringstream text(line);
    for (std::string field; std::getline(text, field, ',');) fields.push_back(field);
    if (columns.empty()) {
      columns = fields;
      continue;
    }
    OraclePair pair;
    pair.name = fields.at(0);
    pair.reference = read_image(folder + "images/" + fields.at(1));
    pair.test = read_image(folder + "images/" + fields.at(2));
    pair.exposure = std::stod(fields.at(3));
    for (std::size_t i = 4; i < columns.size(); ++i) pair.expected[columns[i]] = std::stod(fields.at(i));
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

}  // namespace photonproof::inline harness_metrics
