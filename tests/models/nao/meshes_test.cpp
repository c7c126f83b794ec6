// NAO's meshes as a user gets them: written, read through assimp, closed, outward, as tall as NAO.
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <numeric>
#include <set>

#include "models/nao/nao_meshes.h"
#include "models/robot/body/body.h"
#include "models/robot/description/find_mesh.h"
#include "models/robot/looks/mesh_file.h"
#include "tests/models/nao/right_arm.h"
#include "tests/models/robot/description/urdf_text.h"

namespace hbr {
namespace {

// Vertices at the same place made one.
std::vector<int> welded(const Mesh& mesh) {
  std::map<std::array<float, 3>, int> places;
  std::vector<int> result;
  for (const Eigen::Vector3f& v : mesh.vertices)
    result.push_back(
        places.emplace(std::array{v[0], v[1], v[2]}, static_cast<int>(places.size())).first->second);
  return result;
}

void expect_well_formed(const Mesh& mesh, const std::string& name) {
  const std::vector<int> place = welded(mesh);
  std::map<std::pair<int, int>, int> edges;
  std::vector<int> component(place.size());
  std::iota(component.begin(), component.end(), 0);
  const auto root = [&](int i) {
    while (component[i] != i) i = component[i] = component[component[i]];
    return i;
  };
  for (const Eigen::Vector3i& t : mesh.triangles) {
    const Eigen::Vector3d a = mesh.vertices[t[0]].cast<double>(), b = mesh.vertices[t[1]].cast<double>(),
                          c = mesh.vertices[t[2]].cast<double>();
    EXPECT_GT((b - a).cross(c - a).norm(), 1e-9) << name << ": a degenerate face at " << a.transpose();
    for (int k = 0; k < 3; ++k) {
      ++edges[{place[t[k]], place[t[(k + 1) % 3]]}];
      component[root(place[t[k]])] = root(place[t[0]]);
    }
  }
  for (const auto& [edge, count] : edges) {
    ASSERT_EQ(count, 1) << name << ": an edge with two faces on one side";
    ASSERT_EQ(edges.count({edge.second, edge.first}), 1u) << name << ": an open edge";
  }
  std::map<int, double> volume;
  for (const Eigen::Vector3i& t : mesh.triangles)
    volume[root(place[t[0]])] += mesh.vertices[t[0]].cast<double>().dot(
        mesh.vertices[t[1]].cast<double>().cross(mesh.vertices[t[2]].cast<double>()));
  for (const auto& [first, v] : volume) EXPECT_GT(v, 0) << name << ": a shell inside out";
  for (const Eigen::Vector3i& t : mesh.triangles) {
    const Eigen::Vector3f face =
        (mesh.vertices[t[1]] - mesh.vertices[t[0]]).cross(mesh.vertices[t[2]] - mesh.vertices[t[0]]);
    EXPECT_GT(face.dot(mesh.normals[t[0]] + mesh.normals[t[1]] + mesh.normals[t[2]]), 0)
        << name << ": a normal inwards";
  }
}

TEST(NaoMeshes, AreClosedAndFaceOutwards) {
  const TestFolder folder;
  write_nao_meshes(folder.path());
  const RobotModel model = load_urdf(kUrdf);
  std::set<std::array<float, 3>> colours;
  int files = 0;
  for (const Link& link : model.links)
    for (const Visual& visual : link.visuals) {
      ++files;
      for (const Mesh& mesh : load_meshes(find_mesh(visual.mesh, model.path, folder.path()).path)) {
        expect_well_formed(mesh, visual.mesh);
        colours.insert({mesh.colour[0], mesh.colour[1], mesh.colour[2]});
      }
    }
  EXPECT_EQ(files, 27);  // the torso and what each joint moves
  EXPECT_GE(colours.size(), 4u);
}

TEST(NaoMeshes, StandAsTallAsNao) {
  const TestFolder folder;
  write_nao_meshes(folder.path());
  const RobotModel model = load_urdf(kUrdf);
  const auto meshes = link_meshes(model, folder.path(), 1);
  const auto poses = Body(model, {"HeadYaw"}).link_poses(Eigen::VectorXd::Zero(1));
  double low = 1, high = -1;
  for (std::size_t i = 0; i < meshes.size(); ++i)
    for (const Mesh& mesh : meshes[i])
      for (const Eigen::Vector3f& v : mesh.vertices) {
        const double z = (poses[i] * v.cast<double>())[2];
        low = std::min(low, z), high = std::max(high, z);
      }
  EXPECT_NEAR(high - low, 0.574, 0.003);
  EXPECT_NEAR(low, poses[model.link("l_sole")].translation()[2], 0.001);
}

TEST(NaoMeshes, LeftAndRightMirrorEachOther) {
  const auto meshes = nao_meshes();
  for (const auto& [name, left] : meshes) {
    if (name[0] != 'L') continue;
    std::string mirror = name;
    mirror[0] = 'R';
    const auto& right = meshes.at(mirror);
    ASSERT_EQ(left.size(), right.size());
    for (std::size_t i = 0; i < left.size(); ++i) {
      const Mesh back = mirrored(right[i]);
      EXPECT_EQ(back.vertices, left[i].vertices) << name;
      EXPECT_EQ(back.triangles, left[i].triangles) << name;
    }
  }
}

TEST(NaoMeshes, AreTheSameBytesEveryTime) {
  const TestFolder one, two;
  write_nao_meshes(one.path());
  write_nao_meshes(two.path());
  for (const auto& entry : std::filesystem::directory_iterator(one.path())) {
    const auto text = [](const std::filesystem::path& path) {
      std::ifstream file(path, std::ios::binary);
      return std::string{std::istreambuf_iterator<char>(file), {}};
    };
    const std::string first = text(entry.path());
    EXPECT_EQ(first, text(two.path() / entry.path().filename()));
    EXPECT_EQ(first.find(one.path().string()), std::string::npos) << "names its folder";
  }
}

}  // namespace
}  // namespace hbr
