#include "stages/robots/shape_file.h"

#include <fmt/ranges.h>

namespace hbr::inline stages {
namespace {

// Columns of an array with a row for each of some things.
template <class T>
class Table {
 public:
  explicit Table(std::size_t columns) : columns_(columns) {}
  template <class Row>
  void add(const Row& row) {
    for (const auto& value : row) values_.push_back(static_cast<T>(value));
  }
  void write(Hdf5Writer& file, const std::string& name) const {
    file.write(name, {values_.size() / columns_, columns_}, values_.data());
  }

 private:
  std::size_t columns_;
  std::vector<T> values_;
};

void write_parts(Hdf5Writer& file, const std::vector<MovingPart>& parts) {
  std::vector<std::int32_t> parent, coordinate;
  std::vector<std::uint8_t> slides;
  std::vector<double> multiplier, offset;
  Table<double> origin(12), axis(3);
  for (const MovingPart& part : parts) {
    parent.push_back(part.parent);
    coordinate.push_back(part.coordinate);
    slides.push_back(part.slides);
    multiplier.push_back(part.multiplier);
    offset.push_back(part.offset);
    const Eigen::Matrix<double, 3, 4, Eigen::RowMajor> rows = part.origin.matrix().topRows<3>();
    origin.add(rows.reshaped<Eigen::RowMajor>());
    axis.add(part.axis);
  }
  file.write("part/parent", parent);
  file.write("part/coordinate", coordinate);
  file.write("part/slides", slides);
  file.write("part/multiplier", multiplier);
  file.write("part/offset", offset);
  origin.write(file, "part/origin");
  axis.write(file, "part/axis");
}

void write_pieces(Hdf5Writer& file, const std::vector<RobotShape::Piece>& pieces) {
  std::vector<std::int32_t> part, vertices, triangles;
  std::vector<float> opacity;
  Table<float> colour(3), position(3), normal(3);
  Table<std::int32_t> corner(3);
  for (const auto& [of, mesh] : pieces) {
    part.push_back(of);
    vertices.push_back(static_cast<std::int32_t>(mesh.vertices.size()));
    triangles.push_back(static_cast<std::int32_t>(mesh.triangles.size()));
    opacity.push_back(mesh.opacity);
    colour.add(mesh.colour);
    for (const Eigen::Vector3f& vertex : mesh.vertices) position.add(vertex);
    for (const Eigen::Vector3f& vector : mesh.normals) normal.add(vector);
    for (const Eigen::Vector3i& triangle : mesh.triangles) corner.add(triangle);
  }
  file.write("piece/part", part);
  file.write("piece/vertices", vertices);
  file.write("piece/triangles", triangles);
  file.write("piece/opacity", opacity);
  colour.write(file, "piece/colour");
  position.write(file, "vertex/position");
  normal.write(file, "vertex/normal");
  corner.write(file, "triangle/vertex");
}

}  // namespace

void write_shape(Hdf5Writer& file, const Body& body, const RobotShape& shape) {
  const auto write = [&](const std::string& name, const Eigen::VectorXd& values) {
    file.write(name, std::vector<double>(values.begin(), values.end()));
  };
  file.attribute("joints", fmt::format("{}", fmt::join(body.moving(), "\n")));
  write("joint/lower", body.lower());
  write("joint/upper", body.upper());
  file.attribute("deviation", shape.deviation);
  write_parts(file, shape.parts);
  write_pieces(file, shape.pieces);
}

}  // namespace hbr::inline stages
