#include "models/robot/looks/mesh_file.h"

#include <assimp/GltfMaterial.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <assimp/Exporter.hpp>
#include <assimp/Importer.hpp>
#include <numbers>

#include "models/robot/description/find_mesh.h"
#include "models/robot/looks/mesh_bytes.h"
#include "models/robot/looks/shapes.h"
#include "pipeline/core/check.h"
#include "pipeline/process/own_process.h"

namespace hbr::inline robots {
namespace {

namespace fs = std::filesystem;

Eigen::Vector3f vector(const aiVector3D& v) { return {v.x, v.y, v.z}; }
aiVector3D ai(const Eigen::Vector3f& v) { return {v[0], v[1], v[2]}; }

Mesh mesh_from(const aiMesh& in, const aiScene& scene, const Eigen::Vector3f& uncoloured) {
  Mesh mesh;
  for (unsigned i = 0; i < in.mNumVertices; ++i) {
    mesh.vertices.push_back(vector(in.mVertices[i]));
    if (!mesh.vertices.back().allFinite()) throw InputError("a vertex is not finite");
  }
  for (unsigned i = 0; i < in.mNumFaces; ++i) {
    const aiFace& face = in.mFaces[i];
    if (face.mNumIndices != 3) continue;
    for (int k = 0; k < 3; ++k)
      if (face.mIndices[k] >= in.mNumVertices)
        throw InputError("a triangle names vertex {}, but there are {}", face.mIndices[k], in.mNumVertices);
    mesh.triangles.emplace_back(face.mIndices[0], face.mIndices[1], face.mIndices[2]);
  }
  if (in.HasNormals())
    for (unsigned i = 0; i < in.mNumVertices; ++i)
      mesh.normals.push_back(vector(in.mNormals[i]).stableNormalized());
  else
    smooth_normals(mesh);
  mend_normals(mesh);
  mesh.colour = uncoloured;
  aiColor4D colour;
  const aiMaterial& material = *scene.mMaterials[in.mMaterialIndex];
  if (std::string(material.GetName().C_Str()) != AI_DEFAULT_MATERIAL_NAME &&
      material.Get(AI_MATKEY_COLOR_DIFFUSE, colour) == AI_SUCCESS &&
      !(colour.IsBlack() && material.GetTextureCount(aiTextureType_DIFFUSE) > 0))  // which would show on it
    mesh.colour = {colour.r, colour.g, colour.b};
  return mesh;
}

// What assimp finds in a file. Throws InputError, without the file's name, where that is no mesh.
std::vector<Mesh> read_scene(const fs::path& path, const Eigen::Vector3f& uncoloured) {
  Assimp::Importer importer;
  // A URDF's meshes are in their link's axes: like other readers of URDFs, we leave a DAE's <up_axis> alone.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, true);
  const aiScene* scene =
      importer.ReadFile(path.string(), aiProcess_ValidateDataStructure | aiProcess_Triangulate |
                                           aiProcess_PreTransformVertices | aiProcess_JoinIdenticalVertices |
                                           aiProcess_GenSmoothNormals | aiProcess_SortByPType);
  const std::string why = importer.GetErrorString();
  if (why.find("bad_alloc") != std::string::npos) throw std::bad_alloc();
  if (why.starts_with("No suitable reader"))  // and the whole path again
    throw InputError("not a mesh that can be read: damaged, or not OBJ, STL, DAE, glTF or the like");
  if (!scene || (scene->mFlags & AI_SCENE_FLAGS_INCOMPLETE))
    throw InputError("not a mesh that can be read: {}", why.substr(0, why.find('\n')));
  std::vector<Mesh> meshes;
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) {
    Mesh mesh = mesh_from(*scene->mMeshes[i], *scene, uncoloured);
    if (!mesh.triangles.empty()) meshes.push_back(std::move(mesh));
  }
  if (meshes.empty()) throw InputError("holds no triangle");
  return meshes;
}

constexpr float kLargest = 1e9f;  // m; squares must not overflow

aiMesh* mesh_to(const Mesh& mesh, unsigned material, const std::string& name) {
  auto* out = new aiMesh;
  out->mName = name;
  out->mPrimitiveTypes = aiPrimitiveType_TRIANGLE;
  out->mMaterialIndex = material;
  out->mNumVertices = static_cast<unsigned>(mesh.vertices.size());
  out->mVertices = new aiVector3D[out->mNumVertices];
  out->mNormals = new aiVector3D[out->mNumVertices];
  for (unsigned i = 0; i < out->mNumVertices; ++i) {
    out->mVertices[i] = ai(mesh.vertices[i]);
    out->mNormals[i] = ai(mesh.normals[i]);
  }
  out->mNumFaces = static_cast<unsigned>(mesh.triangles.size());
  out->mFaces = new aiFace[out->mNumFaces];
  for (unsigned i = 0; i < out->mNumFaces; ++i) {
    out->mFaces[i].mNumIndices = 3;
    out->mFaces[i].mIndices = new unsigned[3];
    for (int k = 0; k < 3; ++k) out->mFaces[i].mIndices[k] = static_cast<unsigned>(mesh.triangles[i][k]);
  }
  return out;
}

aiMaterial* material_to(const Eigen::Vector3f& colour, float opacity) {
  auto* material = new aiMaterial;
  const aiString name(fmt::format("colour-{:02x}{:02x}{:02x}", static_cast<int>(255 * colour[0]),
                                  static_cast<int>(255 * colour[1]), static_cast<int>(255 * colour[2])));
  const aiColor4D rgba(colour[0], colour[1], colour[2], opacity);
  const float metallic = 0, roughness = 0.5f;
  material->AddProperty(&name, AI_MATKEY_NAME);
  material->AddProperty(&rgba, 1, AI_MATKEY_COLOR_DIFFUSE);
  material->AddProperty(&rgba, 1, AI_MATKEY_BASE_COLOR);
  material->AddProperty(&metallic, 1, AI_MATKEY_METALLIC_FACTOR);
  material->AddProperty(&roughness, 1, AI_MATKEY_ROUGHNESS_FACTOR);
  if (opacity < 1) {
    const aiString blend("BLEND");
    material->AddProperty(&opacity, 1, AI_MATKEY_OPACITY);
    material->AddProperty(&blend, AI_MATKEY_GLTF_ALPHAMODE);
  }
  return material;
}

aiMatrix4x4 matrix(const Eigen::Isometry3d& pose) {
  const Eigen::Matrix4f m = pose.matrix().cast<float>();
  return {m(0, 0), m(0, 1), m(0, 2), m(0, 3), m(1, 0), m(1, 1), m(1, 2), m(1, 3),
          m(2, 0), m(2, 1), m(2, 2), m(2, 3), m(3, 0), m(3, 1), m(3, 2), m(3, 3)};
}

// assimp's arrays are owned by what points at them.
template <class T>
T** owned_array(const std::vector<T*>& items) {
  T** array = new T*[items.size()];
  std::copy(items.begin(), items.end(), array);
  return array;
}

}  // namespace

