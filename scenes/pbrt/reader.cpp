#include "scenes/pbrt/reader.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <set>

#include "scenes/base/text_numbers.h"
#include "scenes/files/atomic_file.h"
#include "scenes/pbrt/lights.h"
#include "scenes/pbrt/media.h"
#include "scenes/pbrt/shapes.h"
#include "scenes/pbrt/views.h"

namespace photonproof::inline scenes_pbrt {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostIncludes = 10'000, kDeepestInclude = 32, kDeepestBlock = 1000;
constexpr std::size_t kMostText = std::size_t{2} << 30, kMostShapes = 10'000'000;

class PbrtReader {
 public:
  PbrtReader(PbrtSources& sources, PbrtLog& log, const fs::path& folder, const fs::path& made,
             const PbrtOptions& options)
      : sources_(sources),
        log_(log),
        files_(sources, folder, made, options.allow_outside),
        spectra_(sources, files_, log),
        context_{sources, log, files_, spectra_, scene_},
        textures_(context_),
        materials_(context_, textures_),
        shapes_(context_, textures_, materials_) {}

  SceneDescription read(std::string text, const std::string& name) {
    text_bytes_ = text.size();
    open_.push_back({PbrtTokens(sources_, sources_.add(name, std::move(text))), name});
    while (!open_.empty()) {
      PbrtTokens& tokens = open_.back().tokens;
      const PbrtToken token = tokens.next();
      if (token.kind == PbrtToken::Kind::end)
        open_.pop_back();
      else
        log_.attempt([&] {
          directive(tokens, token);
          check_place(token);
        });
    }
    finish();
    return std::move(scene_);
  }

 private:
  struct OpenFile {
    PbrtTokens tokens;
    std::string name;
  };
  using Handler = void (PbrtReader::*)(PbrtTokens&, const PbrtToken&);

  void directive(PbrtTokens& tokens, const PbrtToken& token);
  bool read_transform(PbrtTokens& tokens, const PbrtToken& token);
  bool read_block(PbrtTokens& tokens, const PbrtToken& token);
  bool read_setting(PbrtTokens& tokens, const PbrtToken& token);
  bool read_object(PbrtTokens& tokens, const PbrtToken& token);
  void begin_world(const PbrtToken& token);
  void begin_object(PbrtTokens& tokens, const PbrtToken& token);
  void instance(PbrtTokens& tokens, const PbrtToken& token);
  void include(PbrtTokens& tokens, const PbrtToken& token);
  void attribute(PbrtTokens& tokens);
  void skip_to_directive(PbrtTokens& tokens);
  void finish();

  std::string text(PbrtTokens& tokens, const char* what);
  std::vector<double> numbers(PbrtTokens& tokens, std::size_t count);
  PbrtEntity entity(PbrtTokens& tokens, const PbrtToken& token, const std::string& type, const char* kind);
  PbrtEntity typed(PbrtTokens& tokens, const PbrtToken& token, const char* kind);
  void times(const Transform& t) {
    if (moves_) state_.ctm = state_.ctm * t;
  }
  /// Larger numbers no file of ours may hold.
  void check_place(const PbrtToken& token) {
    constexpr double most = 1e30;
    if (std::all_of(state_.ctm.m.begin(), state_.ctm.m.end(), [](double v) { return std::abs(v) <= most; })) return;
    state_.ctm = Transform();
    sources_.fail(token.at, "the transform is too large");
  }
  void check_count(const PbrtToken& token) const {
    if (count_ >= kMostShapes) sources_.fail(token.at, "the scene has too many shapes");
  }

  PbrtSources& sources_;
  PbrtLog& log_;
  SceneDescription scene_;
  PbrtFiles files_;
  PbrtSpectra spectra_;
  PbrtContext context_;
  PbrtTextures textures_;
  PbrtMaterials materials_;
  PbrtShapes shapes_;

