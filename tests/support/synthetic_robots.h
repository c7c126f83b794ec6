// Artifacts of other robots, as of an experiment that never ran.
#pragma once

#include <fmt/ranges.h>

#include <algorithm>
#include <tuple>

#include "tests/support/synthetic_layers.h"

namespace hbr {

class SyntheticRobots : public SyntheticLayers {
 public:
  using SyntheticLayers::SyntheticLayers;

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
      for (std::vector<float>* worse : {&absolute, &squared})
        for (float& value : *worse) value *= 1.5f;
      file.write("evolved/absolute", absolute);
      std::vector<std::uint8_t> good(absolute.size()), lost(absolute.size()), evolved_lost(absolute.size());
      for (std::size_t i = 0; i < good.size(); ++i) {
        good[i] = i % 2 == 0;
        lost[i] = i % 20 == 0;
        evolved_lost[i] = i % 10 == 0;
      }
      file.write("good", good);
      file.write("lost", lost);
      file.write("evolved/lost", evolved_lost);
      file.write("evolved/squared", squared);
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

  // Of its joints the second is loaded twice as much as the first, the third three times.
  void dynamics(const std::string& robot, int n,
                const std::vector<std::string>& joints = {"Shoulder", "Elbow"}) {
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
      // All can be read; of every ten digits one is lost, two leave the board, none passes a limit.
      const auto every = [&](int of_ten) {
        std::vector<std::uint8_t> marked(rows);
        for (std::size_t i = 0; i < rows; ++i) marked[i] = static_cast<int>(i % 10) < of_ten;
        return marked;
      };
      file.write("readable", every(10));
      for (const std::string player : {"elites", "wanted", "arm", "whole"}) {
        const Array<std::uint8_t> image{{rows, 28, 28}, std::vector<std::uint8_t>(784 * rows, 100)};
        if (player == "wanted") file.write("image", image);
        file.write(player + "/image", image);
        file.write(player + "/absolute", around(0.02f));
        file.write(player + "/squared", around(0.008f));
        if (player == "elites" || player == "wanted") {
          file.write(player + "/travel", around(player == "wanted" ? 3 : 9));
          continue;
        }
        file.write(player + "/lost", every(1));
        file.write(player + "/off_board", every(2));
        file.write(player + "/beyond_limit", every(0));
        file.write(player + "/rms", around(6e-5f));
        file.write(player + "/max", around(2e-4f));
        file.write(player + "/off_plane", around(3e-3f));
        file.write(player + "/faster", around(3));
        for (const char* load : {"torque", "speed"}) {
          Array<float> shares{{rows, joints.size()}, {}};
          for (int i = 0; i < n; ++i) {
            const float share = rng.uniform(0.1f, 0.3f);
            for (std::size_t k = 1; k <= joints.size(); ++k)
              shares.values.push_back(static_cast<float>(k) * share);
          }
          file.write(player + "/" + load, shares);
        }
        if (player == "whole") {
          file.write("whole/margin", around(0.02f));
          file.write("whole/grip", around(0.1f));
          file.write("whole/tips", every(3));
        }
        file.attribute(player + ".joints", fmt::format("{}", fmt::join(joints, "\n")));
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
  void projection(const std::string& robot) {
    for (int r = 0; r < replications_; ++r) {
      Hdf5Writer file(place(robot + "_projected", r));
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
};

}  // namespace hbr
