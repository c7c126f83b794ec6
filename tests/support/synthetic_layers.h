// Artifacts of searches, and of arrays around a value, as of an experiment that never ran.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/artifact/repertoire_file.h"
#include "pipeline/core/random.h"

namespace hbr {

class SyntheticLayers {
 public:
  SyntheticLayers(std::filesystem::path folder, int replications)
      : folder_(std::move(folder)), replications_(replications) {}

  // Name -> path, as the statistics stage gets them.
  const std::map<std::string, std::filesystem::path>& artifacts() const { return artifacts_; }

  // A search that grows to `size` elites by 1 - exp(-8 generation / generations), recorded 21 times; those it
  // ends with were born more slowly, by 1 - exp(-4 generation / generations), because some replaced others.
  void search(const std::string& stage, int size, int genes, double best, double mean, int generations,
              int samples = 1) {
    for (int r = 0; r < replications_; ++r) {
      Rng rng(Seed(1).child(stage).child(static_cast<std::uint64_t>(r)));
      const auto n = static_cast<Eigen::Index>(size * rng.uniform(0.97f, 1.03f));
      Elites elites;
      elites.solution = Rows::Constant(n, genes, 0.5f);
      elites.measures = Rows::Constant(n, 2, 0.5f);
      elites.objective = Eigen::VectorXf(n);
      const double shift = 1 + 0.02 * (rng.uniform_double() - 0.5);
      for (Eigen::Index i = 0; i < n; ++i) {
        const double u = static_cast<double>(i) / static_cast<double>(n > 1 ? n - 1 : 1);
        elites.objective[i] = static_cast<float>((best + 2 * (mean - best) * u) * shift);
        const double born = -std::log(1 - u * (1 - std::exp(-4.0))) / 4;
        const auto id = static_cast<std::int64_t>(born * (200.0 * generations - 1));
        elites.id.push_back(i > 0 ? std::max(elites.id.back() + 1, id) : id);
        elites.parent.push_back(-1);
      }
      std::vector<ProgressRow> progress;
      for (int step = 0; step <= 20; ++step) {
        const double grown = 1 - std::exp(-8.0 * step / 20), worse = 3 * std::exp(-8.0 * step / 20);
        progress.push_back({generations * step / 20,
                            step == 20 ? n : static_cast<std::int64_t>(grown * static_cast<double>(n)),
                            best * shift * (1 + worse), mean * shift * (1 + worse),
                            200L * generations * step / 20});
      }
      Hdf5Writer file(place(stage, r));
      write_elites(file, elites, progress);
      file.attribute("settings", settings_of(stage, samples));
      file.close();
    }
  }

  // Of the keys that a kind of layer asks for those that say how its genomes are executed.
  static std::string settings_of(const std::string& stage, int samples) {
    const bool sampled = stage.starts_with("layer2") || stage.starts_with("layer3");
    return fmt::format(R"({{"layer": {{{}{}}}}})", sampled ? fmt::format(R"("samples": {}, )", samples) : "",
                       sampled || stage == "reference4d" ? R"("starts": "elites")" : R"("cost": "")");
  }

  // Values around `middle`, 5 % wide, one array for each replication.
  void values(const std::string& stage, const std::string& array, double middle, int n) {
    arrays_[stage].push_back({array, middle, n});
  }

  void write_values() {
    for (const auto& [stage, arrays] : arrays_)
      for (int r = 0; r < replications_; ++r) {
        Hdf5Writer file(place(stage, r));
        for (const auto& [name, middle, n] : arrays) {
          Rng rng(Seed(2).child(stage).child(name).child(static_cast<std::uint64_t>(r)));
          std::vector<float> values;
          for (int i = 0; i < n; ++i)
            values.push_back(static_cast<float>(middle) * rng.uniform(0.95f, 1.05f));
          file.write(name, values);
        }
        file.close();
      }
  }

 protected:
  std::filesystem::path place(const std::string& stage, int replication) {
    const std::string name = fmt::format("{}/{:02}.h5", stage, replication);
    std::filesystem::create_directories(folder_ / stage);
    return artifacts_[name] = folder_ / name;
  }

  std::filesystem::path folder_;
  int replications_;
  std::map<std::string, std::filesystem::path> artifacts_;

 private:
  struct Values {
    std::string name;
    double middle;
    int n;
  };

  std::map<std::string, std::vector<Values>> arrays_;
};

}  // namespace hbr
