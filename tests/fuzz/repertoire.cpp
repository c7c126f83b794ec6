// A repertoire in its HDF5 file.
#include "pipeline/artifact/repertoire_file.h"

#include "tests/fuzz/fuzz.h"

namespace hbr::fuzz {

std::vector<std::string> examples() {
  Elites elites;
  elites.solution = Rows::Constant(3, 2, 0.5f);
  elites.measures = Rows::Constant(3, 2, 0.25f);
  elites.objective = elites.uncertainty = Eigen::VectorXf::Constant(3, -0.5f);
  elites.id = {0, 2, 5};
  elites.parent = {-1, 0, 2};
  elites.length = {1, 2, 2};
  const std::string path = folder() / "example.h5";
  Hdf5Writer file(path);
  file.attribute("settings", std::string("{}"));
  file.attribute("spacing", 0.5);
  write_elites(file, elites, {{0, 3, -0.5, -0.5, 20}});
  file.close();
  return {content_of_file(path)};
}

void read(const std::string& bytes) {
  const std::filesystem::path path = written("repertoire.h5", bytes);
  and_go_on([&] { read_elites(path); });
  and_go_on([&] { read_progress(path); });
  const Hdf5Reader file(path);
  and_go_on([&] { file.children("/"); });
  and_go_on([&] { file.text_attribute("settings"); });
  and_go_on([&] { file.number_attribute("spacing"); });
}

}  // namespace hbr::fuzz
