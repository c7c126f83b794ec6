#include "models/robot/looks/mesh_bytes.h"

#include <array>
#include <cstring>

#include "pipeline/core/check.h"

namespace hbr::inline robots {
namespace {

template <class Item>
void pack(std::string& bytes, const Item* items, std::size_t n) {
  bytes.append(reinterpret_cast<const char*>(items), n * sizeof(Item));
}

}  // namespace

std::string packed(const std::vector<Mesh>& meshes) {
  std::string bytes;
  for (const Mesh& mesh : meshes) {
    const std::size_t sizes[] = {mesh.vertices.size(), mesh.triangles.size()};
    pack(bytes, sizes, 2);
    pack(bytes, mesh.colour.data(), 3);
    pack(bytes, mesh.vertices.data(), sizes[0]);
    pack(bytes, mesh.normals.data(), sizes[0]);
    pack(bytes, mesh.triangles.data(), sizes[1]);
  }
  return bytes;
}

std::vector<Mesh> unpacked(const std::string& what, const std::string& bytes) {
  std::vector<Mesh> meshes;
  std::size_t at = 0;
  const auto damaged = [&] {
    return InputError("{}: the reader went astray on it; the file is damaged", what);
  };
  const auto take = [&](auto& items, std::size_t n) {
    if (n > (bytes.size() - at) / sizeof items[0]) throw damaged();
    if constexpr (requires { items.resize(n); }) items.resize(n);
    std::memcpy(static_cast<void*>(items.data()), bytes.data() + at, n * sizeof items[0]);
    at += n * sizeof items[0];
  };
  while (at < bytes.size()) {
    std::array<std::size_t, 2> sizes;
    take(sizes, 2);
    Mesh& mesh = meshes.emplace_back();
    std::array<float, 3> colour;
    take(colour, 3);
    mesh.colour = Eigen::Vector3f(colour.data());
    take(mesh.vertices, sizes[0]);
    take(mesh.normals, sizes[0]);
    take(mesh.triangles, sizes[1]);
    for (const Eigen::Vector3i& t : mesh.triangles)
      if (t.minCoeff() < 0 || static_cast<std::size_t>(t.maxCoeff()) >= sizes[0]) throw damaged();
  }
  return meshes;
}

}  // namespace hbr::inline robots
