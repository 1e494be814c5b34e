#include "scenes/models/model_scene.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/version.h>

#include <assimp/Importer.hpp>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "scenes/base/input_error.h"
#include "scenes/files/atomic_file.h"
#include "scenes/meshes/ply.h"
#include "scenes/models/model_files.h"
#include "scenes/models/model_materials.h"
#include "scenes/xml/writer.h"

namespace photonproof::inline scenes_models {
namespace {

namespace fs = std::filesystem;

Vec3d vec(const aiVector3D& v) { return {double{v.x}, double{v.y}, double{v.z}}; }

Transform transform_of(const aiMatrix4x4& m) {
  Transform t;
  for (unsigned r = 0; r < 3; ++r)
    for (unsigned c = 0; c < 4; ++c) t.m[4 * r + c] = double{m[r][c]};
  return t;
}

/// The triangles, with v downwards as in images. Empty where there are none.
TriangleMesh mesh_of(const aiMesh& from) {
  TriangleMesh mesh;
  mesh.resize_positions(from.mNumVertices);
  for (unsigned i = 0; i < from.mNumVertices; ++i) mesh.positions[i] = Vec3f(vec(from.mVertices[i]));
  if (from.HasNormals())
    for (unsigned i = 0; i < from.mNumVertices; ++i) mesh.normals.push_back(Vec3f(vec(from.mNormals[i])));
  if (from.HasTextureCoords(0))
    for (unsigned i = 0; i < from.mNumVertices; ++i)
      mesh.uvs.push_back({from.mTextureCoords[0][i].x, 1 - from.mTextureCoords[0][i].y});
  for (unsigned i = 0; i < from.mNumFaces; ++i)
    if (const aiFace& face = from.mFaces[i]; face.mNumIndices == 3)
      mesh.triangles.push_back({face.mIndices[0], face.mIndices[1], face.mIndices[2]});
  return mesh;
}

class ModelScene {
 public:
  ModelScene(const aiScene& model, const fs::path& file, const fs::path& folder, bool allow_outside)
      : model_(model),
        folder_(folder),
        materials_(model, file.parent_path(), folder, allow_outside, scene_, remarks_) {}

  std::vector<std::string> write(const fs::path& file) {
    scene_.integrator.method = PathDescription{};
    for (unsigned i = 0; i < model_.mNumMaterials; ++i) {
      bsdfs_.push_back(materials_.bsdf(*model_.mMaterials[i], "material-" + std::to_string(i)));
      emissions_.push_back(ModelMaterials::emission(*model_.mMaterials[i]));
    }
    for (unsigned i = 0; i < model_.mNumMeshes; ++i) write_mesh(i);
    place(*model_.mRootNode, Transform());
    if (scene_.shapes.empty()) throw InputError(file.string(), "has no triangles");
    add_lights();
    const bool has_camera = add_camera();
    write_file_atomically(folder_ / "scene.xml",
                          has_camera ? write_scene(scene_) : without_sensor(write_scene(scene_)));
    return {remarks_.begin(), remarks_.end()};
  }

 private:
  void write_mesh(unsigned i) {
    MeshDescription description;
    description.filename = "mesh-" + std::to_string(i) + ".ply";
    const TriangleMesh mesh = mesh_of(*model_.mMeshes[i]);
    description.face_normals = mesh.normals.empty();
    meshes_.push_back(mesh.triangles.empty() ? std::nullopt : std::optional(description));
    if (!mesh.triangles.empty()) write_ply(folder_ / description.filename, mesh);
  }

  void place(const aiNode& node, const Transform& parent) {
    const Transform to_world = parent * transform_of(node.mTransformation);
    places_.emplace(node.mName.C_Str(), to_world);
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      const unsigned mesh = node.mMeshes[i], material = model_.mMeshes[mesh]->mMaterialIndex;
      if (!meshes_[mesh] || !to_world.inverse()) continue;
      ShapeDescription shape;
      shape.geometry = *meshes_[mesh];
      shape.to_world = to_world;
      shape.bsdf = bsdfs_.at(material);
      shape.radiance = emissions_.at(material);
      scene_.shapes.push_back(std::move(shape));
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) place(*node.mChildren[i], to_world);
  }

  Transform place_of(const aiString& node) const {
    const auto found = places_.find(node.C_Str());
    return found == places_.end() ? Transform() : found->second;
  }

  void add_lights() {
    for (unsigned i = 0; i < model_.mNumLights; ++i) add_light(*model_.mLights[i]);
    bool lit = !scene_.emitters.empty();
    for (const ShapeDescription& shape : scene_.shapes) lit = lit || shape.radiance.has_value();
    if (lit) return;
    scene_.emitters.push_back({{}, "", ConstantLightDescription{}});
    remarks_.insert("no light: white light of radiance 1 comes from all around");
  }

