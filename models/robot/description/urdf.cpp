// load_urdf: from the file to the tree of links and joints.
#include <cctype>
#include <fstream>
#include <iterator>

#include "models/robot/description/urdf_joint.h"
#include "models/robot/description/urdf_link.h"
#include "models/robot/description/urdf_tree.h"
#include "models/robot/description/utf8.h"

namespace hbr::inline robots {
namespace {

// One line of no more than a thousand bytes: names and values of the file may hold anything.
std::string one_line(std::string text) {
  for (char& c : text)
    if (std::iscntrl(static_cast<unsigned char>(c))) c = ' ';
  constexpr std::size_t kLongest = 1000;
  return text.size() > kLongest ? text.substr(0, kLongest) + " ..." : text;
}

constexpr std::size_t kMostLinks = 1000;  // several humanoids with hands have fewer

RobotModel read_urdf(const std::filesystem::path& path) {
  std::error_code ignored;  // a pipe might never end
  const bool is_file = std::filesystem::is_regular_file(path, ignored);
  std::ifstream file;
  if (is_file) file.open(path, std::ios::binary);
  if (!is_file || !file) throw InputError("{}: can't be read; expected a URDF", path.string());
  const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};

  std::vector<std::string> odd;
  UrdfText text(path.string(), utf8_of_xml(path.string(), bytes, odd));
  const UrdfTree tree = read_tree(text);
  if (tree.nodes.size() > kMostLinks)
    throw InputError("{}: {} links; expected at most {}: take the robot that draws alone", path.string(),
                     tree.nodes.size(), kMostLinks);
  const Colours colours = read_colours(text);
  RobotModel model;
  model.path = path;
  const char* name = text.robot().Attribute("name");
  model.name = name && *name ? name : path.stem().string();
  if (!name || !*name) text.odd(text.robot(), "has no name: called '{}' after its file", model.name);
  std::vector<const XMLElement*> joints;
  for (const UrdfTree::Node& node : tree.nodes) {
    model.links.push_back(read_link(text, *node.link, colours));
    model.links.back().joint = static_cast<int>(model.joints.size()) - (node.joint ? 0 : 1);
    if (!node.joint) continue;
    Joint joint = read_joint(text, *node.joint);
    joint.parent = node.parent;
    joint.child = static_cast<int>(model.links.size()) - 1;
    model.joints.push_back(std::move(joint));
    joints.push_back(node.joint);
  }
  link_mimics(text, joints, model.joints);
  for (std::string& line : text.oddities()) odd.push_back(std::move(line));
  for (const std::string& line : odd) model.odd.push_back(one_line(line));
  return model;
}

}  // namespace

RobotModel load_urdf(const std::filesystem::path& path) {
  try {
    return read_urdf(path);
  } catch (const InputError& error) {
    throw InputError("{}", one_line(error.what()));
  }
}

}  // namespace hbr::inline robots