  std::vector<OpenFile> open_;
  std::size_t text_bytes_ = 0, includes_ = 0, count_ = 0;
  PbrtState state_;
  std::vector<std::pair<PbrtState, bool>> saved_;  ///< and whether by ObjectBegin
  std::map<std::string, Transform> systems_;
  std::map<std::string, ShapeGroupIndex> objects_;
  std::optional<ShapeGroupIndex> object_;  ///< between ObjectBegin and ObjectEnd
  PbrtViews views_;
  bool in_world_ = false, moves_ = true;
};

std::string PbrtReader::text(PbrtTokens& tokens, const char* what) {
  if (tokens.peek().kind != PbrtToken::Kind::text)
    sources_.fail(tokens.peek().at, std::string("expected ") + what + " in quotes");
  return tokens.next().text;
}

std::vector<double> PbrtReader::numbers(PbrtTokens& tokens, std::size_t count) {
  const bool in_brackets = tokens.peek().kind == PbrtToken::Kind::open;
  if (in_brackets) tokens.next();
  std::vector<double> result;
  while (result.size() < count) {
    const PbrtToken& token = tokens.peek();
    const Parsed<double> value = parse_number(token.word);
    if (token.kind != PbrtToken::Kind::word || !value.value)
      sources_.fail(token.at, "expected a number, " + std::to_string(count) + " of them");
    result.push_back(*value.value);
    tokens.next();
  }
  if (in_brackets && tokens.peek().kind != PbrtToken::Kind::close) sources_.fail(tokens.peek().at, "expected ']'");
  if (in_brackets) tokens.next();
  return result;
}

PbrtEntity PbrtReader::entity(PbrtTokens& tokens, const PbrtToken& token, const std::string& type, const char* kind) {
  PbrtParameters parameters(sources_, std::string(token.word) + " " + in_quotes(type), token.at);
  parameters.read(tokens, state_.colours);
  if (const auto defaults = state_.defaults.find(kind); defaults != state_.defaults.end())
    parameters.add_defaults(defaults->second);
  return {type, std::move(parameters), state_.ctm};
}

PbrtEntity PbrtReader::typed(PbrtTokens& tokens, const PbrtToken& token, const char* kind) {
  const std::string type = text(tokens, "a type");
  return entity(tokens, token, type, kind);
}

void PbrtReader::skip_to_directive(PbrtTokens& tokens) {
  const auto starts = [](const PbrtToken& t) {
    return t.kind == PbrtToken::Kind::end ||
           (t.kind == PbrtToken::Kind::word && !t.word.empty() && t.word[0] >= 'A' && t.word[0] <= 'Z');
  };
  while (!starts(tokens.peek())) tokens.next();
}

void PbrtReader::directive(PbrtTokens& tokens, const PbrtToken& token) {
  try {
    if (token.kind != PbrtToken::Kind::word) sources_.fail(token.at, "expected a directive");
    if (read_transform(tokens, token) || read_block(tokens, token) || read_setting(tokens, token) ||
        read_object(tokens, token))
      return;
    sources_.fail(token.at, "unknown directive " + in_quotes(token.word));
  } catch (const InputError&) {
    skip_to_directive(tokens);
    throw;
  }
}

bool PbrtReader::read_transform(PbrtTokens& tokens, const PbrtToken& token) {
  const std::string_view word = token.word;
  if (word == "Identity") {
    if (moves_) state_.ctm = Transform();
  } else if (word == "Translate") {
    const std::vector<double> n = numbers(tokens, 3);
    times(Transform::translate({n[0], n[1], n[2]}));
  } else if (word == "Scale") {
    const std::vector<double> n = numbers(tokens, 3);
    times(Transform::scale({n[0], n[1], n[2]}));
  } else if (word == "Rotate") {
    const std::vector<double> n = numbers(tokens, 4);
    if (n[1] == 0 && n[2] == 0 && n[3] == 0) sources_.fail(token.at, "Rotate has the axis 0");
    times(Transform::rotate({n[1], n[2], n[3]}, n[0]));
  } else if (word == "LookAt") {
    const std::vector<double> n = numbers(tokens, 9);
    const Vec3d eye(n[0], n[1], n[2]), to(n[3], n[4], n[5]), up(n[6], n[7], n[8]);
    if (!(length(cross(to - eye, up)) > 0)) sources_.fail(token.at, "LookAt looks along its up vector, or nowhere");
    // Our frame has the same numbers: +z forwards, +x is up x forwards. pbrt's directive is its inverse.
    const std::optional<Transform> inverse = Transform::look_at(eye, to, up).inverse();
    if (!inverse) sources_.fail(token.at, "LookAt has no inverse");
    times(*inverse);
  } else if (word == "Transform" || word == "ConcatTransform") {
    const std::vector<double> n = numbers(tokens, 16);
    if (n[3] != 0 || n[7] != 0 || n[11] != 0 || n[15] != 1) sources_.fail(token.at, "the matrix is not affine");
    Transform t;  // by columns in pbrt
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 4; ++c) t.m[4 * r + c] = n[4 * c + r];
    if (word == "ConcatTransform")
      times(t);
    else if (moves_)
      state_.ctm = t;
  } else if (word == "CoordinateSystem") {
    systems_[text(tokens, "a name")] = state_.ctm;
  } else if (word == "CoordSysTransform") {
    const std::string name = text(tokens, "a name");
    const auto found = systems_.find(name);
    if (found == systems_.end())
      sources_.fail(token.at, "the coordinate system " + in_quotes(name) + " is not defined");
    if (moves_) state_.ctm = found->second;
  } else {
    return false;
  }
  return true;
}

