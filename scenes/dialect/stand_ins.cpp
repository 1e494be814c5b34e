#include "scenes/dialect/stand_ins.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>

#include "scenes/dialect/attribute_stand_ins.h"
#include "scenes/dialect/bsdf_stand_ins.h"
#include "scenes/dialect/colour_stand_ins.h"
#include "scenes/dialect/integrator_stand_ins.h"
#include "scenes/dialect/phase_stand_ins.h"
#include "scenes/dialect/sky_stand_ins.h"
#include "scenes/dialect/texture_stand_ins.h"

namespace photonproof::scene_xml {
namespace {

/// Parameters whose words count in any case.
constexpr std::array<std::string_view, 4> kWords = {"fov_axis", "pixel_format", "component_format", "file_format"};

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

bool is_any_of(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

class Translator {
 public:
  explicit Translator(const Sources& sources) : notes_(sources) {}

  std::vector<SceneNote> run(Element& root) {
    has_media_ = has_medium(root);
    put_colours_in_place_of_refs(root);
    put_textures_in_place_of_attributes(root);
    translate(root);
    return std::move(notes_.made);
  }

 private:
  static bool has_medium(const Element& element) {
    return element.tag == "medium" || std::ranges::any_of(element.children, has_medium);
  }

  /// Parents first, since some give way to a child.
  void translate(Element& element) {
    if (element.tag == "integrator") replace_integrator(element, has_media_, notes_);
    if (element.tag == "bsdf") replace_bsdf(element, notes_);
    if (element.tag == "film") translate_film(element);
    if (element.tag == "texture") replace_texture(element, notes_);
    if (element.tag == "shape") drop_smoothing(element);
    if (element.tag == "sensor") stop_shutter(element);
    if (element.tag == "medium") translate_medium(element);
    if (element.tag == "emitter") replace_sky(element, notes_);
    if (element.tag == "phase") replace_phase(element, notes_);
    drop_harmless(element);
    replace_colour(element);
    take_stand_in(element);
    lower_words(element);
    take_first_key(element);
    for (Element& child : element.children) translate(child);
    merge_shapes(element);
  }

  void take_stand_in(Element& element) {
    const auto row = std::ranges::find_if(
        stand_ins(), [&](const StandIn& r) { return r.tag == element.tag && r.type == value_of(element, "type"); });
    if (row == stand_ins().end()) return;
    if (!row->loss.empty()) notes_.add_stand_in(element, std::string(row->becomes), std::string(row->loss));
    set_attribute(element, "type", std::string(row->becomes));
    if (row->tag == "phase" || row->type == "retarder") element.children.clear();
    if (row->type == "telecentric") take_parameter(element, "aperture_radius");
  }

  /// Mitsuba 0.6 smooths edges below this angle by normals of its own.
  void drop_smoothing(Element& mesh) {
    if (const Element angle = take_parameter(mesh, "max_smooth_angle"); !angle.tag.empty())
      notes_.add(angle, "max_smooth_angle is left out: normals are the file's");
  }

  static void drop_harmless(Element& object) {
    for (const HarmlessParameter& row : harmless_parameters()) {
      const bool lens = row.name == "focus_distance" && value_of(object, "type") == "thinlens";
      if (row.tag == object.tag && !lens) take_parameter(object, row.name);
    }
  }

  static void lower_words(Element& object) {
    for (Element& child : object.children)
      if (child.tag == "string" && child.find("value") &&
          std::ranges::find(kWords, value_of(child, "name")) != kWords.end())
        set_attribute(child, "value", lower(value_of(child, "value")));
  }

  /// Mitsuba 0.6 calls the extinction `density`, and places its grids at the box of their files.
  static void translate_medium(Element& medium) {
    if (value_of(medium, "type") == "homogeneous")  // it fills its shape wherever its values' box is
      for (Element& child : medium.children)
        if (value_of(child, "type") == "constvolume") take_parameter(child, "to_world");
    Element* density = parameter_of(medium, "density");
    if (value_of(medium, "type") != "heterogeneous" || density == nullptr) return;
    for (Element& child : medium.children)
      if (child.tag == "volume" && value_of(child, "type") == "gridvolume" && !parameter_of(child, "use_grid_bbox"))
        add_parameter(child, "boolean", "use_grid_bbox", "true");
    set_attribute(*density, "name", "sigma_t");
  }

  void translate_film(Element& film) {
    rename_parameter(film, "high_quality_edges", "sample_border");
    const bool is_ours = value_of(film, "type") == "hdrfilm";
    if (!is_ours)
      for (const char* name : {"pixel_format", "component_format", "file_format", "digits", "variable"})
        take_parameter(film, name);
    if (Element* format = parameter_of(film, "pixel_format")) {
      const std::string given = lower(value_of(*format, "value"));
      if (is_any_of(given,
                    {"luminance", "luminance_alpha", "xyz", "xyza", "spectrum", "spectrumalpha", "luminancealpha"})) {
        const std::string becomes = given.back() == 'a' ? "rgba" : "rgb";
        notes_.add(*format, "pixel_format " + in_quotes(given) + " is written as " + becomes);
        set_attribute(*format, "value", becomes);
      }
    }
    // Images are written as float32, in the format of the output's name.
    if (const Element* format = parameter_of(film, "component_format"))
      if (is_any_of(lower(value_of(*format, "value")), {"uint32", "uint16", "uint8"}))
        take_parameter(film, "component_format");
    if (const Element* format = parameter_of(film, "file_format"))
      if (is_any_of(lower(value_of(*format, "value")), {"pfm", "rgbe", "hdr", "png", "jpeg", "jpg"}))
        take_parameter(film, "file_format");
  }

  void stop_shutter(Element& sensor) {
    bool rolls = false;
    for (const char* name : {"rolling_shutter_type", "rolling_shutter_duration"})
      rolls = !take_parameter(sensor, name).tag.empty() || rolls;
    if (rolls) notes_.add(sensor, "the rolling shutter is left out: nothing moves");
  }

  /// An animated transform stands still at its first key.
  void take_first_key(Element& object) {
    for (Element& child : object.children) {
      if (child.tag != "animation" || child.children.empty()) continue;
      notes_.add(child, "the animation stands still at its first key");
      Element first = child.children.front();
      std::erase_if(first.attributes, [](const Attribute& a) { return a.name == "time"; });
      set_attribute(first, "name", value_of(child, "name"));
      child = std::move(first);
    }
  }

  /// Shapes in a shape "merge" stand for themselves.
  static void merge_shapes(Element& scene) {
    std::vector<Element> children;
    for (Element& child : scene.children) {
      if (child.tag == "shape" && value_of(child, "type") == "merge")
        std::ranges::move(child.children, std::back_inserter(children));
      else
        children.push_back(std::move(child));
    }
    scene.children = std::move(children);
  }

  StandInNotes notes_;
  bool has_media_ = false;
};

}  // namespace

const std::vector<HarmlessParameter>& harmless_parameters() {
  static const std::vector<HarmlessParameter> table = {
      {"bsdf", "allow_transmission", "a check of Mitsuba's"},
      {"bsdf", "specular_sampling_weight", "how samples are drawn"},
      {"emitter", "cache", "how a file is read"},
      {"emitter", "gamma", "how a file is read"},
      {"emitter", "medium", "lights shine in the medium where they are"},
      {"emitter", "mis_compensation", "how samples are drawn"},
      {"emitter", "sampling_weight", "how lights are chosen"},
      {"film", "attach_log", "a log in the file"},
      {"film", "banner", "a banner in the picture"},
      {"film", "burn", "tone mapping: images are linear"},
      {"film", "compensate", "how sums are rounded"},
      {"film", "exposure", "tone mapping: images are linear"},
      {"film", "gamma", "tone mapping: images are linear"},
      {"film", "key", "tone mapping: images are linear"},
      {"film", "tonemap_method", "tone mapping: images are linear"},
      {"integrator", "block_size", "how work is cut"},
      {"integrator", "brute_force", "how samples are drawn"},
      {"integrator", "granularity", "how work is cut"},
      {"integrator", "light_image", "how samples are drawn"},
      {"integrator", "mis_compensation", "how samples are drawn"},
      {"integrator", "parallel_scatter", "how work is cut"},
      {"integrator", "sample_direct", "how samples are drawn"},
      {"integrator", "sample_emitters", "how samples are drawn"},
      {"integrator", "samples_per_pass", "how work is cut"},
      {"integrator", "timeout", "how long a render takes: --time"},
      {"integrator", "use_mis", "how samples are drawn"},
      {"integrator", "use_nee", "how samples are drawn"},
      {"medium", "has_spectral_extinction", "how samples are drawn"},
      {"medium", "method", "how samples are drawn"},
      {"medium", "sample_emitters", "how samples are drawn"},
      {"sampler", "dimension", "how samples are drawn"},
      {"sampler", "jitter", "how samples are drawn"},
      {"sampler", "scramble", "how samples are drawn"},
      {"sampler", "seed", "how samples are drawn: --seed"},
      {"sampler", "wrap", "how samples are drawn"},
      {"scene", "allow_thread_reordering", "how rays are sorted"},
      {"scene", "compact_acceleration_structures", "how rays meet shapes"},
      {"scene", "embree_use_robust_intersections", "how rays meet shapes"},
      {"scene", "kd_max_depth", "how rays meet shapes"},
      {"scene", "kd_min_max_bins", "how rays meet shapes"},
      {"scene", "kd_stop_primitives", "how rays meet shapes"},
      {"sensor", "aperture_shape", "lenses with blades"},
      {"sensor", "focus_distance", "without a lens everything is sharp"},
      {"shape", "collapse", "how a file is read"},
      {"shape", "load_materials", "how a file is read"},
      {"shape", "silhouette_sampling_weight", "of derivatives"},
      {"shape", "srgb", "colours at vertices"},
      {"shape", "vertex_merging", "how a file is read"},
      {"texture", "accel", "graphics processors"},
      {"texture", "cache", "how a file is read"},
      {"texture", "format", "graphics processors"},
      {"texture", "max_anisotropy", "filters of Mitsuba 0.6"},
      {"volume", "accel", "graphics processors"}};
  return table;
}

const std::vector<StandIn>& stand_ins() {
  static const std::vector<StandIn> table = {
      {"bsdf", "pplastic", "roughplastic", "without polarisation; light reflected inside comes out, too"},
      {"bsdf", "retarder", "null", "without polarisation"},
      {"film", "ldrfilm", "hdrfilm", "the image stays linear, without tone mapping"},
      {"film", "mfilm", "hdrfilm", ""},
      {"film", "tiledhdrfilm", "hdrfilm", ""},
      {"phase", "sggx", "isotropic", "without directions of flakes"},
      {"sensor", "telecentric", "orthographic", "everything is sharp"},
      {"sampler", "halton", "independent", ""},
      {"sampler", "hammersley", "independent", ""},
      {"sampler", "sobol", "independent", ""}};
  return table;
}

std::vector<SceneNote> use_stand_ins(const Sources& sources, Element& root) { return Translator(sources).run(root); }

}  // namespace photonproof::scene_xml
