// An invented class for tests, with everything that the pages of a grading can show.
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "reports/grades/grade_record.h"
#include "reports/record/heatmap_magma.h"
#include "scenes/images/image.h"

namespace photonproof::reports::inline reports_grades {

using ImageChange = std::function<Image(const Image&)>;

/// Replaces each value by `value` of (image, x, y, channel).
inline Image changed_image(const Image& image, const std::function<double(const Image&, int, int, int)>& value) {
  Image out(image.width, image.height);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x)
      for (int c = 0; c < 3; ++c) out.pixel(x, y)[c] = static_cast<float>(value(image, x, y, c));
  return out;
}

/// A wall with a floor and a ball, whose colours depend on `kind`.
inline Image sample_picture(int kind, int side) {
  return changed_image(Image(side, side), [&](const Image&, int x, int y, int c) {
    const double u = (x + 0.5) / side - 0.5, v = (y + 0.5) / side - 0.6;
    if (u * u + v * v < 0.04) return 0.9 * (c == kind % 3) + 0.4 * (u - v + 0.3);
    return (0.2 + 0.4 * y / side) * (c == (kind + 1) % 3 ? 1.0 : 0.6);
  });
}

inline Image upside_down(const Image& image) {
  return changed_image(image, [](const Image& i, int x, int y, int c) { return i.pixel(x, i.height - 1 - y)[c]; });
}
inline Image black_lines(const Image& image) {
  return changed_image(image, [](const Image& i, int x, int y, int c) {
    return x % 16 == 15 || y % 16 == 15 ? 0.0 : static_cast<double>(i.pixel(x, y)[c]);
  });
}
inline Image gamma_twice(const Image& image) {
  return changed_image(
      image, [](const Image& i, int x, int y, int c) { return std::pow(std::max(0.0f, i.pixel(x, y)[c]), 1 / 2.2); });
}
inline Image dark_corner(const Image& image) {
  return changed_image(image, [](const Image& i, int x, int y, int c) {
    const bool inside = x >= i.width / 2 && x < i.width * 7 / 8 && y >= i.height * 5 / 8;
    return (inside ? 0.35 : 1.0) * i.pixel(x, y)[c];
  });
}
inline Image less_light(const Image& image) {
  return changed_image(image, [](const Image& i, int x, int y, int c) { return 0.6 * i.pixel(x, y)[c]; });
}

/// In magma's colours, as a FLIP map.
inline Image difference_map(const Image& a, const Image& b) {
  Image map(a.width, a.height);
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x) {
      double difference = 0;
      for (int c = 0; c < 3; ++c)
        difference = std::max(difference, std::abs(double{a.pixel(x, y)[c]} - double{b.pixel(x, y)[c]}));
      const auto colour = magma_colours[static_cast<std::size_t>(255 * std::min(1.0, difference))];
      for (int c = 0; c < 3; ++c) {
        const double encoded = static_cast<double>(colour >> (16 - 8 * c) & 255) / 255;
        map.pixel(x, y)[c] =
            static_cast<float>(encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4));
      }
    }
  return map;
}

inline GradedScene named_scene(const std::string& name, bool hidden = false) {
  GradedScene scene;
  scene.name = name;
  scene.hidden = hidden;
  return scene;
}

/// An invented class under construction: the record, and its pictures in a folder.
class SampleClass {
 public:
  SampleClass(std::filesystem::path folder, std::map<std::string, Image> images)
      : folder_(std::move(folder)), images_(std::move(images)) {
    grades.assignment = "photon-mapping";
    grades.title = "Make the photon mapper fast";
    grades.created = "2026-02-03T04:05:06Z";
    grades.command = "photonproof grade photon-mapping.toml submissions/*";
    grades.host = {"Some CPU", "Debian 12", "Linux 6.1", 2, std::uint64_t{8} << 30};
    grades.versions = {{"photonproof", "0.1.0"}};
    grades.seed = 424242;
    grades.containment = "bubblewrap 0.8, without a network; cgroup limits";
    grades.correctness_points = 40;
    grades.speed_points = 60;
    grades.speed_rule = "20 points from 2x, 40 from 5x, 60 from 20x";
    grades.speed_tiers = {{2, 20}, {5, 40}, {20, 60}};
    grades.caveats = {"scene 2 was timed on 2 cores"};
    for (const char* name : {"1", "2", "3"}) {
      GradedScene scene = named_scene(name);
      scene.timed = scene.name != "3";
      add_scene(scene);
    }
    GradedScene mirror = named_scene("hidden-mirror", true), lights = named_scene("secret-lamps", true);
    mirror.of = "1";
    mirror.variant = "mirror";
    mirror.says = "left and right change places";
    add_scene(mirror);
    lights.of = "2";
    lights.variant = "more-spheres";
    lights.says = "two lamps above the pool";
    add_scene(lights);
  }