bool PbrtReader::read_block(PbrtTokens& tokens, const PbrtToken& token) {
  const std::string_view word = token.word;
  if (word == "AttributeBegin" || word == "TransformBegin") {
    if (saved_.size() >= kDeepestBlock) sources_.fail(token.at, "blocks are nested too deeply");
    saved_.push_back({state_, false});
  } else if (word == "AttributeEnd" || word == "TransformEnd") {
    if (saved_.empty() || saved_.back().second) sources_.fail(token.at, std::string(word) + " without its beginning");
    if (word == "TransformEnd")
      state_.ctm = saved_.back().first.ctm;
    else
      state_ = saved_.back().first;
    saved_.pop_back();
  } else if (word == "ObjectBegin") {
    begin_object(tokens, token);
  } else if (word == "ObjectEnd") {
    if (!object_ || saved_.empty() || !saved_.back().second) sources_.fail(token.at, "ObjectEnd without its beginning");
    state_ = saved_.back().first;
    saved_.pop_back();
    object_.reset();
  } else if (word == "WorldBegin") {
    begin_world(token);
  } else if (word == "WorldEnd") {
    // of older versions
  } else if (word == "Include" || word == "Import") {
    include(tokens, token);
  } else if (word == "Attribute") {
    attribute(tokens);
  } else {
    return false;
  }
  return true;
}

