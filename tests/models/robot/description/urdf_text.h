// Small URDFs for tests.
#pragma once

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "models/robot/description/robot_model.h"

namespace hbr {

// A folder that is gone with the test.
class TestFolder {
 public:
  TestFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "hbr-test-XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~TestFolder() { std::filesystem::remove_all(path_); }
  TestFolder(const TestFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

inline std::string inertial(const std::string& mass = "1",
                            const std::string& moments = R"(ixx="1" iyy="1" izz="1")") {
  return fmt::format(R"(<inertial><mass value="{}"/><inertia {} ixy="0" ixz="0" iyz="0"/></inertial>)", mass,
                     moments);
}
inline std::string link(const std::string& name, const std::string& inside = inertial()) {
  return fmt::format("<link name=\"{}\">{}</link>\n", name, inside);
}
inline std::string joint(const std::string& name, const std::string& parent, const std::string& child,
                         const std::string& type = "revolute",
                         const std::string& inside =
                             R"(<axis xyz="0 0 1"/><limit lower="-1" upper="1" effort="1" velocity="1"/>)") {
  return fmt::format(
      "<joint name=\"{}\" type=\"{}\"><parent link=\"{}\"/><child link=\"{}\"/>\n"
      "<origin xyz=\"0.1 0.2 0.3\" rpy=\"0.4 0.5 0.6\"/>{}</joint>\n",
      name, type, parent, child, inside);
}
inline std::string robot(const std::string& inside) {
  return "<?xml version=\"1.0\"?>\n<robot name=\"test\">\n" + inside + "</robot>\n";
}
// The robot of these parts.
inline RobotModel load(const std::string& inside) {
  const TestFolder folder;
  return load_urdf(folder.write("a.urdf", robot(inside)));
}

}  // namespace hbr
