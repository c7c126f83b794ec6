// What other libraries are given; tests/python reads it as they do.
#include "stages/tools/repertoire_formats.h"

#include <gmock/gmock.h>

#include <cstring>
#include <limits>

#include "pipeline/artifact/content.h"
#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/artifact/repertoire_file.h"
#include "pipeline/core/check.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

using testing::HasSubstr;

class RepertoireFormats : public testing::Test {
 protected:
  RepertoireFormats() {
    elites.solution = Rows{{0.5f, 0.1f}, {1, 0}};
    elites.objective = Eigen::Vector2f(-1.5f, 0);
    elites.measures = Rows{{0.25f}, {0.75f}};
    elites.id = {3, 8};
    elites.parent = {-1, 3};
  }
  StoredRepertoire stored(const std::vector<float>& centroids) {
    Hdf5Writer file(path);
    write_elites(file, elites, {});
    if (!centroids.empty()) file.write("centroids", {centroids.size(), 1}, centroids.data());
    file.close();
    return read_repertoire(path);
  }
  TemporaryFolder folder_;
  const std::filesystem::path path = folder_.path() / "00.h5";
  Elites elites;
};

TEST_F(RepertoireFormats, ACsvHasTheColumnsOfPyribs) {
  EXPECT_EQ(pyribs_csv(stored({})),
            "solution_0,solution_1,objective,measures_0,id,parent,index\n"
            "0.5,0.1,-1.5,0.25,3,-1,0\n"
            "1,0,0,0.75,8,3,1\n");
  elites.length = {2, 1};
  elites.uncertainty = Eigen::Vector2f(1, 2);
  EXPECT_EQ(pyribs_csv(stored({0.8f, 0.5f, 0.2f})),
            "solution_0,solution_1,objective,measures_0,id,parent,length,uncertainty,index\n"
            "0.5,0.1,-1.5,0.25,3,-1,2,1,2\n"
            "1,0,0,0.75,8,3,1,2,0\n");
}

TEST_F(RepertoireFormats, ACellOfQdaxMayBeEmpty) {
  write_qdax(stored({0.8f, 0.5f, 0.2f}), folder_.path() / "qdax");
  const std::string bytes = read_whole(folder_.path() / "qdax/fitnesses.npy");
  EXPECT_THAT(bytes, HasSubstr("'shape': (3, 1)"));
  ASSERT_EQ(bytes.size() % 64, 3 * sizeof(float));
  float values[3];
  std::memcpy(values, &bytes[bytes.size() - sizeof values], sizeof values);
  EXPECT_EQ(values[0], 0);
  EXPECT_EQ(values[1], -std::numeric_limits<float>::infinity());
  EXPECT_EQ(values[2], -1.5f);
}

TEST_F(RepertoireFormats, TwoElitesInACellAreTold) {
  EXPECT_THAT([&] { stored({0.5f}); },
              testing::ThrowsMessage<InputError>(HasSubstr("the elites 3 and 8 are nearest to centroid 0")));
  Hdf5Writer file(path);
  write_elites(file, elites, {});
  file.write("centroids", {1, 2}, std::vector<float>{0, 0}.data());
  file.close();
  EXPECT_THAT(
      [&] { read_repertoire(path); },
      testing::ThrowsMessage<InputError>(HasSubstr("centroids: expected cells x 1 numbers, found [1, 2]")));
}

}  // namespace
}  // namespace hbr
