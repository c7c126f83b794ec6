// Good files with bytes lost, changed, moved or repeated: each is refused in one line or taken, none ends the
// program.
#include <gtest/gtest.h>

#include "models/robot/body/body.h"
#include "models/robot/looks/mesh_file.h"
#include "models/robot/looks/shapes.h"
#include "pipeline/core/check.h"
#include "pipeline/core/random.h"
#include "tests/models/robot/description/urdf_text.h"

namespace hbr {
namespace {

// Every other time a number becomes something else: other changes rarely get past the parser.
std::string damaged(std::string text, Rng& rng, bool number) {
  static const std::string words[] = {"nan",        "-1", "1e999", "1.0abc", "", "0",
                                      "4294967295", "<",  ">",     "{",      "]"};
  const auto somewhere = [&] { return rng.below(static_cast<std::uint32_t>(text.size())); };
  const std::uint32_t times = 1 + rng.below(3), kind = number ? 5 : rng.below(5);
  for (std::uint32_t i = 0; i < times && !text.empty(); ++i) {
    const std::size_t at = somewhere(), length = 1 + rng.below(40);
    switch (kind) {
      case 0:
        text.resize(at);
        break;
      case 1:
        text[at] = static_cast<char>(rng.below(256));
        break;
      case 2:
        text[at] = static_cast<char>(text[at] ^ (1 << rng.below(8)));
        break;
      case 3:
        text.erase(at, length);
        break;
      case 4:
        text.insert(somewhere(), text.substr(at, length));
        break;
      default: {
        const std::size_t begin = text.find_first_of("0123456789", at);
        if (begin == std::string::npos) break;
        const std::size_t end = text.find_first_not_of("0123456789.e-+", begin);
        text.replace(begin, end - begin, words[rng.below(std::size(words))]);
      }
    }
  }
  return text;
}

std::string read(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// How many of n damaged copies are refused; all in one line that names the file.
template <class Load>
int refused(const std::string& good, const std::filesystem::path& path, int n, Load&& load) {
  int count = 0;
  for (int i = 0; i < n; ++i) {
    Rng rng(Seed(1).child(path.filename().string()).child(static_cast<std::uint64_t>(i)));
    std::ofstream(path, std::ios::binary) << damaged(good, rng, i % 2);
    try {
      load(path);
    } catch (const InputError& error) {
      ++count;
      EXPECT_NE(std::string(error.what()).find(path.filename().string()), std::string::npos) << error.what();
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    } catch (const std::exception& error) {
      ADD_FAILURE() << path << " " << i << ": " << error.what();
    }
  }
  return count;
}

class DamagedUrdf : public testing::TestWithParam<const char*> {};

TEST_P(DamagedUrdf, IsRefusedOrTaken) {
  const TestFolder folder;
  constexpr int n = 200;
  const int count = refused(read(std::string(HBR_SOURCE_DIR "/models/") + GetParam()),
                            folder.path() / "a.urdf", n, [](const std::filesystem::path& path) {
                              const RobotModel model = load_urdf(path);
                              Body(model, model.independent_joints());
                            });
  EXPECT_GT(count, n / 3);
}
INSTANTIATE_TEST_SUITE_P(Files, DamagedUrdf,
                         testing::Values("nao/nao.urdf", "industrial/six_joint_arm.urdf"));

class DamagedMesh : public testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(DamagedMesh, IsRefusedOrTaken) {
  const auto [format, name] = GetParam();
  const TestFolder folder;
  const auto path = folder.path() / name;
  save_scene(path, format,
             {{"a", {coloured(rounded_box({1, 2, 3}, .1), {1, 0, 0})}}, {"b", {capsule(.1, 1)}}});
  constexpr int n = 50;
  const int count = refused(read(path), path, n, [](const std::filesystem::path& p) { load_meshes(p); });
  EXPECT_GT(count, n / 10);
}
INSTANTIATE_TEST_SUITE_P(Files, DamagedMesh,
                         testing::Values(std::pair{"obj", "a.obj"}, std::pair{"stl", "a.stl"},
                                         std::pair{"stlb", "b.stl"}, std::pair{"collada", "a.dae"},
                                         std::pair{"gltf2", "a.gltf"}, std::pair{"glb2", "a.glb"}),
                         [](const auto& file) { return std::string(file.param.first); });

}  // namespace
}  // namespace hbr
