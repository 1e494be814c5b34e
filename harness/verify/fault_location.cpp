#include "harness/verify/fault_location.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "harness/cells/cells.h"
#include "harness/diagnosis/places.h"
#include "harness/diagnosis/seen_objects.h"
#include "harness/verify/passes.h"
#include "harness/verify/picture_fault.h"
#include "scenes/description/file_names.h"
#include "scenes/files/atomic_file.h"
#include "scenes/xml/writer.h"

namespace photonproof::inline harness_verify {
namespace {

namespace fs = std::filesystem;

bool is_black(const EnginePicture& picture) {
  return std::ranges::all_of(picture.rendering.mean.rgb, [](float v) { return v == 0; });
}

/// Direct light contains a trace of light after two reflections. If that pass is off by far less than the whole, it is
/// not the faulty one.
bool is_a_trace(const std::string& name, double of_pass, double of_whole) {
  constexpr double part = 0.25;
  return name == "direct" && of_pass < part * of_whole;
}

void say(const PictureFault& picture, VerifyFault& fault) {
  fault.pass = picture.pass;
  fault.pass_words = picture.cause;
  fault.pass_sentence = picture.sentence;
}

std::string place_words(const SceneDescription& description, const EnginePicture& right, const EnginePicture& odd,
                        const PairTest& test) {
  const int width = right.rendering.mean.width, height = right.rendering.mean.height;
  std::vector<double> weight(right.rendering.mean.pixels());
  for (const FailingTile& tile : test.tiles)
    for (int y = tile.y; y < tile.y + tile.height; ++y)
      for (int x = tile.x; x < tile.x + tile.width; ++x)
        for (std::size_t c = 0; c < 3; ++c)
          weight[static_cast<std::size_t>(y * width + x)] +=
              std::abs(double{odd.rendering.mean.pixel(x, y)[c]} - double{right.rendering.mean.pixel(x, y)[c]});
  if (test.tiles.empty()) return "";
  SceneKnowledge knowledge;
  set_landmarks(knowledge, description, seen_points(description, width, height), width, height);
  return place_of(weight, width, height, knowledge);
}

}  // namespace

Image signed_difference(const Image& first, const Image& second) {
  double mean = 0;
  for (const float v : first.rgb) mean += double{v} / static_cast<double>(std::max<std::size_t>(1, first.rgb.size()));
  Image out(first.width, first.height);
  constexpr float bright[] = {1, 0.4f, 0.05f}, dark[] = {0.1f, 0.35f, 1};
  for (std::size_t i = 0; i < first.pixels(); ++i) {
    double off = 0, expected = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      off += double{second.rgb[3 * i + c]} - double{first.rgb[3 * i + c]};
      expected += std::abs(double{first.rgb[3 * i + c]});
    }
    const double relative = off / std::max(expected + 0.3 * mean, 1e-12);
    const auto strength = static_cast<float>(std::min(1.0, 4 * std::abs(relative)));
    for (std::size_t c = 0; c < 3; ++c) out.rgb[3 * i + c] = strength * (relative > 0 ? bright : dark)[c];
  }
  return out;
}

FaultLocator::FaultLocator(const EngineRenderer& renderer, const RenderedScene& scene,
                           const SceneDescription& description)
    : renderer_(renderer), scene_(scene), description_(description) {}

RenderedScene FaultLocator::write_pass(const std::string& name, const SceneDescription& pass) const {
  const std::string text = write_scene(with_absolute_files(pass));
  const fs::path folder = renderer_.options().folder / "passes" / scene_.name;
  fs::create_directories(folder);
  RenderedScene out;
  out.name = scene_.name + "-" + name;
  out.file = folder / (name + ".xml");
  write_file_atomically(out.file, text);
  out.content = content_key({{"pass", name}, {"of", scene_.content}, {"text", text}});
  out.width = scene_.width;
  out.height = scene_.height;
  return out;
}

void FaultLocator::draw(const EnginePicture& right, const EnginePicture& odd, const std::string& name,
                        VerifyFault& fault) const {
  const std::string stem = "pictures/" + scene_.name + "-" + odd.engine + "-" + name;
  double brightest = 0;
  for (const float v : right.rendering.mean.rgb) brightest += double{v} / double(right.rendering.mean.rgb.size());
  const double exposure = brightest > 0 ? std::log2(0.25 / brightest) : 0;
  const auto write = [&](const std::string& kind, const Image& image, double stops) {
    write_png((renderer_.options().folder / (stem + kind + ".png")).string(), image, stops);
    return stem + kind + ".png";
  };
  fault.right_picture = write("-right", right.rendering.mean, exposure);
  fault.odd_picture = write("-odd", odd.rendering.mean, exposure);
  fault.difference_picture = write("-difference", signed_difference(right.rendering.mean, odd.rendering.mean), 0);
}

void FaultLocator::look_for_pass(const Suspect& odd, const std::vector<Believed>& right, double of_whole,
                                 VerifyFault& fault) const {
  std::string not_rendered;
  for (const ScenePass& pass : passes_of(description_)) {
    RenderedScene scene = write_pass(pass.name, pass.scene);
    scene.description = &pass.scene;
    const EngineRender of_odd = renderer_.render(scene, odd.engine);
    std::optional<EnginePicture> of_right;
    for (const Believed& believed : right) {
      if (!of_odd.picture) break;
      if (believed.engine == nullptr) continue;
      if (of_right = renderer_.render(scene, *believed.engine).picture; of_right) break;
    }
    if (!of_odd.picture || !of_right) {
      not_rendered += (not_rendered.empty() ? "" : ", ") + pass.name;
      continue;
    }
    if (is_black(*of_right) && is_black(*of_odd.picture)) continue;
    const PairTest test = test_pair(*of_right, *of_odd.picture);
    if (!test.differs) continue;
    if (is_a_trace(pass.name, largest_difference(test, *of_right, *of_odd.picture), of_whole)) continue;
    fault.pass = pass.name;
    fault.pass_words = pass.words;
    fault.pass_sentence = test.sentence;
    if (const auto picture = picture_fault(*of_right, *of_odd.picture); picture && pass.name == "shapes")
      say(*picture, fault);
    draw(*of_right, *of_odd.picture, pass.name, fault);
    return;
  }
  fault.pass_words = "every pass agrees when rendered alone; only the whole image differs";
  if (!not_rendered.empty()) fault.pass_words += " (not rendered apart: " + not_rendered + ")";
}

VerifyFault FaultLocator::locate(const Suspect& odd, const std::vector<Believed>& right) const {
  VerifyFault fault;
  fault.engine = odd.engine.row.name;
  const EnginePicture& first = *right.front().picture;
  const PairTest whole = test_pair(first, odd.picture);
  fault.sentence = whole.sentence;
  fault.place = place_words(description_, first, odd.picture, whole);
  draw(first, odd.picture, "whole", fault);
  look_for_pass(odd, right, largest_difference(whole, first, odd.picture), fault);
  if (!fault.pass.empty()) return fault;
  if (const auto picture = picture_fault(first, odd.picture)) say(*picture, fault);
  return fault;
}

}  // namespace photonproof::inline harness_verify
