// Artifacts with pictures of an experiment that never ran: digits, transfers, an autoencoder's latent space
// and a robot's pictures. Digits are set in OpenCV's fonts and jittered from a fixed seed.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/core/random.h"

namespace hbr {

class SyntheticPictures {
 public:
  explicit SyntheticPictures(std::filesystem::path folder) : folder_(std::move(folder)) {}

  // Name below OUT -> path.
  const std::map<std::string, std::filesystem::path>& artifacts() const { return artifacts_; }

  void digits(int replication, int n) {
    Hdf5Writer file(place("digit_verdicts", replication));
    for (const char* who : {"hbr", "flat"}) {
      Rng rng(Seed(1).child(who).child(static_cast<std::uint64_t>(replication)));
      Array<std::uint8_t> image{{static_cast<std::size_t>(n), 28, 28}, {}};
      Array<float> measures{{static_cast<std::size_t>(n), 2}, {}};
      std::vector<float> objective, confidence, distance;
      std::vector<std::uint8_t> label, good;
      for (int i = 0; i < n; ++i) {
        const float x = rng.uniform(-1, 1), y = rng.uniform(-1, 1);
        const int digit = static_cast<int>((std::atan2(y, x) / 6.2832 + 0.5) * 9.999);
        append(image.values, draw(digit, rng, who[0] == 'f' ? 1.0f : 0.3f));
        measures.values.insert(measures.values.end(), {x, y});
        objective.push_back(-rng.uniform(0.01f, 0.05f));
        confidence.push_back(rng.uniform());
        distance.push_back(rng.uniform());
        label.push_back(static_cast<std::uint8_t>(digit));
        good.push_back(rng.uniform() < (who[0] == 'f' ? 0.35f : 0.6f) && digit != 8 ? 1 : 0);
      }
      const std::string prefix = std::string(who) + "/";
      file.write(prefix + "image", image);
      file.write(prefix + "measures", measures);
      file.write(prefix + "objective", objective);
      file.write(prefix + "confidence", confidence);
      file.write(prefix + "distance", distance);
      file.write(prefix + "label", label);
      file.write(prefix + "good", good);
    }
    file.close();
  }

  void transfer(int replication, int n) {
    Rng rng(Seed(2).child(static_cast<std::uint64_t>(replication)));
    Array<std::uint8_t> arm{{static_cast<std::size_t>(n), 28, 28}, {}}, robot = arm;
    std::vector<float> absolute, squared;
    for (int i = 0; i < n; ++i) {
      const cv::Mat digit = draw(i % 10, rng, 0.3f);
      cv::Mat other;
      cv::GaussianBlur(digit, other, {3, 3}, 0.3 + 0.002 * i);
      append(arm.values, digit);
      append(robot.values, other);
      absolute.push_back(static_cast<float>(cv::norm(digit, other, cv::NORM_L1) / 784 / 255));
      squared.push_back(absolute.back() / 3);
    }
    Hdf5Writer file(place("nao_transfer", replication));
    file.attribute("framing", std::string("box"));
    file.write("arm", arm);
    file.write("robot", robot);
    file.write("absolute", absolute);
    file.write("squared", squared);
    file.close();
  }

  void dynamics(int replication, int n) {
    Rng rng(Seed(4).child(static_cast<std::uint64_t>(replication)));
    Hdf5Writer file(place("nao_dynamics", replication));
    std::vector<float> absolute;
    for (int i = 0; i < n; ++i) absolute.push_back(rng.uniform(0, 0.05f));
    file.write("arm/absolute", absolute);
    for (const char* name : {"image", "wanted/image", "arm/image", "whole/image"}) {
      Array<std::uint8_t> images{{static_cast<std::size_t>(n), 28, 28}, {}};
      for (int i = 0; i < n; ++i) append(images.values, draw(i % 10, rng, 0.1f));
      file.write(name, images);
    }
    file.close();
  }

  // The robot draws the same, each digit at the place of the next.
  void tuned(int replication, int n) {
    Rng rng(Seed(5).child(static_cast<std::uint64_t>(replication)));
    Hdf5Writer file(place("nao_tuned", replication));
    std::vector<float> absolute;
    std::vector<std::int32_t> next;
    for (int i = 0; i < n; ++i) {
      absolute.push_back(rng.uniform(0, 0.05f));
      next.push_back((i + 1) % n);
    }
    for (const std::string state : {"before", "top", "all"}) {
      file.write(state + "/absolute", absolute);
      file.write(state + "/nearest", next);
    }
    for (const char* name : {"arm/image", "before/image", "top/image", "all/image"}) {
      Array<std::uint8_t> images{{static_cast<std::size_t>(n), 28, 28}, {}};
      for (int i = 0; i < n; ++i) append(images.values, draw(i % 10, rng, 0.1f));
      file.write(name, images);
    }
    file.close();
  }

  void autoencoder(int replication, int n) {
    Rng rng(Seed(3).child(static_cast<std::uint64_t>(replication)));
    Array<float> position{{static_cast<std::size_t>(n), 2}, {}}, decoded{{20, 28, 28}, {}};
    Array<std::uint8_t> original{{20, 28, 28}, {}};
    std::vector<std::uint8_t> label;
    for (int i = 0; i < n; ++i) {
      const float angle = 0.628f * static_cast<float>(i % 10) + rng.uniform(-0.3f, 0.3f),
                  r = rng.uniform(0.3f, 0.95f);
      position.values.insert(position.values.end(), {r * std::cos(angle), r * std::sin(angle)});
      label.push_back(static_cast<std::uint8_t>(i % 10));
    }
    for (int i = 0; i < 20; ++i) {
      const cv::Mat digit = draw(i % 10, rng, 0.3f);
      append(original.values, digit);
      cv::Mat blurred;
      cv::GaussianBlur(digit, blurred, {5, 5}, 1.2);
      for (const std::uint8_t pixel : cv::Mat_<std::uint8_t>(blurred))
        decoded.values.push_back(pixel / 255.0f);
    }
    Hdf5Writer file(place("autoencoder", replication));
    file.write("latent/position", position);
    file.write("latent/label", label);
    file.write("reconstruction/original", original);
    file.write("reconstruction/decoded", decoded);
    file.close();
  }