  void add_light(const aiLight& light) {
    const Transform place = place_of(light.mName);
    const RgbD power(double{light.mColorDiffuse.r}, double{light.mColorDiffuse.g}, double{light.mColorDiffuse.b});
    const Vec3d position = place.point(vec(light.mPosition)), direction = place.vector(vec(light.mDirection));
    if (light.mType == aiLightSource_POINT) {
      scene_.emitters.push_back({{}, "", PointLightDescription{position, power}});
    } else if (light.mType == aiLightSource_DIRECTIONAL && length(direction) > 0) {
      scene_.emitters.push_back({{}, "", DirectionalLightDescription{normalize(direction), power}});
    } else if (light.mType == aiLightSource_SPOT && length(direction) > 0) {
      SpotLightDescription spot;
      const Vec3d d = normalize(direction);
      spot.to_world = Transform::look_at(position, position + d, std::abs(d.y) < 0.9 ? Vec3d(0, 1, 0) : Vec3d(1, 0, 0));
      spot.intensity = power;
      spot.cutoff_degrees = std::clamp(double{light.mAngleOuterCone} * 180 / std::numbers::pi, 0.1, 89.0);
      spot.beam_degrees = std::clamp(double{light.mAngleInnerCone} * 180 / std::numbers::pi, 0.0, spot.cutoff_degrees);
      scene_.emitters.push_back({{}, "", spot});
    } else {
      remarks_.insert("a light is left out, that is neither point, spot nor directional");
      return;
    }
    remarks_.insert("lights: candela count as W sr^-1, lux as W m^-2");
  }

  /// False where the model has none; the parser then supplies one.
  bool add_camera() {
    scene_.sensor.film.filter = {ReconstructionFilter::Kind::gaussian};
    if (model_.mNumCameras == 0) return false;
    const aiCamera& from = *model_.mCameras[0];
    if (model_.mNumCameras > 1) remarks_.insert("the first of several cameras");
    // assimp repeats the node's translation in mPosition, so these are glTF's own definitions.
    const Transform place = place_of(from.mName);
    const Vec3d eye = place.point({0, 0, 0}), look = place.vector({0, 0, -1}), up = place.vector({0, 1, 0});
    if (!(length(cross(look, up)) > 0)) return false;
    PerspectiveDescription camera;
    camera.fov_degrees = std::clamp(vertical_field(from) * 180 / std::numbers::pi, 1.0, 179.0);
    camera.fov_axis = FovAxis::y;
    if (from.mClipPlaneNear > 0) camera.near_clip = double{from.mClipPlaneNear};
    if (from.mClipPlaneFar > from.mClipPlaneNear) camera.far_clip = double{from.mClipPlaneFar};
    scene_.sensor.camera = camera;
    scene_.sensor.to_world = Transform::look_at(eye, eye + look, up);
    if (from.mAspect > 0.01f && from.mAspect < 100)
      scene_.sensor.film.height =
          std::max(1, static_cast<int>(std::lround(static_cast<float>(scene_.sensor.film.width) / from.mAspect)));
    return true;
  }

  /// glTF's yfov, of which assimp up to 5.2 keeps the product with the aspect, and later versions the field along x.
  static double vertical_field(const aiCamera& camera) {
    const double along_x = double{camera.mHorizontalFOV}, aspect = camera.mAspect > 0 ? double{camera.mAspect} : 1;
    const bool is_product = aiGetVersionMajor() < 5 || (aiGetVersionMajor() == 5 && aiGetVersionMinor() <= 2);
    return is_product ? along_x / aspect : 2 * std::atan(std::tan(along_x / 2) / aspect);
  }

  static std::string without_sensor(std::string xml) {
    const std::size_t begin = xml.find("  <sensor "), end = xml.find("</sensor>\n", begin);
    return xml.erase(begin, end + 10 - begin);
  }

  const aiScene& model_;
  fs::path folder_;
  SceneDescription scene_;
  std::set<std::string> remarks_;
  ModelMaterials materials_;
  std::vector<BsdfIndex> bsdfs_;
  std::vector<std::optional<Colour>> emissions_;
  std::vector<std::optional<MeshDescription>> meshes_;
  std::map<std::string, Transform> places_;
};

}  // namespace

std::vector<std::string> write_model_scene(const fs::path& model, const fs::path& folder, bool allow_outside) {
  Assimp::Importer importer;
  importer.SetIOHandler(new ModelFiles(model.parent_path(), allow_outside));  // which the importer deletes
  const aiScene* scene = importer.ReadFile(
      model.string(), aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_ValidateDataStructure);
  if (!scene || !scene->mRootNode) {
    std::string why = importer.GetErrorString();
    throw InputError(model.string(), "cannot be read as a model: " + why.substr(0, why.find('\n')));
  }
  return ModelScene(*scene, model, folder, allow_outside).write(model);
}

}  // namespace photonproof::inline scenes_models
