// Where a robot's parts are, from ROBOT_shape.h5 alone, by the sentence of FORMAT.md.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <string>
#include <vector>

#include "pipeline/artifact/hdf5_file.h"

namespace hbr {

struct ShapeArtifact {
  explicit ShapeArtifact(const Hdf5Reader& file)
      : parent(file.read<std::int32_t>("part/parent").values),
        coordinate(file.read<std::int32_t>("part/coordinate").values),
        slides(file.read<std::uint8_t>("part/slides").values),
        multiplier(file.read<double>("part/multiplier").values),
        offset(file.read<double>("part/offset").values),
        origin(file.read<double>("part/origin").values),
        axis(file.read<double>("part/axis").values) {}

  // Rotation and place of each part's frame in that of part 0.
  struct Frame {
    Eigen::Matrix3d turn;
    Eigen::Vector3d place;
  };
  template <class Joints>
  std::vector<Frame> frames(const Joints& joints) const {
    std::vector<Frame> all;
    for (std::size_t i = 0; i < parent.size(); ++i) {
      Eigen::Matrix3d turn;
      Eigen::Vector3d place;
      for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c)
          turn(r, c) = origin[12 * i + 4 * static_cast<std::size_t>(r) + static_cast<std::size_t>(c)];
        place[r] = origin[12 * i + 4 * static_cast<std::size_t>(r) + 3];
      }
      if (parent[i] < 0) {
        all.push_back({turn, place});
        continue;
      }
      const double x = axis[3 * i], y = axis[3 * i + 1], z = axis[3 * i + 2],
                   position = multiplier[i] * joints[static_cast<std::size_t>(coordinate[i])] + offset[i];
      Eigen::Matrix3d motion = Eigen::Matrix3d::Identity();
      Eigen::Vector3d shift(0, 0, 0);
      if (slides[i]) {
        shift = position * Eigen::Vector3d(x, y, z);
      } else {  // Rodrigues
        const double c = std::cos(position), s = std::sin(position);
        motion << c + x * x * (1 - c), x * y * (1 - c) - z * s, x * z * (1 - c) + y * s,
            y * x * (1 - c) + z * s, c + y * y * (1 - c), y * z * (1 - c) - x * s, z * x * (1 - c) - y * s,
            z * y * (1 - c) + x * s, c + z * z * (1 - c);
      }
      const Frame& below = all.at(static_cast<std::size_t>(parent[i]));
      all.push_back({below.turn * turn * motion, below.turn * (turn * shift + place) + below.place});
    }
    return all;
  }

  std::vector<std::int32_t> parent, coordinate;
  std::vector<std::uint8_t> slides;
  std::vector<double> multiplier, offset, origin, axis;
};

}  // namespace hbr
