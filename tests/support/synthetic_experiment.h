// Artifacts of an experiment that never ran: every kind of pipeline/artifact/FORMAT.md that statistics read,
// small, with numbers near the paper's, drawn from a fixed seed.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/artifact/repertoire_file.h"
#include "pipeline/core/random.h"

namespace hbr {

class SyntheticExperiment {
 public:
  SyntheticExperiment(std::filesystem::path folder, int replications)
      : folder_(std::move(folder)), replications_(replications) {}

  // Name -> path, as the statistics stage gets them.
  const std::map<std::string, std::filesystem::path>& artifacts() const { return artifacts_; }

  // A search that grows to `size` elites by 1 - exp(-8 generation / generations), recorded 21 times.
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
        elites.id.push_back(i);
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
      file.attribute("settings", fmt::format("{{\"layer\":{{\"samples\":{}}}}}", samples));
      file.close();
    }
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

  void substitution(const std::vector<double>& original, const std::vector<double>& substitute, int n) {
    for (int r = 0; r < replications_; ++r) {
      Hdf5Writer file(place("substitution", r));
      for (const auto& [name, middle] :
           {std::pair{"original", original}, std::pair{"substitute", substitute}}) {
        Rng rng(Seed(3).child(name).child(static_cast<std::uint64_t>(r)));
        Array<float> metrics{{static_cast<std::size_t>(n), 3}, {}};
        for (int i = 0; i < 3 * n; ++i)
          metrics.values.push_back(static_cast<float>(middle[static_cast<std::size_t>(i % 3)]) *
                                   rng.uniform(0.6f, 1.4f));
        file.write(name, metrics);
      }
      file.close();
    }
  }

  void autoencoder(int epochs) {
    for (int r = 0; r < replications_; ++r) {
      Rng rng(Seed(4).child(static_cast<std::uint64_t>(r)));
      Hdf5Writer file(place("autoencoder", r));
      std::vector<std::int64_t> epoch, samples;
      std::vector<double> train, test, kept(10, 0.5);
      for (int e = 1; e <= epochs; ++e) {
        epoch.push_back(e);
        samples.push_back(e * 10 <= epochs * 6 ? 60000 : 31798);
        train.push_back(0.034 + 0.03 / e);
        test.push_back(0.035 + 0.03 / e + 0.001 * rng.uniform_double());
      }
      kept[1] = 0.98, kept[2] = 0.22;
      Array<float> latent{{100, 2}, {}};
      for (int i = 0; i < 200; ++i) latent.values.push_back(rng.uniform(-0.95f, 0.95f));
      file.write("training/epoch", epoch);
      file.write("training/samples", samples);
      file.write("training/train_error", train);
      file.write("training/test_error", test);
      file.write("training/kept_per_class", kept);
      file.write("latent/position", latent);
      file.write("latent/label", std::vector<std::uint8_t>(100, 3));
      file.close();
    }
  }

  // Groups hbr and flat: `share` of the images are good; an image is a bar whose place follows its latent
  // position, so latent neighbours look alike.
  void digits(int n, double good_hbr, double good_flat) {
    for (int r = 0; r < replications_; ++r) {
      Hdf5Writer file(place("digits", r));
      for (const auto& [group, share] : {std::pair{"hbr", good_hbr}, std::pair{"flat", good_flat}}) {
        Rng rng(Seed(5).child(group).child(static_cast<std::uint64_t>(r)));
        const auto rows = static_cast<std::size_t>(n);
        Array<std::uint8_t> image{{rows, 28, 28}, std::vector<std::uint8_t>(rows * 784)};
        Array<float> measures{{rows, 2}, {}};
        std::vector<float> objective, confidence, distance;
        std::vector<std::uint8_t> label, good;
        for (std::size_t i = 0; i < rows; ++i) {
          const float x = rng.uniform(-1, 1), y = rng.uniform(-1, 1);
          measures.values.insert(measures.values.end(), {x, y});
          for (std::size_t p = 0; p < 784; ++p)
            if (std::abs(static_cast<double>(p % 28) - 14 - 10 * static_cast<double>(x)) < 3)
              image.values[i * 784 + p] = 255;
          label.push_back(static_cast<std::uint8_t>(i % 10));
          good.push_back(rng.uniform_double() < share || (group[0] == 'f' && i % 10 < 2) ? 1 : 0);
          objective.push_back(-0.03f * rng.uniform(0.9f, 1.1f));
          confidence.push_back(rng.uniform(0.7f, 1));
          distance.push_back(rng.uniform(0.5f, 1));
        }
        const std::string prefix = std::string(group) + "/";
        file.write(prefix + "image", image);
        file.write(prefix + "measures", measures);
        file.write(prefix + "objective", objective);
        file.write(prefix + "label", label);
        file.write(prefix + "confidence", confidence);
        file.write(prefix + "distance", distance);
        file.write(prefix + "good", good);
      }
      file.close();
    }
  }