  /// A submission with a successful build, right images and these times by round: baseline and own.
  SubmissionGrade& add(const std::string& name, double speedup) {
    SubmissionGrade& submission = grades.submissions.emplace_back();
    submission.name = name;
    submission.folder = "submissions/" + name;
    submission.source = "submissions/" + name + ".zip";
    submission.built = true;
    submission.build_sentence = "make ended with 0";
    submission.build_log = "g++ -O3 -march=native -c raytracer.cpp\ng++ -o raytracer raytracer.o\n";
    submission.build_seconds = 4.2;
    for (const GradedScene& scene : grades.scenes) {
      SceneGrade& grade = submission.scenes.emplace_back();
      grade.scene = scene.name;
      grade.runs = {{1, "ok", "", 3.2, 6.1, 52'000'000, "", name + scene.name, "scene " + scene.name + " done\n"}};
      set_image(submission, grade, images_.at(scene.name));
      give(grade, SceneVerdict::right, "");
      grade.checks = {check("flip", 0.031, 0.12), check("ssim", 0.962, 0.80)};
    }
    set_speed(submission, speedup);
    return submission;
  }

  /// Makes it wrong on the named scenes (all if none is named).
  void make_wrong(SubmissionGrade& submission, const GradedFinding& finding, const ImageChange& change,
                  const std::vector<std::string>& only = {}) {
    for (SceneGrade& grade : submission.scenes) {
      if (!only.empty() && std::ranges::find(only, grade.scene) == only.end()) continue;
      set_image(submission, grade, change(images_.at(grade.scene)));
      grade.findings = {finding};
      grade.checks = {check("flip", 0.331, 0.12), check("ssim", 0.41, 0.80)};
      grade.checks[0].side = GradedCheck::Side::outside;
      grade.checks[0].sentence = "flip is 0.331, at most 0.12 is right; worst at columns 40 to 47";
      give(grade, SceneVerdict::wrong, finding.sentence);
    }
    without_speed(submission);
  }

  void make_failed(SubmissionGrade& submission, const std::string& end, const std::string& sentence) {
    for (SceneGrade& grade : submission.scenes) {
      grade.pictures.clear();
      grade.checks.clear();
      grade.runs = {
          {1, end, sentence, 60, 118, 812'000'000, "", "", "tracing photons\nscene of " + grade.scene + "\n"}};
      give(grade, SceneVerdict::failed, sentence);
    }
    without_speed(submission);
  }

  void make_unbuilt(SubmissionGrade& submission, const std::string& sentence, const std::string& log) {
    submission.built = false;
    submission.build_sentence = sentence;
    submission.build_log = log;
    for (SceneGrade& grade : submission.scenes) {
      grade.pictures.clear();
      grade.checks.clear();
      grade.runs.clear();
      give(grade, SceneVerdict::failed, "there is no program");
    }
    without_speed(submission);
  }

  /// Points and the first sentence, as grading gives them.
  void finish(SubmissionGrade& submission, const std::string& sentence) {
    submission.correctness_points = 0;
    for (const SceneGrade& grade : submission.scenes) submission.correctness_points += grade.points;
    submission.sentence = sentence;
  }

  Grades grades;
  const Image& image(const std::string& scene) const { return images_.at(scene); }
  int side() const { return images_.begin()->second.width; }

 private:
  void add_scene(GradedScene scene) {
    const Image& image = images_.at(scene.name);
    scene.max_points = 8;
    scene.width = image.width;
    scene.height = image.height;
    scene.reference = "mean of 8 runs of the baseline";
    scene.reference_picture = "references/" + scene.name + ".png";
    save(scene.reference_picture, image);
    grades.scenes.push_back(scene);
  }