  // A spiral, and an arm of eight links that turns beside it.
  void surest_digits(int replication) {
    constexpr int kPoints = 60, kLinks = 8;
    Hdf5Writer file(place("surest_digits", replication));
    std::vector<std::uint8_t> label, good;
    std::vector<std::int64_t> id;
    std::vector<std::int32_t> points;
    std::vector<float> pen, joints;
    for (int digit = 0; digit < 9; ++digit) {
      label.push_back(static_cast<std::uint8_t>(digit));
      good.push_back(digit != 8);
      id.push_back(digit);
      points.push_back(kPoints);
      for (int k = 0; k < kPoints; ++k) {
        const float turn = 0.1f * static_cast<float>(k * (digit + 1)) / 3, r = 0.001f * static_cast<float>(k);
        pen.insert(pen.end(), {0.3f + r * std::cos(turn), 0.2f + r * std::sin(turn)});
        for (int joint = 0; joint < kLinks; ++joint) joints.push_back(0.1f + 0.05f * std::sin(turn));
      }
    }
    file.write("label", label);
    file.write("good", good);
    file.write("id", id);
    file.write("points", points);
    file.write("pen", {pen.size() / 2, 2}, pen.data());
    file.write("joints", {pen.size() / 2, kLinks}, joints.data());
    file.write("links", std::vector<float>(kLinks, 0.07f));
    file.close();
  }

  void posture(const std::string& robot) {
    const std::filesystem::path folder = folder_ / (robot + "_picture");
    std::filesystem::create_directories(folder);
    cv::Mat picture(240, 320, CV_8UC3, cv::Scalar(235, 230, 225));
    cv::circle(picture, {160, 120}, 60, {120, 90, 60}, cv::FILLED, cv::LINE_AA);
    cv::imwrite((folder / "posture.png").string(), picture);
    cv::imwrite((folder / "strip.png").string(), picture);
    artifacts_[robot + "_picture"] = folder;
  }

  // A disc of which the lower left is out of reach, and a layer 1 with a few gaps.
  void coverage() {
    std::vector<float> points, reach, before, after;
    for (int i = 0; i < 400; ++i) {
      const float x = static_cast<float>(i % 20) / 20, y = static_cast<float>(i / 20) / 20;
      points.insert(points.end(), {x, y});
      reach.push_back(x + y < 0.2f ? 0.01f : 0);
      before.push_back(i % 40 == 0 ? 0.02f : 0.005f);
      after.push_back(0.005f);
    }
    Hdf5Writer plane(artifacts_["nao_plane.h5"] = folder_ / "nao_plane.h5");
    plane.attribute("settings.robot.off_plane_tolerance", 0.0015);
    plane.attribute("missing", std::string("the lower left: 10 of 400 points, up to 10 mm away"));
    plane.write("points", {reach.size(), 2}, points.data());
    plane.write("distance", reach);
    plane.close();
    Hdf5Writer projected(place("nao_projected", 0));
    projected.attribute("settings.spacing", 0.01);
    projected.attribute("settings.layer.half_side", 0.6);
    projected.write("arm_points", {reach.size(), 2}, points.data());
    projected.write("before/nearest", before);
    projected.write("after/nearest", after);
    projected.close();
  }

  void everything(int replications) {
    coverage();
    for (int r = 0; r < replications; ++r) {
      digits(r, 300);
      surest_digits(r);
      transfer(r, 100);
      dynamics(r, 12);
      tuned(r, 12);
      autoencoder(r, 2000);
    }
    posture("nao");
    posture("six_legs");
  }

 private:
  static cv::Mat draw(int digit, Rng& rng, float jitter) {
    cv::Mat image(28, 28, CV_8UC1, cv::Scalar(0)), turned;
    cv::putText(image, std::to_string(digit), {5, 23}, cv::FONT_HERSHEY_SCRIPT_SIMPLEX, 0.85, 255, 2,
                cv::LINE_AA);
    cv::Mat turn =
        cv::getRotationMatrix2D({14, 14}, 40 * jitter * rng.uniform(-1, 1), rng.uniform(0.8f, 1.1f));
    turn.at<double>(0, 1) += jitter * rng.uniform(-0.6f, 0.6f);
    cv::warpAffine(image, turned, turn, {28, 28});
    return turned;
  }

  static void append(std::vector<std::uint8_t>& values, const cv::Mat& image) {
    values.insert(values.end(), image.begin<std::uint8_t>(), image.end<std::uint8_t>());
  }

  std::filesystem::path place(const std::string& stage, int replication) {
    const std::string name = fmt::format("{}/{:02}.h5", stage, replication);
    std::filesystem::create_directories(folder_ / stage);
    return artifacts_[name] = folder_ / name;
  }

  std::filesystem::path folder_;
  std::map<std::string, std::filesystem::path> artifacts_;
};

}  // namespace hbr
