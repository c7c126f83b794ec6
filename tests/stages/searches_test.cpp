// The comparison of searches as a program, on repertoires small enough to count by hand.
#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "pipeline/artifact/repertoire_file.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;

void write_points(const std::filesystem::path& path,
                  const std::vector<std::tuple<float, float, float>>& points) {
  Elites elites;
  const auto n = static_cast<Eigen::Index>(points.size());
  elites.solution = Rows::Constant(n, 8, 0.5f);
  elites.measures = Rows(n, 2);
  elites.objective = Eigen::VectorXf(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto& [x, y, fitness] = points[static_cast<std::size_t>(i)];
    elites.measures.row(i) << x, y;
    elites.objective[i] = fitness;
    elites.id.push_back(i);
    elites.parent.push_back(-1);
  }
  Hdf5Writer file(path);
  write_elites(file, elites, {{10, n, 0, 0, 100}});
  file.close();
}

TEST(Searches, AreComparedOnOneGrid) {
  const TemporaryFolder folder;
  write_points(folder.path() / "a0.h5", {{0.1f, 0.1f, -0.5f}, {0.2f, 0.2f, -0.25f}, {0.9f, 0.1f, -1}});
  write_points(folder.path() / "a1.h5", {{0.1f, 0.9f, -0.5f}});
  write_points(folder.path() / "b0.h5", {{0.9f, 0.3f, -0.125f}});
  const nlohmann::json slice = {{"stage", "searches"},
                                {"name", "searches"},
                                {"settings", {{"passive_cells", 2}, {"worst_fitness", -2}}},
                                {"inputs", {{"a/00", "a0.h5"}, {"a/01", "a1.h5"}, {"b/00", "b0.h5"}}},
                                {"output", "searches.h5"}};
  std::ofstream(folder.path() / "slice.json") << slice;
  const std::string command = "cd " + folder.path().string() +
                              " && " HBR_BINARY_DIR
                              "/bin/searches --root . --slice slice.json "
                              "--output searches.h5 --checkpoint checkpoint --threads 1";
  ASSERT_EQ(std::system(command.c_str()), 0);

  const Hdf5Reader file(folder.path() / "searches.h5");
  const auto values = [&](const char* name) { return file.read<double>(name).values; };
  EXPECT_EQ(file.number_attribute("filled_by_any"), 3);  // nobody is in the fourth quarter
  EXPECT_THAT(values("a/coverage"), ElementsAre(DoubleNear(2 / 3.0, 1e-12), DoubleNear(1 / 3.0, 1e-12)));
  EXPECT_THAT(values("a/qd_score"), ElementsAre(1.75 + 1, 1.5));
  EXPECT_THAT(values("a/cell_mean"), ElementsAre(-0.625, -0.5));
  EXPECT_THAT(values("b/coverage"), ElementsAre(DoubleNear(1 / 3.0, 1e-12)));
  EXPECT_THAT(values("b/qd_score"), ElementsAre(1.875));

  write_points(folder.path() / "b0.h5", {{0.9f, 0.3f, -3}});
  EXPECT_NE(std::system((command + " 2>refused").c_str()), 0);
  std::ostringstream refused;
  refused << std::ifstream(folder.path() / "refused").rdbuf();
  EXPECT_THAT(refused.str(),
              testing::HasSubstr("a fitness of -3; expected none below the worst there can be, -2"));
}

}  // namespace
}  // namespace hbr
