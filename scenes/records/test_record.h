// Checks for every kind of record: its schema in the tree is the printed one, and reader and schema accept and refuse
// the same documents.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <regex>

#include "scenes/files/atomic_file.h"
#include "scenes/records/record_reader.h"
#include "scenes/records/record_schema.h"
#include "scenes/records/record_writer.h"
#include "scenes/records/test_schema_check.h"

namespace photonproof::inline scenes_records {

/// `file` below the source folder.
template <class T>
void expect_schema_in(const std::string& file) {
  const std::string path = PHOTONPROOF_SOURCE_DIR "/" + file, printed = schema_text<T>();
  if (std::filesystem::exists(path) && read_file(path) == printed) return;
  const std::string made = ::testing::TempDir() + std::filesystem::path(file).filename().string();
  write_file_atomically(made, printed);
  ADD_FAILURE() << "the description says otherwise: cp " << made << " " << path;
}

/// The error with which T refuses the document; empty where it reads it.
template <class T>
std::string record_problem(const RecordJson& json) try {
  RecordSource source{""};
  read_record<T>(json, source);
  return "";
} catch (const InputError& error) {
  return error.summary();
}

/// Every value and every key of the document, damaged one at a time. In a list, each key of its entries is damaged
/// once.
template <class Visit>
void for_each_damage(const RecordJson& document, const Visit& visit) {
  std::map<std::string, std::string> places;  // by what they are without the numbers of entries
  const RecordJson leaves = document.flatten();
  for (const auto& [leaf, value] : leaves.items())
    for (std::string place = leaf; !place.empty(); place.resize(place.rfind('/')))
      places.emplace(std::regex_replace(place, std::regex("/[0-9]+"), "/#"), place);
  for (const auto& [shape, place] : places) {
    const RecordJson::json_pointer pointer(place);
    for (const RecordJson& other : {RecordJson(nullptr), RecordJson(-1), RecordJson(0.5), RecordJson(""),
                                    RecordJson("other"), RecordJson(true), RecordJson::array(), RecordJson::object()}) {
      RecordJson damaged = document;
      damaged[pointer] = other;
      visit(place + " = " + other.dump(), damaged);
    }
    RecordJson damaged = document;
    RecordJson& outer = damaged[pointer.parent_pointer()];
    if (!outer.is_object()) continue;
    outer.erase(pointer.back());
    visit("without " + place, damaged);
    outer["unknown"] = 1;
    visit("without " + place + " and with another", damaged);
  }
}

/// The document reads back to itself, and the schema agrees with the reader on it and on all damaged versions.
template <class T>
void expect_reader_agrees_with_schema(const T& record) {
  const SchemaCheck schema(schema_text<T>());
  const RecordJson document = record_json(record);
  EXPECT_EQ(record_problem<T>(document), "");
  EXPECT_EQ(schema.problem(document.dump()), "");
  for_each_damage(document, [&](const std::string& damage, const RecordJson& damaged) {
    const std::string refused = record_problem<T>(damaged), problem = schema.problem(damaged.dump());
    EXPECT_EQ(refused.empty(), problem.empty()) << damage << "\nreader: " << refused << "\nschema: " << problem;
  });
}

}  // namespace photonproof::inline scenes_records
