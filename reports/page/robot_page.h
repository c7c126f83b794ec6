// A page of a robot that is looked at before it has a place in a profile: it turns, and its joints follow
// sliders.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hbr::inline reports {

struct RobotPage {
  std::string name;
  std::filesystem::path shape;  // an HDF5 file, see stages/robots/shape_file.h
  std::string told;             // of the robot, as on a terminal
  struct Picture {
    std::string file, shows;  // a file beside the page
  };
  std::vector<Picture> pictures;
};

// HTML, complete in itself but for the pictures beside it. three: where three.js is; without it the page has
// no robot that turns, and says so.
std::string robot_page(const RobotPage& page, const std::filesystem::path& three);

}  // namespace hbr::inline reports
