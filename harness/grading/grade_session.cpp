#include "harness/grading/grade_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <mutex>
#include <set>
#include <thread>

#include "harness/cells/folder_lock.h"
#include "harness/cells/host.h"
#include "harness/cells/side_by_side.h"
#include "harness/grading/class_timing.h"
#include "harness/grading/grade_flags.h"
#include "harness/grading/grade_points.h"
#include "harness/grading/parameter_probe.h"
#include "harness/grading/scene_findings.h"
#include "harness/grading/scene_grading.h"
#include "harness/grading/scene_references.h"
#include "harness/grading/speed_judge.h"
#include "harness/suites/suite_rows.h"
#include "reference/store/reference_store.h"
#include "scenes/base/input_error.h"

namespace photonproof::inline harness_grading {
namespace {

namespace fs = std::filesystem;

/// A file's name without the extensions of archives.
std::string submission_name(const fs::path& source) {
  std::string name = fs::absolute(source).lexically_normal().filename().string();
  if (name.empty()) name = fs::absolute(source).lexically_normal().parent_path().filename().string();
  if (fs::is_directory(source)) return name;
  for (const char* end : {".zip", ".tar", ".tar.gz", ".tgz", ".tar.bz2", ".tar.xz", ".tar.zst", ".bundle"})
    if (name.size() > std::string(end).size() && name.ends_with(end))
      return name.substr(0, name.size() - std::string(end).size());
  return name;
}

std::string name_for_folder(const std::string& name, std::set<std::string>& taken) {
  std::string folder = name;
  for (char& c : folder)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0 && c != '-' && c != '_' && c != '.') c = '_';
  if (folder.empty() || folder.front() == '.') folder = "_" + folder;
  std::string unique = folder;
  for (int n = 2; !taken.insert(unique).second; ++n) unique = folder + "-" + std::to_string(n);
  return unique;
}

class Session {
 public:
  Session(const Assignment& assignment, const GradeOptions& options)
      : assignment_(assignment),
        options_(options),
        lock_(options.folder),
        threads_(options.threads > 0 ? options.threads : std::max(1, describe_host().cores)),
        runner_(assignment, {options.contained, threads_, options.program, options.interrupt}),
        runs_(assignment, runner_, options.folder, {options.seed, threads_, options.interrupt}),
        own_engine_{.program = options.program,
                    .interrupt = options.interrupt,
                    .kept = std::make_shared<ImageStore>(options.folder / "references" / "cache")} {}

  Grades grade() {
    start_record();
    name_submissions();
    scenes_ = make_work_scenes(assignment_, runner_, own_engine_, options_.folder / "scenes", options_.progress);
    for (WorkScene& scene : scenes_)
      if (!options_.scene.empty() && scene.row.name != options_.scene) scene.unused = left_out_by_choice;
    if (prepare_all() && make_references() && grade_all()) {
      flag_all();
      if (options_.timing && assignment_.performance) time_all();
    }
    return finish();
  }

 private:
  bool is_interrupted() const { return runs_.is_interrupted(); }

  void start_record() {
    grades_.assignment = assignment_.name;
    grades_.title = assignment_.title;
    grades_.created = utc_now();
    grades_.command = options_.command;
    grades_.host = describe_host();
    grades_.versions = options_.versions;
    grades_.seed = options_.seed;
    grades_.contained = options_.contained;
    grades_.containment = runner_.containment();
    grades_.correctness_points = assignment_.correctness_points;
    if (assignment_.performance) {
      grades_.speed_points = assignment_.performance->points();
      grades_.speed_rule = rule_text(*assignment_.performance);
      grades_.speed_tiers = assignment_.performance->tiers;
      grades_.speed_curve = assignment_.performance->curve;
    }
    if (!options_.contained) grades_.caveats.push_back("submissions ran without a sandbox (--no-sandbox)");
    if (!options_.scene.empty() && find_scene(options_.scene) == nullptr)
      throw InputError("--scene", unknown_name("scene", options_.scene, assignment_.scenes));
  }

  const AssignmentScene* find_scene(const std::string& name) const { return find_named(assignment_.scenes, name); }

  void name_submissions() {
    std::set<std::string> taken{"baseline"}, names;
    for (const fs::path& source : options_.submissions) {
      if (!fs::exists(source)) throw InputError(source.string(), "no such file or folder");
      SubmissionWork work;
      work.grade.name = submission_name(source);
      if (!names.insert(work.grade.name).second)
        throw InputError(source.string(), "there is another submission '" + work.grade.name + "'");
      work.grade.folder = "submissions/" + name_for_folder(work.grade.name, taken);
      work.grade.source = source.string();
      if (work.grade.name.find(options_.only) == std::string::npos) continue;
      works_.push_back(std::move(work));
    }
    if (works_.empty()) throw InputError("--only", "no submission's name contains '" + options_.only + "'");
  }