  // One image in fifty fails.
  void transfer(const std::string& robot, int n) {
    for (int r = 0; r < replications_; ++r) {
      Rng rng(Seed(6).child(static_cast<std::uint64_t>(r)));
      std::vector<float> absolute, squared;
      for (int i = 0; i < n; ++i) {
        absolute.push_back(i % 50 == 0 ? 0.08f : 0.0092f * rng.uniform(0.3f, 1.7f));
        squared.push_back(absolute.back() / 3);
      }
      Hdf5Writer file(place(robot + "_transfer", r));
      file.write("absolute", absolute);
      file.write("squared", squared);
      for (const auto& [name, middle] :
           {std::pair{"lines/end", 0.006f}, std::pair{"lines/displacement", 0.008f},
            std::pair{"arcs/end", 0.02f}, std::pair{"arcs/centre", 0.03f}, std::pair{"arcs/length", 0.01f}}) {
        Array<float> errors{{50, 4}, {}};
        for (int i = 0; i < 200; ++i) errors.values.push_back(middle * rng.uniform(0.1f, 1.9f));
        file.write(name, errors);
      }
      file.close();
    }
  }

  // Two joints, one of them loaded twice as much as the other.
  void dynamics(const std::string& robot, int n) {
    const auto rows = static_cast<std::size_t>(n);
    for (int r = 0; r < replications_; ++r) {
      Rng rng(Seed(8).child(static_cast<std::uint64_t>(r)));
      const auto around = [&](float middle) {
        std::vector<float> values;
        for (int i = 0; i < n; ++i) values.push_back(middle * rng.uniform(0.8f, 1.2f));
        return values;
      };
      Hdf5Writer file(place(robot + "_dynamics", r));
      file.write("duration", around(8));
      for (const std::string player : {"wanted", "arm", "whole"}) {
        const Array<std::uint8_t> image{{rows, 28, 28}, std::vector<std::uint8_t>(784 * rows, 100)};
        if (player == "wanted") file.write("image", image);
        file.write(player + "/image", image);
        file.write(player + "/absolute", around(0.02f));
        file.write(player + "/squared", around(0.008f));
        if (player == "wanted") continue;
        file.write(player + "/rms", around(6e-5f));
        file.write(player + "/max", around(2e-4f));
        file.write(player + "/off_plane", around(3e-3f));
        file.write(player + "/faster", around(3));
        for (const char* load : {"torque", "speed"}) {
          Array<float> shares{{rows, 2}, {}};
          for (int i = 0; i < n; ++i) {
            const float share = rng.uniform(0.1f, 0.3f);
            shares.values.insert(shares.values.end(), {share, 2 * share});
          }
          file.write(player + "/" + load, shares);
        }
        file.attribute(player + ".joints", std::string("Shoulder Elbow"));
      }
      file.close();
    }
  }

  // The robot's digits are worse than the arm's by 0.004, and gain twice as much.
  void tuned(const std::string& robot, int n) {
    const bool arm = robot == "arm";
    for (int r = 0; r < replications_; ++r) {
      Rng rng(Seed(9).child(robot).child(static_cast<std::uint64_t>(r)));
      Hdf5Writer file(place(robot + "_tuned", r));
      for (const auto& [state, error, share, stroke] :
           {std::tuple{"before", arm ? 0.030f : 0.034f, 0.5f, 0.012f},
            std::tuple{"top", arm ? 0.028f : 0.030f, 0.6f, 0.f},
            std::tuple{"all", arm ? 0.027f : 0.028f, 0.65f, 0.010f}}) {
        const std::string name = state;
        std::vector<float> objective, absolute;
        std::vector<std::uint8_t> good;
        for (int i = 0; i < n; ++i) {
          objective.push_back(-error * rng.uniform(0.8f, 1.2f));
          absolute.push_back(error * rng.uniform());
          good.push_back(rng.uniform() < share);
        }
        file.write(name + "/objective", objective);
        file.write(name + "/good", good);
        file.write(name + "/absolute", absolute);
        if (name == "top") continue;
        file.write(name + "/arc_fitness", std::vector<float>{-stroke, -2 * stroke});
        float scale = 1;
        for (const char* error_of : {"line", "line_from_arm", "arc_centre", "arc_centre_from_arm",
                                     "arc_length", "arc_length_from_arm"}) {
          Array<float> errors{{50, 4}, {}};
          for (int i = 0; i < 200; ++i) errors.values.push_back(scale * stroke * rng.uniform(0.1f, 1.9f));
          file.write(name + "/" + error_of, errors);
          scale += 1;
        }
      }
      file.close();
    }
  }

  // Seven elites, one of them added; of ten points three have none within l before, one after.
  void polish(const std::string& robot) {
    for (int r = 0; r < replications_; ++r) {
      Hdf5Writer file(place(robot + "_polish", r));
      file.attribute("settings.spacing", 0.01);
      file.write("objective", std::vector<float>(7, -0.4f));
      for (const auto& [when, apart, away] :
           {std::tuple{"before", 3, 8e-4f}, std::tuple{"after", 1, 1e-7f}}) {
        const std::string prefix = std::string(when) + "/";
        std::vector<float> nearest(10, 0.005f);
        std::fill_n(nearest.begin(), apart, 0.02f);
        file.write(prefix + "nearest", nearest);
        file.write(prefix + "off_plane", std::vector<float>(6, away));
        file.write(prefix + "distance", std::vector<float>(6, 2 * away));
        file.write(prefix + "variance", std::vector<float>{.1f, .2f, .3f, .4f, .5f, .6f});
      }
      file.close();
    }
  }

