#include "scenes/dialect/as_mitsuba.h"

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

#include "scenes/description/overloaded.h"
#include "scenes/dialect/element_edit.h"
#include "scenes/dialect/stand_in_notes.h"
#include "scenes/xml/values.h"

namespace photonproof::scene_xml {
namespace {

// --- rotations -------------------------------------------------------------------------------------------------------

/// Rodrigues' formula, c I + s [a]x + (1 - c) a a^T, with an axis of any length.
std::string rotation_text(const Vec3d& a, double degrees) {
  const double radians = degrees * std::numbers::pi / 180, s = std::sin(radians), c = std::cos(radians), v = 1 - c;
  const double rows[9] = {c + v * a.x * a.x,       v * a.x * a.y - s * a.z, v * a.x * a.z + s * a.y,
                          v * a.y * a.x + s * a.z, c + v * a.y * a.y,       v * a.y * a.z - s * a.x,
                          v * a.z * a.x - s * a.y, v * a.z * a.y + s * a.x, c + v * a.z * a.z};
  std::string text;
  for (const double entry : rows) text += (text.empty() ? "" : " ") + format_number(entry);
  return text;
}

class Rotations {
 public:
  explicit Rotations(const Sources& sources) : sources_(sources), notes_(sources) {}

  std::vector<SceneNote> run(Element& root) {
    visit(root);
    return std::move(notes_.made);
  }

 private:
  void visit(Element& element) {
    for (Element& child : element.children) visit(child);
    if (element.tag != "rotate" || !element.find("angle")) return;
    Vec3d axis;
    double degrees = 0;
    try {
      axis = xyz_of(sources_, element, 0.0);
      degrees = number_of(sources_, *element.find("angle"));
    } catch (const InputError&) {
      return;  // the parser tells it
    }
    constexpr double rounding = 1e-6;  // of an axis written with six digits
    if (axis == Vec3d(0.0) || std::abs(dot(axis, axis) - 1) < rounding) return;
    notes_.add(element, "as in Mitsuba, the axis of a rotate is not normalised: the matrix is no rotation");
    element.tag = "matrix";
    element.attributes.clear();
    set_attribute(element, "value", rotation_text(axis, degrees));
  }

  const Sources& sources_;
  StandInNotes notes_;
};

// --- textures read as numbers ----------------------------------------------------------------------------------------

/// Calls visit(Scalar&) for the parameters of a BSDF that are numbers.
template <class Visit>
void for_each_number(BsdfDescription& bsdf, const Visit& visit) {
  const auto all = [&](auto&... numbers) { (visit(numbers), ...); };
  std::visit(Overloaded{[&](RoughConductorDescription& d) { all(d.alpha_u, d.alpha_v); },
                        [&](RoughDielectricDescription& d) { all(d.alpha_u, d.alpha_v); },
                        [&](PhongDescription& d) { all(d.exponent); }, [&](MaskDescription& d) { all(d.opacity); },
                        [&](BlendDescription& d) { all(d.weight); },
                        [&](PrincipledDescription& d) {
                          all(d.roughness, d.anisotropic, d.metallic, d.spec_trans, d.spec_tint, d.sheen, d.sheen_tint,
                              d.flatness, d.clearcoat, d.clearcoat_gloss);
                        },
                        [&](PrincipledThinDescription& d) {
                          all(d.roughness, d.anisotropic, d.spec_trans, d.eta, d.spec_tint, d.sheen, d.sheen_tint,
                              d.flatness, d.diff_trans);
                        },
                        [](auto&) {}},
             bsdf.model);
}

class Follower {
 public:
  explicit Follower(SceneDescription& scene) : scene_(scene) {}

  void run() {
    scene_.as_mitsuba = true;
    const std::string file = scene_.files.empty() ? "scene" : scene_.files.front();
    scene_.notes.push_back(
        {file, "the image follows Mitsuba 3.9.1 where it departs from its documents or from a closed form"});
    for (std::size_t i = 0; i < scene_.bsdfs.size(); ++i) follow(scene_.bsdfs[i]);
    for (ShapeDescription& shape : scene_.shapes) follow(shape);
    for (ShapeGroupDescription& group : scene_.groups)
      for (ShapeDescription& shape : group.shapes) follow(shape);
    follow(scene_.sensor.film.filter);
  }