  // A program that was submitted twice, or is the baseline, is built once.
  PreparedSubmission prepare(const std::string& name, const fs::path& source, const std::string& folder) {
    options_.progress("building " + name);
    PreparedSubmission taken = runner_.take(name, source, options_.folder / folder / "program");
    if (taken.checksum.empty()) return taken;
    if (const PreparedSubmission* same = built_same_as(taken)) {
      PreparedSubmission copy = *same;
      copy.name = name;
      copy.source = source;
      return copy;
    }
    runner_.build(taken, options_.resume);
    return taken;
  }

  const PreparedSubmission* built_same_as(const PreparedSubmission& taken) const {
    if (baseline_.checksum == taken.checksum) return &baseline_;
    const auto found = std::ranges::find(prepared_, taken.checksum, &PreparedSubmission::checksum);
    return found == prepared_.end() ? nullptr : &*found;
  }

  bool prepare_all() {
    baseline_ = prepare("the baseline", assignment_.baseline, "submissions/baseline");
    if (is_interrupted()) return false;
    if (!baseline_.built)
      throw InputError(assignment_.baseline.string(),
                       "the baseline cannot be built: " + baseline_.sentence + "\n" + baseline_.log_tail);
    for (SubmissionWork& work : works_) {
      PreparedSubmission prepared = prepare(work.grade.name, work.grade.source, work.grade.folder);
      if (is_interrupted()) return false;
      work.tried = true;
      work.grade.checksum = prepared.checksum;
      work.grade.built = prepared.built;
      work.grade.build_sentence = prepared.sentence;
      work.grade.build_log = prepared.log_tail;
      work.grade.build_seconds = prepared.seconds;
      prepared_.push_back(std::move(prepared));
    }
    return true;
  }

  bool make_references() {
    auto made = make_scene_references({.assignment = assignment_,
                                       .scenes = scenes_,
                                       .baseline = baseline_,
                                       .runs = runs_,
                                       .engine = own_engine_,
                                       .processes = threads_,
                                       .seed = options_.seed,
                                       .reuse = !options_.fresh,
                                       .progress = options_.progress});
    if (!made) return false;
    references_ = std::move(*made);
    for (std::size_t s = 0; s < scenes_.size(); ++s) {
      GradedScene record = scene_record(scenes_[s]);
      if (references_[s]) store_reference_of(*references_[s], record);
      grades_.scenes.push_back(std::move(record));
    }
    return true;
  }

  GradedScene scene_record(const WorkScene& scene) const {
    GradedScene record;
    record.name = scene.row.name;
    record.hidden = scene.row.hidden;
    record.timed = assignment_.is_timed(scene.row.name);
    record.max_points = scene_points(assignment_, scenes_, scene);
    record.width = scene.width;
    record.height = scene.height;
    record.of = scene.row.of;
    record.variant = scene.row.variant;
    record.says = scene.says;
    record.unused = scene.unused;
    return record;
  }

  void store_reference_of(const SceneReference& reference, GradedScene& record) const {
    fs::create_directories(options_.folder / "references");
    record.reference = reference.text;
    record.reference_image = "references/" + record.name + ".exr";
    record.reference_picture = "references/" + record.name + ".png";
    write_exr((options_.folder / record.reference_image).string(), reference.rendering);
    write_png((options_.folder / record.reference_picture).string(), reference.rendering.mean);
  }

  // The first public scene shows whether a program uses its seed and computes every time.
  SceneGradingOptions grading_options(std::size_t s) const {
    const auto first = std::ranges::find_if(scenes_, [](const WorkScene& scene) { return scene.unused.empty(); });
    const bool is_first = s == static_cast<std::size_t>(first - scenes_.begin());
    const bool looks_twice = assignment_.seeds && is_first;
    return {.least_images = looks_twice ? 2u : 1u, .in_used_place = looks_twice, .reuse = options_.resume};
  }

  bool grade_all() {
    baseline_work_.grade.name = "baseline";
    baseline_work_.grade.folder = "submissions/baseline";
    baseline_work_.grade.built = true;
    baseline_work_.grade.checksum = baseline_.checksum;
    std::vector<std::pair<SubmissionWork*, const PreparedSubmission*>> all{{&baseline_work_, &baseline_}};
    for (std::size_t i = 0; i < works_.size(); ++i)
      if (prepared_[i].built && first_of(works_[i]) == &works_[i]) all.emplace_back(&works_[i], &prepared_[i]);
    for (SubmissionWork& work : works_) work.scenes.resize(scenes_.size());
    baseline_work_.scenes.resize(scenes_.size());
    std::atomic<bool> interrupted{false};
    std::atomic<std::size_t> done{0};
    const std::size_t count = all.size() * scenes_.size();
    side_by_side(count, threads_, [&](std::size_t job) {
      if (interrupted) return;
      auto& [work, prepared] = all[job / scenes_.size()];
      const std::size_t s = job % scenes_.size();
      if (references_[s]) {
        work->scenes[s] = grade_scene(assignment_, *prepared, scenes_[s], *references_[s], runs_, grading_options(s));
        if (!work->scenes[s]) interrupted = true;
      }
      options_.progress(fmt::format("images: {} of {} scenes ({})", ++done, count, prepared->name));
    });
    for (SubmissionWork& work : works_) work.scenes = first_of(work)->scenes;
    return !interrupted;
  }