bool PbrtReader::read_setting(PbrtTokens& tokens, const PbrtToken& token) {
  const std::string_view word = token.word;
  std::optional<PbrtEntity>* view = word == "Camera"        ? &views_.camera
                                    : word == "Film"        ? &views_.film
                                    : word == "PixelFilter" ? &views_.filter
                                    : word == "Sampler"     ? &views_.sampler
                                    : word == "Integrator"  ? &views_.integrator
                                                            : nullptr;
  if (view != nullptr) {
    PbrtEntity given = typed(tokens, token, "");
    if (in_world_) sources_.fail(token.at, std::string(word) + " stands after WorldBegin");
    if (word == "Camera") {
      views_.camera_medium = state_.outside;
      if (const std::optional<Transform> from_camera = state_.ctm.inverse()) systems_["camera"] = *from_camera;
    }
    *view = std::move(given);
  } else if (word == "ColorSpace") {
    const std::string name = text(tokens, "a name");
    if (name != "srgb" && name != "rec2020" && name != "dci-p3")
      sources_.fail(token.at,
                    "the colour space " + in_quotes(name) + " is not supported, expected srgb, rec2020 or dci-p3");
    state_.colours = name == "srgb"      ? PbrtColours::srgb
                     : name == "rec2020" ? PbrtColours::rec2020
                                         : PbrtColours::dci_p3;
  } else if (word == "Option") {
    PbrtParameters option(sources_, "Option", token.at);
    option.read(tokens, state_.colours);  // they change how pbrt renders, not what
  } else if (word == "Accelerator") {
    typed(tokens, token, "");
  } else if (word == "ActiveTransform") {
    if (tokens.peek().kind != PbrtToken::Kind::word) sources_.fail(token.at, "expected StartTime, EndTime or All");
    moves_ = tokens.next().word != "EndTime";
    if (!moves_) log_.note(token.at, "nothing moves: everything stands where it starts");
  } else if (word == "TransformTimes") {
    numbers(tokens, 2);
  } else if (word == "ReverseOrientation") {
    state_.reverse = !state_.reverse;
  } else {
    return false;
  }
  return true;
}

bool PbrtReader::read_object(PbrtTokens& tokens, const PbrtToken& token) {
  const std::string_view word = token.word;
  const auto shared = [](PbrtEntity e) { return std::make_shared<const PbrtEntity>(std::move(e)); };
  if (word == "Shape") {
    const PbrtEntity shape = typed(tokens, token, "shape");
    if (!in_world_) sources_.fail(token.at, "Shape stands before WorldBegin");
    check_count(token);
    ++count_;
    shapes_.add(shape.type, shape.parameters, state_, object_ ? static_cast<int>(object_->value) : -1);
  } else if (word == "LightSource") {
    const PbrtEntity light = typed(tokens, token, "light");
    if (!in_world_) sources_.fail(token.at, "LightSource stands before WorldBegin");
    check_count(token);
    ++count_;
    add_pbrt_light(context_, light);
  } else if (word == "AreaLightSource") {
    state_.area_light = shared(typed(tokens, token, "light"));
  } else if (word == "Material") {
    state_.material = shared(typed(tokens, token, "material"));
    state_.named_material.clear();
  } else if (word == "NamedMaterial") {
    state_.named_material = text(tokens, "a name");
  } else if (word == "MakeNamedMaterial") {
    const std::string name = text(tokens, "a name");
    PbrtEntity material = entity(tokens, token, name, "material");
    material.type = material.parameters.text("type", "");
    if (material.type.empty()) material.parameters.fail("expected a \"string type\"");
    materials_.define(name, shared(std::move(material)));
  } else if (word == "Texture") {
    const std::string name = text(tokens, "a name"), kind = text(tokens, "float or spectrum");
    const std::string type = text(tokens, "a type");
    textures_.define(name, kind, entity(tokens, token, type, "texture"));
  } else if (word == "MakeNamedMedium") {
    const std::string name = text(tokens, "a name");
    add_pbrt_medium(context_, name, entity(tokens, token, name, "medium"));
  } else if (word == "MediumInterface") {
    state_.inside = text(tokens, "a name");
    state_.outside = tokens.peek().kind == PbrtToken::Kind::text ? tokens.next().text : state_.inside;
  } else if (word == "ObjectInstance") {
    instance(tokens, token);
  } else {
    return false;
  }
  return true;
}

void PbrtReader::begin_world(const PbrtToken& token) {
  if (in_world_) sources_.fail(token.at, "a second WorldBegin");
  in_world_ = true;
  add_pbrt_views(context_, views_);
  state_.ctm = Transform();
  moves_ = true;
  systems_["world"] = state_.ctm;
}