 private:
  void note(const SourceLoc& loc, const std::string& text) {
    scene_.notes.push_back({scene_.where(loc), "as in Mitsuba, " + text});
  }

  void follow(BsdfDescription& bsdf) {
    bool swapped = false;
    for_each_number(bsdf, [&](Scalar& number) {
      const auto* texture = std::get_if<TextureIndex>(&number);
      if (texture == nullptr || !has_board(*texture)) return;
      number = swapped_board(*texture);
      swapped = true;
    });
    if (swapped) note(bsdf.loc, "a checkerboard that is read as a number swaps its colours");
    if (auto* plastic = std::get_if<PlasticDescription>(&bsdf.model)) {
      plastic->fitted_inside = true;
      note(bsdf.loc, "the coat of plastic reflects from below by a fit");
    }
    if (auto* blend = std::get_if<BlendDescription>(&bsdf.model))
      if (mirrors(blend->first) != mirrors(blend->second)) {
        blend->mixes_mirrors = true;
        note(bsdf.loc, "a mirror's sample in a blend is weighted against the other BSDF's density");
      }
  }

  /// Whether a BSDF, or the front of a twosided one, mirrors and does nothing else that is smooth.
  bool mirrors(BsdfIndex index) const {
    const auto& model = scene_.bsdfs[index.value].model;
    if (const auto* both = std::get_if<TwoSidedDescription>(&model)) return mirrors(both->front);
    return std::holds_alternative<ConductorDescription>(model) ||
           std::holds_alternative<DielectricDescription>(model) ||
           std::holds_alternative<ThinDielectricDescription>(model);
  }

  void follow(ShapeDescription& shape) {
    const auto* mesh = std::get_if<MeshDescription>(&shape.geometry);
    if (mesh == nullptr) return;
    if (shape.to_world.determinant() < 0 && (mesh->face_normals || mesh->mesh->normals.empty())) {
      shape.flip_normals = !shape.flip_normals;
      note(shape.loc, "a mesh without normals of its own that to_world mirrors is turned inside out");
    }
    if (!shape.radiance || mesh->face_normals) return;
    if (std::holds_alternative<RgbD>(*shape.radiance)) {
      shape.emits_by_vertex_normals = true;
      note(shape.loc, "the mesh emits by its interpolated normals, and lights are chosen evenly");
    } else {
      note(shape.loc, "not followed: Mitsuba's two estimators of a mesh with a textured radiance disagree");
    }
  }

  void follow(ReconstructionFilter& filter) {
    if (filter.kind != ReconstructionFilter::Kind::tent || filter.radius != 0.5) return;
    filter = {.kind = ReconstructionFilter::Kind::box};
    note(scene_.sensor.loc, "a tent of half a pixel is a box");
  }

  bool has_board(TextureIndex index) const {
    const auto& pattern = scene_.textures[index.value].pattern;
    if (const auto* scaled = std::get_if<ScaledTextureDescription>(&pattern)) return has_board(scaled->texture);
    return std::holds_alternative<CheckerboardDescription>(pattern);
  }

  /// A copy of a texture whose checkerboards, also those within, are swapped.
  TextureIndex swapped_board(TextureIndex index) {
    if (const auto known = swapped_.find(index); known != swapped_.end()) return known->second;
    TextureDescription copy = scene_.textures[index.value];
    copy.id.clear();
    if (auto* scaled = std::get_if<ScaledTextureDescription>(&copy.pattern)) {
      scaled->texture = swapped_board(scaled->texture);
    } else if (auto* board = std::get_if<CheckerboardDescription>(&copy.pattern)) {
      for (Colour* colour : {&board->color0, &board->color1})
        if (const auto* nested = std::get_if<TextureIndex>(colour)) *colour = swapped_board(*nested);
      std::swap(board->color0, board->color1);
    } else {
      return index;
    }
    scene_.textures.push_back(std::move(copy));
    const TextureIndex made{static_cast<std::uint32_t>(scene_.textures.size() - 1)};
    swapped_[index] = made;
    return made;
  }

  SceneDescription& scene_;
  std::map<TextureIndex, TextureIndex> swapped_;
};

}  // namespace

std::vector<SceneNote> rotate_as_mitsuba(const Sources& sources, Element& root) { return Rotations(sources).run(root); }

void follow_mitsuba(SceneDescription& scene) { Follower(scene).run(); }

}  // namespace photonproof::scene_xml
