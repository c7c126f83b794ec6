// A robot's shape without a board: two parts, two pieces, a triangle of 1 m, and a small one far away that
// lies in a plane.
#pragma once

#include <string>
#include <vector>

#include "pipeline/artifact/hdf5_file.h"

namespace hbr {

inline const std::vector<float> kSmallPositions{0, 0,     0, 1, 0.3f,  0,      0.2f, 1, -0.7f, 5, 5,
                                                2, 5.01f, 5, 2, 5.01f, 5.003f, 2,    5, 5.01f, 2};
inline const std::vector<float> kSmallNormals{0, 0, 1,  0, 0, -1,    0.6f,  0, 0.8f, 1, 0,
                                              0, 0, -1, 0, 0, 0.28f, 0.96f, 0, 0,    1};

inline void write_small_shape(Hdf5Writer& file) {
  file.attribute("joints", std::string("j"));
  for (const char* list : {"joint/lower", "joint/upper"}) file.write(list, std::vector<double>{0.5});
  file.write("part/parent", std::vector<std::int32_t>{-1, 0});
  file.write("part/coordinate", std::vector<std::int32_t>{-1, 0});
  file.write("part/slides", std::vector<std::uint8_t>{0, 1});
  file.write("part/multiplier", std::vector<double>{1, -0.1});
  file.write("part/offset", std::vector<double>{0, 1. / 3});
  std::vector<double> origin(24);
  for (std::size_t i = 0; i < 24; ++i) origin[i] = static_cast<double>(i) / 7;
  file.write("part/origin", {2, 12}, origin.data());
  file.write("part/axis", {2, 3}, std::vector<double>{0, 0, 1, 0, 1, 0}.data());
  file.write("piece/part", std::vector<std::int32_t>{0, 1});
  file.write("piece/vertices", std::vector<std::int32_t>{3, 4});
  file.write("piece/triangles", std::vector<std::int32_t>{1, 2});
  file.write("piece/opacity", std::vector<float>{1, 0.5f});
  file.write("piece/colour", {2, 3}, std::vector<float>{0, 0.5f, 1, 1, 1, 1}.data());
  file.write("vertex/position", {7, 3}, kSmallPositions.data());
  file.write("vertex/normal", {7, 3}, kSmallNormals.data());
  file.write("triangle/vertex", {3, 3}, std::vector<std::int32_t>{0, 1, 2, 0, 1, 2, 0, 2, 3}.data());
}

}  // namespace hbr