  // The same program gives the same images with the same seeds.
  const SubmissionWork* first_of(const SubmissionWork& work) const {
    if (work.grade.checksum == baseline_work_.grade.checksum) return &baseline_work_;
    const auto is_same = [&](const SubmissionWork& other) { return other.grade.checksum == work.grade.checksum; };
    return work.grade.built ? &*std::ranges::find_if(works_, is_same) : &work;
  }

  void flag_all() {
    const FlagContext context{assignment_, scenes_, references_, baseline_work_};
    SceneFindings findings(assignment_, scenes_, references_, own_engine_, options_.progress);
    for (SubmissionWork& work : works_) flag_images(context, work);
    std::atomic<std::size_t> done{0};
    const std::size_t count = works_.size() * scenes_.size();
    side_by_side(count, threads_, [&](std::size_t job) {
      if (is_interrupted()) return;
      SubmissionWork& work = works_[job / scenes_.size()];
      const std::size_t s = job % scenes_.size();
      if (work.scenes[s]) {
        findings.add(s, *work.scenes[s]);
        store_scene_pictures(options_.folder, work.grade.folder, *references_[s], *work.scenes[s]);
      }
      options_.progress(fmt::format("diagnoses: {} of {} scenes ({})", ++done, count, work.grade.name));
    });
    for (std::string& problem : findings.problems()) grades_.caveats.push_back(std::move(problem));
    flag_parameters(context);
    for (SubmissionWork& work : works_) flag_verdicts(context, work);
    flag_likenesses(context, works_);
    for (SubmissionWork& work : works_) {
      collect(work);
      if (options_.heard) options_.heard(work.grade);
    }
    for (std::size_t s = 0; s < scenes_.size(); ++s)
      if (baseline_work_.scenes[s] && !baseline_work_.scenes[s]->grade.counts_as_right())
        grades_.caveats.push_back("the baseline itself is not right on scene '" + scenes_[s].row.name +
                                  "': " + baseline_work_.scenes[s]->grade.sentence);
  }

  void flag_parameters(const FlagContext& context) {
    const ParameterProbe probe(context, runner_, runs_, baseline_, options_.resume);
    side_by_side(works_.size(), threads_, [&](std::size_t i) {
      if (!is_interrupted() && first_of(works_[i]) == &works_[i]) probe.flag(prepared_[i], works_[i]);
    });
  }

  // Copies the work into the record.
  void collect(SubmissionWork& work) const {
    work.grade.scenes.clear();
    for (std::size_t s = 0; s < scenes_.size(); ++s) {
      SceneGrade grade;
      grade.scene = scenes_[s].row.name;
      grade.sentence = scenes_[s].unused;
      const bool is_skipped = grade.sentence.empty() || grade.sentence == left_out_by_choice;
      grade.verdict = is_skipped ? SceneVerdict::skipped : SceneVerdict::unused;
      if (work.tried && !work.grade.built && grade.sentence.empty()) {
        grade.verdict = SceneVerdict::failed;
        grade.sentence = "was not built";
      }
      work.grade.scenes.push_back(s < work.scenes.size() && work.scenes[s] ? work.scenes[s]->grade : grade);
    }
    give_points(assignment_, scenes_, work.grade);
  }

  void time_all() {
    ClassTiming timing{.assignment = assignment_,
                       .scenes = scenes_,
                       .references = references_,
                       .baseline = baseline_,
                       .baseline_work = baseline_work_,
                       .runs = runs_,
                       .folder = options_.folder,
                       .cores = std::max(1, describe_host().cores),
                       .resume = options_.resume,
                       .progress = options_.progress};
    time_class(timing, prepared_, works_);
    for (SubmissionWork& work : works_) give_points(assignment_, scenes_, work.grade);
  }

  Grades finish() {
    grades_.interrupted = is_interrupted();
    for (SubmissionWork& work : works_) {
      if (work.grade.scenes.empty()) collect(work);
      grades_.submissions.push_back(std::move(work.grade));
    }
    return std::move(grades_);
  }

  const Assignment& assignment_;
  const GradeOptions& options_;
  FolderLock lock_;
  int threads_;
  SubmissionRunner runner_;
  GradeRuns runs_;
  OwnEngine own_engine_;
  Grades grades_;
  std::vector<WorkScene> scenes_;
  std::vector<std::optional<SceneReference>> references_;
  PreparedSubmission baseline_;
  SubmissionWork baseline_work_;
  std::vector<SubmissionWork> works_;
  std::vector<PreparedSubmission> prepared_;
};

}  // namespace

Grades grade_submissions(const Assignment& assignment, const GradeOptions& options) {
  return Session(assignment, options).grade();
}

}  // namespace photonproof::inline harness_grading
