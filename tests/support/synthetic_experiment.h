// Artifacts of an experiment that never ran: every kind of pipeline/artifact/FORMAT.md that statistics read,
// small, with numbers near the paper's, drawn from a fixed seed.
#pragma once

#include "tests/support/synthetic_robots.h"

namespace hbr {

class SyntheticExperiment : public SyntheticRobots {
 public:
  using SyntheticRobots::SyntheticRobots;

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
      file.write("training/tested", epoch);
      file.write("training/test_error", test);
      file.write("training/kept_per_class", kept);
      file.write("latent/position", latent);
      std::vector<std::uint8_t> label;
      for (int i = 0; i < 100; ++i) label.push_back(static_cast<std::uint8_t>(rng.below(10)));
      file.write("latent/label", label);
      file.close();
    }
  }

  // Groups hbr and flat: `share` of the images are good; an image is a bar whose place follows its latent
  // position, so latent neighbours look alike.
  void digits(int n, double good_hbr, double good_flat) {
    for (int r = 0; r < replications_; ++r) {
      Hdf5Writer file(place("digit_verdicts", r));
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

  // How strokes turn: `sharp_*` rad in the mean, refused digits somewhat more.
  void turns(int n, double sharp_hbr, double sharp_flat) {
    for (int r = 0; r < replications_; ++r) {
      Hdf5Writer file(place("digit_turns", r));
      for (const auto& [group, sharp] : {std::pair{"hbr", sharp_hbr}, std::pair{"flat", sharp_flat}}) {
        Rng rng(Seed(8).child(group).child(static_cast<std::uint64_t>(r)));
        std::vector<std::int32_t> turns;
        std::vector<std::uint8_t> good, joint;
        std::vector<float> turn, length, side;
        for (int i = 0; i < n; ++i) {
          good.push_back(rng.uniform_double() < 0.6 ? 1 : 0);
          turns.push_back(i == 0 ? 0 : 4 + i % 6);
          const auto mean = static_cast<float>(sharp) * (good.back() ? 1.0f : 1.1f);
          for (int k = 0; k < turns.back(); ++k) {
            turn.push_back(mean * rng.uniform(0.5f, 1.5f) * (k % 2 ? 1.0f : -1.0f));
            joint.push_back(group[0] == 'h' && k == 4 ? 1 : 0);
          }
          length.push_back(rng.uniform(0.8f, 1.2f));
          side.push_back(rng.uniform(0.3f, 0.4f));
        }
        const std::string prefix = std::string(group) + "/";
        file.write(prefix + "turns", turns);
        file.write(prefix + "good", good);
        file.write(prefix + "joint", joint);
        file.write(prefix + "turn", turn);
        file.write(prefix + "length", length);
        file.write(prefix + "side", side);
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
      values("arc_quality", std::string(name) + "/irregularity", -fresh / 2, 50);
      values("arc_quality", std::string(name) + "/joint_term", -fresh / 2, 50);
    }
    write_values();
    substitution({-1.29, -0.06, -0.56}, {-1.33, -0.28, -0.003}, 60);
    autoencoder(200 / shorter);
    digits(120, 0.6, 0.35);
    turns(120, 0.5, 0.9);
    transfer("nao", 100);
    dynamics("nao", 20);
    tuned("nao", 50);
    tuned("arm", 50);
    single("judge.h5", {{"test_accuracy", 0.99}, {"test_typical", 0.95}, {"random_typical", 0.05}});
    projection("nao");
    single("nao_plane.h5", {{"covered", 0.998}, {"scale", 0.26}});
  }
};

}  // namespace hbr