  void single(const std::string& name, const std::map<std::string, double>& attributes) {
    const std::filesystem::path path = folder_ / name;
    Hdf5Writer file(path);
    for (const auto& [key, value] : attributes) file.attribute(key, value);
    file.close();
    artifacts_[name] = path;
  }

  // Layer 1 by other searches, and what they come to on a common grid: each covers less than the one before.
  void searches(const std::vector<std::string>& names, int generations) {
    const std::filesystem::path path = folder_ / "searches.h5";
    Hdf5Writer file(path);
    file.attribute("settings.passive_cells", std::int64_t{50});
    file.attribute("settings.worst_fitness", -2.467);
    file.attribute("filled_by_any", 1600.0);
    double coverage = 1;
    for (const std::string& name : names) {
      search("layer1_search_" + name, static_cast<int>(450 * coverage), 8, -0.001, -0.06, generations);
      std::vector<double> share, score, mean;
      Rng rng(Seed(7).child(name));
      for (int r = 0; r < replications_; ++r) {
        share.push_back(coverage * (1 - 0.01 * rng.uniform_double()));
        mean.push_back(-0.05 * (1 + 0.1 * rng.uniform_double()));
        score.push_back(1600 * share.back() * (2.467 + mean.back()));
      }
      file.write(name + "/coverage", share);
      file.write(name + "/qd_score", score);
      file.write(name + "/cell_mean", mean);
      coverage *= 0.95;
    }
    file.close();
    artifacts_["searches.h5"] = path;
  }

  // Everything, with the generations of the paper divided by `shorter`.
  void everything(int shorter) {
    const int g = 10000 / shorter;
    search("layer1", 500, 8, -0.001, -0.055, g);
    search("layer1_substitute", 480, 8, -0.0005, -0.01, g);
    search("nao_layer1", 450, 4, -0.001, -0.05, g);
    searches({"curiosity", "nslc", "grid", "cvt"}, g);
    search("layer2_n1", 147, 2, 0, 0, g);
    search("layer2_n10_short", 126, 2, 0, 0, g / 10, 10);
    search("layer2_n10", 138, 2, 0, 0, g, 10);
    search("layer2_n100", 132, 2, 0, 0, g, 100);
    search("reference4d", 45000, 4, 0, 0, g);
    search("layer3_n1", 300, 10, -0.11, -0.9, g);
    search("layer3_n10", 310, 10, -0.1, -0.8, g, 10);
    search("layer3_n100", 320, 10, -0.1, -0.7, g, 100);
    search("layer3_b", 290, 3, -0.1, -0.6, g);
    search("flat_arcs", 305, 40, -0.5, -1.9, 3 * g);
    search("layer4", 350, 12, -0.010, -0.030, g);
    search("flat_digits", 380, 121, -0.009, -0.027, 2 * g);
    for (const auto& [name, error] :
         {std::pair{"n1", 2.7e-4}, std::pair{"n10_short", 7.5e-5}, std::pair{"n10", 7.0e-5},
          std::pair{"n100", 6.0e-5}, std::pair{"reference_endpoint", 2.6e-4},
          std::pair{"reference_displacement", 8.6e-5}})
      values("accuracy", std::string(name) + "/squared_error", error, 100);
    for (const auto& [name, stored, fresh] :
         {std::tuple{"n1", -0.9, -1.2}, std::tuple{"n10", -0.8, -1.1}, std::tuple{"n100", -0.7, -1.0},
          std::tuple{"b", -0.6, -0.8}, std::tuple{"flat", -1.9, -1.9}}) {
      values("arc_quality", std::string(name) + "/stored", stored, 50);
      values("arc_quality", std::string(name) + "/fresh", fresh, 50);
    }
    write_values();
    substitution({-1.29, -0.06, -0.56}, {-1.33, -0.28, -0.003}, 60);
    autoencoder(200 / shorter);
    digits(120, 0.6, 0.35);
    transfer("nao", 100);
    dynamics("nao", 20);
    tuned("nao", 50);
    tuned("arm", 50);
    single("judge.h5", {{"test_accuracy", 0.99}, {"test_typical", 0.95}, {"random_typical", 0.05}});
    polish("nao");
    single("nao_plane.h5", {{"covered", 0.998}, {"scale", 0.26}});
  }

 private:
  struct Values {
    std::string name;
    double middle;
    int n;
  };

  std::filesystem::path place(const std::string& stage, int replication) {
    const std::string name = fmt::format("{}/{:02}.h5", stage, replication);
    std::filesystem::create_directories(folder_ / stage);
    return artifacts_[name] = folder_ / name;
  }

  std::filesystem::path folder_;
  int replications_;
  std::map<std::string, std::filesystem::path> artifacts_;
  std::map<std::string, std::vector<Values>> arrays_;
};

}  // namespace hbr
