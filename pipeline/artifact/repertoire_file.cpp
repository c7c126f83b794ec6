#include "pipeline/artifact/repertoire_file.h"

#include <algorithm>
#include <cmath>

#include "pipeline/core/check.h"

namespace hbr::inline artifact {
namespace {

std::size_t count(Eigen::Index n) { return static_cast<std::size_t>(n); }

void write_rows(Hdf5Writer& file, const char* name, const Rows& rows) {
  file.write(name, {count(rows.rows()), count(rows.cols())}, rows.data());
}

// Reads the arrays of one repertoire: all as long as `measures`.
class ElitesReader {
 public:
  explicit ElitesReader(const Hdf5Reader& file) : file_(file) {}

  [[noreturn]] void fail(const char* name, const std::string& reason) const {
    throw InputError("{}: {}: {}", file_.path().string(), name, reason);
  }
  Rows rows(const char* name) {
    const Array<float> array = read<float>(name, 2);
    return Eigen::Map<const Rows>(array.values.data(), static_cast<Eigen::Index>(array.shape[0]),
                                  static_cast<Eigen::Index>(array.shape[1]));
  }
  Eigen::VectorXf column(const char* name) {
    const Array<float> array = read<float>(name, 1);
    return Eigen::Map<const Eigen::VectorXf>(array.values.data(), static_cast<Eigen::Index>(array.shape[0]));
  }
  template <class T>
  std::vector<T> integers(const char* name) {
    return read<T>(name, 1).values;
  }

 private:
  template <class T>
  Array<T> read(const char* name, std::size_t rank) {
    Array<T> array = file_.read<T>(name);
    if (array.shape.size() != rank)
      fail(name, fmt::format("expected {} dimensions, found {}", rank, array.shape.size()));
    if (!known_) elites_ = array.shape[0];
    known_ = true;
    if (array.shape[0] != elites_)
      fail(name, fmt::format("expected {} rows, one for each elite, found {}", elites_, array.shape[0]));
    if constexpr (std::is_same_v<T, float>) {
      const auto bad = std::find_if_not(array.values.begin(), array.values.end(),
                                        [](float value) { return std::isfinite(value); });
      if (bad != array.values.end())
        fail(name,
             fmt::format("expected finite numbers, found {} at place {}", *bad, bad - array.values.begin()));
    }
    return array;
  }

  const Hdf5Reader& file_;
  bool known_ = false;
  std::size_t elites_ = 0;
};

}  // namespace

void write_elites(Hdf5Writer& file, const Elites& elites, const std::vector<ProgressRow>& progress) {
  const std::size_t n = count(elites.size());
  HBR_CHECK(count(elites.solution.rows()) == n && count(elites.objective.size()) == n &&
                elites.id.size() == n && elites.parent.size() == n &&
                (elites.length.empty() || elites.length.size() == n) &&
                (elites.uncertainty.size() == 0 || count(elites.uncertainty.size()) == n),
            "arrays of unequal lengths: {} measures, {} solutions, {} ids", n, elites.solution.rows(),
            elites.id.size());
  write_rows(file, "solution", elites.solution);
  if (!elites.length.empty()) file.write("length", elites.length);
  file.write("objective", {n}, elites.objective.data());
  write_rows(file, "measures", elites.measures);
  file.write("id", elites.id);
  file.write("parent", elites.parent);
  if (elites.uncertainty.size() > 0) file.write("uncertainty", {n}, elites.uncertainty.data());

  std::vector<std::int64_t> generation, size, evaluations;
  std::vector<double> best, mean;
  for (const ProgressRow& row : progress) {
    generation.push_back(row.generation);
    size.push_back(row.size);
    best.push_back(row.best);
    mean.push_back(row.mean);
    evaluations.push_back(row.evaluations);
  }
  file.write("progress/generation", generation);
  file.write("progress/size", size);
  file.write("progress/best", best);
  file.write("progress/mean", mean);
  file.write("progress/evaluations", evaluations);
}

Elites read_elites(const std::filesystem::path& path) {
  const Hdf5Reader file(path);
  ElitesReader reader(file);
  Elites elites;
  elites.measures = reader.rows("measures");
  elites.solution = reader.rows("solution");
  elites.objective = reader.column("objective");
  elites.id = reader.integers<std::int64_t>("id");
  elites.parent = reader.integers<std::int64_t>("parent");
  if (file.has("length")) elites.length = reader.integers<std::int32_t>("length");
  if (file.has("uncertainty")) elites.uncertainty = reader.column("uncertainty");

  if (elites.solution.size() > 0 && (elites.solution.minCoeff() < 0 || elites.solution.maxCoeff() > 1))
    reader.fail("solution", fmt::format("expected genes in [0, 1], found {} to {}",
                                        elites.solution.minCoeff(), elites.solution.maxCoeff()));
  for (std::size_t i = 0; i < elites.id.size(); ++i) {
    const std::int64_t before = i ? elites.id[i - 1] : -1;
    if (elites.id[i] <= before)
      reader.fail("id", fmt::format("expected ascending ids from 0, found {} after {} in row {}",
                                    elites.id[i], before, i));
    if (elites.parent[i] < -1 || elites.parent[i] >= elites.id[i])
      reader.fail("parent", fmt::format("expected -1 or an id below the child's {}, found {} in row {}",
                                        elites.id[i], elites.parent[i], i));
    if (!elites.length.empty() && (elites.length[i] < 1 || elites.length[i] > elites.solution.cols()))
      reader.fail("length", fmt::format("expected 1 to {} genes, found {} in row {}", elites.solution.cols(),
                                        elites.length[i], i));
  }
  return elites;
}

std::vector<ProgressRow> read_progress(const std::filesystem::path& path) {
  const Hdf5Reader file(path);
  const auto generation = file.read<std::int64_t>("progress/generation").values;
  const auto size = file.read<std::int64_t>("progress/size").values;
  const auto best = file.read<double>("progress/best").values;
  const auto mean = file.read<double>("progress/mean").values;
  const auto evaluations = file.read<std::int64_t>("progress/evaluations").values;
  const std::size_t n = generation.size();
  if (size.size() != n || best.size() != n || mean.size() != n || evaluations.size() != n)
    throw InputError("{}: progress: expected arrays of one length, found {}, {}, {}, {}, {}", path.string(),
                     n, size.size(), best.size(), mean.size(), evaluations.size());
  std::vector<ProgressRow> rows(n);
  for (std::size_t i = 0; i < n; ++i) rows[i] = {generation[i], size[i], best[i], mean[i], evaluations[i]};
  return rows;
}

}  // namespace hbr::inline artifact