  static GradedCheck check(const char* metric, double value, double bound) {
    return {metric, {value, Interval{value * 0.98, value * 1.02}}, bound, "", GradedCheck::Side::inside, ""};
  }

  void save(const std::string& relative, const Image& image) {
    std::filesystem::create_directories((folder_ / relative).parent_path());
    write_png((folder_ / relative).string(), image);
  }

  void set_image(SubmissionGrade& submission, SceneGrade& grade, const Image& image) {
    const std::string stem = submission.folder + "/" + grade.scene;
    grade.pictures = {{"image", stem + ".png"}, {"flip", stem + "-flip.png"}};
    save(stem + ".png", image);
    save(stem + "-flip.png", difference_map(image, images_.at(grade.scene)));
  }

  void give(SceneGrade& grade, SceneVerdict verdict, const std::string& sentence) {
    grade.verdict = verdict;
    grade.sentence = sentence;
    grade.points = grade.counts_as_right() ? 8 : 0;
  }

  void without_speed(SubmissionGrade& submission) {
    submission.speed = {};
    submission.speed.state = SpeedGrade::State::not_right;
    submission.speed.sentence = "not timed: scene 1 is not right";
  }

  void set_speed(SubmissionGrade& submission, double speedup) {
    SpeedGrade& speed = submission.speed;
    speed.state = SpeedGrade::State::measured;
    speed.speedup = {speedup, Interval{speedup * 0.97, speedup * 1.03}};
    speed.rounds = 6;
    speed.sentence = "the interval lies within one tier";
    for (const SpeedTier& tier : grades.speed_tiers)
      if (speedup >= tier.ratio) speed.points = tier.points;
    for (const char* scene : {"1", "2"}) {
      SceneSpeed& timed = speed.scenes.emplace_back();
      timed.scene = scene;
      timed.ratio = speed.speedup;
      for (int round = 0; round < 6; ++round) {
        const double wobble = 1 + 0.03 * std::sin(5.0 * round + speedup);
        timed.baseline_seconds.push_back(12 / wobble);
        timed.seconds.push_back(12 / speedup * wobble);
        timed.busy.push_back(round == 3 ? 0.6 : 0.04);
      }
    }
  }

  std::filesystem::path folder_;
  std::map<std::string, Image> images_;
};

inline std::map<std::string, Image> sample_images(int side) {
  std::map<std::string, Image> images;
  int kind = 0;
  for (const char* name : {"1", "2", "3", "hidden-mirror", "secret-lamps"}) images[name] = sample_picture(kind++, side);
  return images;
}

/// A submission that is wrong on the named scenes (all if none is named); its first sentence is the finding's.
inline SubmissionGrade& add_wrong(SampleClass& sample, const char* name, double speedup, const GradedFinding& finding,
                                  const ImageChange& change, const std::vector<std::string>& only = {}) {
  SubmissionGrade& submission = sample.add(name, speedup);
  sample.make_wrong(submission, finding, change, only);
  sample.finish(submission, "scene 1: " + finding.sentence);
  return submission;
}

inline void add_honest(SampleClass& sample) {
  sample.finish(sample.add("honest", 6.3), "right on all 5 scenes; 6.3 times as fast as the baseline");
  sample.finish(sample.add("quick", 24.8), "right on all 5 scenes; 24.8 times as fast as the baseline");
  SubmissionGrade& noisy = sample.add("slightly-better", 1.9);
  noisy.speed.state = SpeedGrade::State::too_noisy;
  noisy.speed.speedup.interval = Interval{1.6, 2.3};
  noisy.speed.sentence = "too noisy: 2 lies in the interval";
  noisy.scenes[1].verdict = SceneVerdict::borderline;
  noisy.scenes[1].sentence = "noise leaves it open, which counts as right: flip is 0.119, at most 0.12 is right";
  sample.finish(noisy, "right on all 5 scenes");
}

