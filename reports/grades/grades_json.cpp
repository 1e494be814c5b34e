#include "reports/grades/grades_json.h"

#include "reports/grades/grade_fields.h"
#include "reports/record/file_inside.h"
#include "scenes/records/record_reader.h"
#include "scenes/records/record_writer.h"

namespace photonproof::inline reports_grades {

nlohmann::ordered_json run_to_json(const GradedRun& run) { return record_json(run); }

GradedRun run_from_json(const nlohmann::ordered_json& json) {
  RecordSource source{"cell.json"};
  GradedRun run = read_record<GradedRun>(json, source);
  refuse_files_outside(source.files);
  return run;
}

nlohmann::ordered_json grades_to_json(const Grades& grades) { return record_json(grades); }

Grades grades_from_json(const nlohmann::ordered_json& json, const std::string& file) {
  RecordSource source{file};
  Grades grades = read_record<Grades>(json, source);
  refuse_files_outside(source.files, std::filesystem::absolute(file).parent_path());
  return grades;
}

}  // namespace photonproof::inline reports_grades