std::vector<Mesh> load_meshes(const fs::path& path, const Eigen::Vector3d& scale,
                              const Eigen::Vector3f& uncoloured) {
  std::error_code ignored;
  if (!fs::is_regular_file(path, ignored)) throw InputError("{}: no such mesh", path.string());
  // What assimp would read along, an artifact's key has to know: a file that tells assimp alone is refused.
  named_by_mesh(path);
  const std::size_t size = fs::file_size(path, ignored);
  // Damaged files make assimp crash, loop or ask for any amount of memory.
  const OwnProcess reader{(std::size_t{256} << 20) + 64 * size, static_cast<unsigned>(20 + (size >> 22))};
  std::vector<Mesh> meshes = unpacked(
      path.string(), reader.run(path.string(), [&] { return packed(read_scene(path, uncoloured)); }));
  const bool inside_out = scale.prod() < 0;
  for (Mesh& mesh : meshes) {
    for (Eigen::Vector3f& vertex : mesh.vertices) {
      vertex = vertex.cwiseProduct(scale.cast<float>());
      if (!(vertex.cwiseAbs().maxCoeff() <= kLargest))
        throw InputError("{}: at {:.3g} m from its origin; expected a mesh, by its scale, within {:g} m",
                         path.string(), vertex.norm(), kLargest);
    }
    for (Eigen::Vector3f& normal : mesh.normals)
      normal = normal.cwiseQuotient(scale.cast<float>()).stableNormalized();
    if (inside_out)
      for (Eigen::Vector3i& t : mesh.triangles) std::swap(t[1], t[2]);
  }
  return meshes;
}