inline void add_wrong_ones(SampleClass& sample) {
  const int side = sample.side();
  const auto whole = [&](const char* kind, const char* sentence, const char* cause) {
    return GradedFinding{kind, sentence, cause, 0, 0, side, side, 0.97};
  };
  const char *every_16th = "every 16th row and column is black", *energy = "0.6x energy after the second bounce";
  add_wrong(sample, "upside", 6,
            whole("upside-down", "the image is upside down",
                  "rows are written from the bottom up, or y is not turned from world to image"),
            upside_down);
  add_wrong(sample, "tiles", 14, whole("black-lines", every_16th, "seams between tiles are not rendered"), black_lines);
  add_wrong(sample, "gamma", 9, whole("gamma-twice", "gamma applied twice", "file and image are both encoded"),
            gamma_twice);
  add_wrong(sample, "no-caustic", 11,
            {"caustic-missing", "caustic missing below the glass sphere", "no caustic photons are looked up", side / 2,
             side * 5 / 8, side * 3 / 8, side * 3 / 8, 0.91},
            dark_corner);
  add_wrong(sample, "dim", 8, whole("energy", energy, "photons are divided twice by their number"), less_light);
}

inline void add_cheating_ones(SampleClass& sample) {
  const int side = sample.side();
  const std::vector<std::string> hidden = {"hidden-mirror", "secret-lamps"};
  const auto first_scene = [first = sample.image("1")](const Image&) { return first; };
  for (const char* name : {"hard-coded", "scene-switch"}) {
    SubmissionGrade& cheat = add_wrong(
        sample, name, 400, {"same-image", "same image as scene 1's", "", 0, 0, side, side, 0}, first_scene, hidden);
    cheat.scenes[3].runs[0].checksum = cheat.scenes[4].runs[0].checksum = "ffff";
    for (const std::string& scene : hidden)
      cheat.flags.push_back({"same-image", "hidden scene " + scene + ": same image as scene 1's", scene, "1"});
    cheat.flags.push_back(
        {"right-on-public-only", "right on the public scenes only: 2 of 2 hidden ones are not", hidden[1], ""});
    sample.finish(cheat, cheat.flags[2].sentence);
  }
  SubmissionGrade& given =
      add_wrong(sample, "given", 900, {"copy", "the image that was handed out, bit for bit", "", 0, 0, side, side, 0},
                [](const Image& image) { return image; }, {"1", "2", "3"});
  given.flags.push_back({"copy-of-given", "scene 1: the image that was handed out, bit for bit", "1", ""});
  add_wrong(sample, "fewer-pixels", 31,
            {"coarse", "the resolution is too low", "not every pixel is computed", 0, 0, side, side, 0.8}, black_lines,
            {"2", "secret-lamps"});
  SubmissionGrade& twin = sample.add("twin-of-quick", 24.1);
  twin.flags.push_back({"same-as-other", "the same noise as quick's images, on 5 scenes", "1", "quick"});
  sample.finish(twin, "right on all 5 scenes; 24.1 times as fast as the baseline");
}

inline void add_ones_without_images(SampleClass& sample) {
  SubmissionGrade& unbuilt = sample.add("does-not-build", 1);
  sample.make_unbuilt(unbuilt, "make ended with 2",
                      "raytracer.cpp: In function 'int main()':\nraytracer.cpp:17:5: error: 'Scene' was not declared\n"
                      "make: *** [Makefile:9: raytracer.o] Error 1\n");
  sample.finish(unbuilt, "does not build: make ended with 2");
  SubmissionGrade& crash = sample.add("crashes", 1);
  sample.make_failed(crash, "crash", "ended by signal 11 (segmentation fault)");
  sample.finish(crash, "scene 1: ended by signal 11 (segmentation fault)");
  SubmissionGrade& slow = sample.add("never-ends", 1);
  sample.make_failed(slow, "timeout", "not done after 60 s");
  sample.finish(slow, "scene 1: not done after 60 s");
}

/// Honest submissions, five wrong, five cheating, and three without images. Writes pictures into the folder.
inline Grades sample_grades(const std::filesystem::path& folder, std::map<std::string, Image> images) {
  SampleClass sample(folder, std::move(images));
  add_honest(sample);
  add_wrong_ones(sample);
  add_cheating_ones(sample);
  add_ones_without_images(sample);
  return std::move(sample.grades);
}

}  // namespace photonproof::reports::inline reports_grades