void PbrtReader::begin_object(PbrtTokens& tokens, const PbrtToken& token) {
  const std::string name = text(tokens, "a name");
  if (object_) sources_.fail(token.at, "an object within an object");
  if (saved_.size() >= kDeepestBlock) sources_.fail(token.at, "blocks are nested too deeply");
  if (objects_.contains(name)) sources_.fail(token.at, "the object " + in_quotes(name) + " is defined twice");
  saved_.push_back({state_, true});
  object_ = ShapeGroupIndex{static_cast<std::uint32_t>(scene_.groups.size())};
  objects_[name] = *object_;
  scene_.groups.push_back({{}, "object-" + std::to_string(object_->value), {}});
}

void PbrtReader::instance(PbrtTokens& tokens, const PbrtToken& token) {
  const std::string name = text(tokens, "a name");
  const auto found = objects_.find(name);
  if (found == objects_.end() || object_)
    sources_.fail(token.at,
                  object_ ? "an instance within an object" : "the object " + in_quotes(name) + " is not defined");
  check_count(token);
  ++count_;
  ShapeDescription shape;
  shape.geometry = InstanceDescription{found->second};
  shape.to_world = context_.to_ours * state_.ctm;
  if (!shape.to_world.inverse()) sources_.fail(token.at, "the instance is flattened by its transform");
  if (!scene_.groups[found->second.value].shapes.empty()) scene_.shapes.push_back(shape);
}

void PbrtReader::include(PbrtTokens& tokens, const PbrtToken& token) {
  const Place at = tokens.peek().at;
  const std::string name = text(tokens, "a file name");
  const fs::path file = files_.find(name, at);
  if (file.extension() == ".gz") sources_.fail(at, "the file is compressed, expected text");
  if (open_.size() >= kDeepestInclude || ++includes_ > kMostIncludes)
    sources_.fail(token.at, "too many files are included");
  for (const OpenFile& other : open_) {
    std::error_code ignored;
    if (fs::equivalent(other.name, file, ignored)) sources_.fail(at, "the file includes itself");
  }
  std::string content = read_file(file, kMostText);
  text_bytes_ += content.size();
  if (text_bytes_ > kMostText) sources_.fail(at, "the scene has more than 2 GiB of text");
  open_.push_back({PbrtTokens(sources_, sources_.add(file.string(), std::move(content))), file.string()});
}

void PbrtReader::attribute(PbrtTokens& tokens) {
  const Place at = tokens.peek().at;
  const std::string target = text(tokens, "shape, light, material, medium or texture");
  PbrtParameters given(sources_, "Attribute " + in_quotes(target), at);
  given.read(tokens, state_.colours);
  std::vector<PbrtParameter>& defaults = state_.defaults[target];
  for (const PbrtParameter& parameter : given.all()) {
    std::erase_if(defaults, [&](const PbrtParameter& other) { return other.name == parameter.name; });
    defaults.push_back(parameter);
  }
}

void PbrtReader::finish() {
  shapes_.finish();
  if (!in_world_) throw InputError(sources_.name(0), "has no WorldBegin: it is no scene of pbrt-v4");
  log_.attempt([&] { choose_pbrt_integrator(context_, views_); });
  if (const auto medium = context_.media.find(views_.camera_medium); medium != context_.media.end())
    scene_.sensor.medium = medium->second;
  const auto is_empty = [](const ShapeGroupDescription& group) { return group.shapes.empty(); };
  if (std::all_of(scene_.groups.begin(), scene_.groups.end(), is_empty)) scene_.groups.clear();
}

}  // namespace

SceneDescription read_pbrt(PbrtSources& sources, PbrtLog& log, std::string text, const std::string& name,
                           const fs::path& made, const PbrtOptions& options) {
  return PbrtReader(sources, log, fs::path(name).parent_path(), made, options).read(std::move(text), name);
}

}  // namespace photonproof::inline scenes_pbrt