std::vector<Mesh> visual_meshes(const RobotModel& model, const Link& link, const fs::path& folder,
                                double scale) {
  std::vector<Mesh> meshes;
  for (const Visual& visual : link.visuals) {
    std::vector<Mesh> parts;
    const Eigen::Vector3d& size = visual.size;
    if (visual.kind == Visual::Kind::mesh) {
      parts = load_meshes(find_mesh(visual.mesh, model.path, folder).path, scale * size,
                          visual.colour.value_or(Mesh().colour));
    } else {
      if (visual.kind == Visual::Kind::box) parts = {rounded_box(size, 0.05 * size.minCoeff())};
      if (visual.kind == Visual::Kind::cylinder)
        parts = {cylinder(size[0], size[2], 0.05 * std::min(size[0], size[2]))};
      if (visual.kind == Visual::Kind::capsule) parts = {capsule(size[0], size[2])};
      if (visual.kind == Visual::Kind::sphere) parts = {ellipsoid(size)};
      if (visual.colour) parts[0].colour = *visual.colour;
    }
    for (Mesh& part : parts) meshes.push_back(moved(std::move(part), visual.pose));
  }
  return meshes;
}

std::vector<std::vector<Mesh>> link_meshes(const RobotModel& model, const fs::path& folder, double scale) {
  std::vector<std::vector<Mesh>> result;
  for (const Link& link : model.links) result.push_back(visual_meshes(model, link, folder, scale));
  return result;
}

void save_scene(const fs::path& path, const std::string& format, const std::vector<Posed>& bodies) {
  aiScene scene;
  std::vector<aiMesh*> meshes;
  std::vector<aiMaterial*> materials;
  std::vector<aiNode*> nodes;
  std::vector<Eigen::Vector4f> colours;
  for (const Posed& body : bodies) {
    auto* node = new aiNode(body.name);
    node->mTransformation = matrix(body.pose);
    node->mNumMeshes = static_cast<unsigned>(body.meshes.size());
    node->mMeshes = new unsigned[node->mNumMeshes];
    for (unsigned i = 0; i < node->mNumMeshes; ++i) {
      const Mesh& mesh = body.meshes[i];
      const Eigen::Vector4f colour(mesh.colour[0], mesh.colour[1], mesh.colour[2], mesh.opacity);
      const auto known = std::find(colours.begin(), colours.end(), colour);
      const auto material = static_cast<unsigned>(known - colours.begin());
      if (known == colours.end()) {
        colours.push_back(colour);
        materials.push_back(material_to(mesh.colour, mesh.opacity));
      }
      node->mMeshes[i] = static_cast<unsigned>(meshes.size());
      meshes.push_back(mesh_to(mesh, material, fmt::format("{}-{}", body.name, i)));
    }
    nodes.push_back(node);
  }
  scene.mNumMeshes = static_cast<unsigned>(meshes.size());
  scene.mMeshes = owned_array(meshes);
  scene.mNumMaterials = static_cast<unsigned>(materials.size());
  scene.mMaterials = owned_array(materials);
  scene.mRootNode = new aiNode("scene");
  if (format == "glb2" || format == "gltf2")  // whose y is up; ours is z
    aiMatrix4x4::RotationX(-std::numbers::pi_v<float> / 2, scene.mRootNode->mTransformation);
  scene.mRootNode->addChildren(static_cast<unsigned>(nodes.size()), nodes.data());
  Assimp::Exporter exporter;
  if (exporter.Export(&scene, format, path.string()) != AI_SUCCESS)
    throw InputError("{}: can't be written: {}", path.string(), exporter.GetErrorString());
}

}  // namespace hbr::inline robots
