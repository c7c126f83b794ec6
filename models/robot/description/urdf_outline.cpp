#include "models/robot/description/urdf_outline.h"

#include <fmt/ranges.h>
#include <tinyxml2.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <set>

#include "models/robot/description/urdf_numbers.h"
#include "pipeline/core/check.h"

namespace hbr {
namespace {

using tinyxml2::XMLElement;

// "XML_ERROR_MISMATCHED_ELEMENT": "mismatched element".
std::string words(std::string name) {
  for (const std::string_view prefix : {"XML_", "ERROR_"})
    if (name.starts_with(prefix)) name.erase(0, prefix.size());
  for (char& c : name) c = c == '_' ? ' ' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return name;
}

class Reader {
 public:
  Reader(const std::filesystem::path& path, const std::string& text) : path_(path.string()) {
    document_.Parse(text.c_str());
    // More than a hundred deep is refused here: urdfdom's reader recurses and would use up the stack.
    if (document_.ErrorID() == tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED)
      throw InputError("{}:{}: elements are nested without end; expected a URDF", path_,
                       document_.ErrorLineNum());
    if (document_.Error())
      throw InputError("{}:{}: not XML ({}); expected a URDF", path_, std::max(1, document_.ErrorLineNum()),
                       words(document_.ErrorName()));
    robot_ = document_.FirstChildElement("robot");
    if (!robot_) {
      const XMLElement* top = document_.RootElement();
      throw InputError("{}: no <robot>; expected a URDF, found <{}>", path_, top ? top->Name() : "nothing");
    }
  }

  UrdfOutline read() {
    refuse_xacro(*robot_);
    read_links();
    read_joints();
    check_numbers(path_, *robot_);
    return order();
  }

 private:
  void refuse_xacro(const XMLElement& above) const {
    for (auto* e = above.FirstChildElement(); e; e = e->NextSiblingElement()) {
      if (std::string_view(e->Name()).starts_with("xacro:"))
        throw InputError("{}:{}: <{}>: this is a xacro, not yet a URDF; expected what xacro makes of it",
                         path_, e->GetLineNum(), e->Name());
      refuse_xacro(*e);
    }
  }
  // The attribute of an element, or of its child of that name.
  std::string attribute(const XMLElement& element, const char* key, const std::string& what) const {
    const char* value = element.Attribute(key);
    if (!value || !*value) throw InputError("{}:{}: {} has no '{}'", path_, element.GetLineNum(), what, key);
    std::string shown = value;
    std::ranges::replace_if(
        shown, [](unsigned char c) { return std::iscntrl(c); }, ' ');
    if (shown != value)
      throw InputError("{}:{}: {} has a control character in its {} '{}'", path_, element.GetLineNum(), what,
                       key, shown);
    return value;
  }
  std::string end(const XMLElement& joint, const char* side, const std::string& what) const {
    const XMLElement* element = joint.FirstChildElement(side);
    if (!element)
      throw InputError("{}:{}: {} has no <{} link=\"...\">", path_, joint.GetLineNum(), what, side);
    const std::string name = attribute(*element, "link", fmt::format("<{}> of {}", side, what));
    if (!links_.count(name))
      throw InputError("{}:{}: the {} of {} is link '{}', which is not in the file: the chain is broken",
                       path_, element->GetLineNum(), side, what, name);
    return name;
  }

  void read_links() {
    for (auto* e = robot_->FirstChildElement("link"); e; e = e->NextSiblingElement("link")) {
      const std::string name = attribute(*e, "name", "a <link>");
      const auto [earlier, is_new] = links_.emplace(name, e->GetLineNum());
      if (!is_new)
        throw InputError("{}:{}: a second link '{}'; the first is in line {}", path_, e->GetLineNum(), name,
                         earlier->second);
      link_order_.push_back(name);
    }
    if (links_.empty()) throw InputError("{}:{}: the robot has no <link>", path_, robot_->GetLineNum());
  }

  void read_joints() {
    static const std::set<std::string> known = {"revolute", "continuous", "prismatic", "fixed"};
    std::map<std::string, int> lines;
    for (auto* e = robot_->FirstChildElement("joint"); e; e = e->NextSiblingElement("joint")) {
      const std::string name = attribute(*e, "name", "a <joint>"), what = fmt::format("joint '{}'", name);
      const auto [earlier, is_new] = lines.emplace(name, e->GetLineNum());
      if (!is_new)
        throw InputError("{}:{}: a second {}; the first is in line {}", path_, e->GetLineNum(), what,
                         earlier->second);
      const std::string type = attribute(*e, "type", what);
      if (!known.count(type))
        throw InputError("{}:{}: {} has type '{}'; expected one of {}", path_, e->GetLineNum(), what, type,
                         fmt::join(known, ", "));
      const UrdfOutline::Joint joint{name, end(*e, "parent", what), end(*e, "child", what), e->GetLineNum()};
      const auto [other, only_parent] = parent_joint_.emplace(joint.child, name);
      if (!only_parent)
        throw InputError("{}:{}: link '{}' is the child of two joints, '{}' and '{}'; links must be a tree",
                         path_, e->GetLineNum(), joint.child, other->second, name);
      children_[joint.parent].push_back(joint);
    }
  }

  UrdfOutline order() const {
    std::vector<std::string> roots;
    for (const std::string& name : link_order_)
      if (!parent_joint_.count(name)) roots.push_back(name);
    if (roots.size() > 1)
      throw InputError("{}: {} links hang on no joint ('{}'); expected one root", path_, roots.size(),
                       fmt::join(roots, "', '"));
    UrdfOutline outline;
    if (roots.size() == 1) outline.links.push_back({roots[0], links_.at(roots[0])});
    for (std::size_t i = 0; i < outline.links.size(); ++i) {
      const auto children = children_.find(outline.links[i].name);
      if (children == children_.end()) continue;
      for (const UrdfOutline::Joint& joint : children->second) {
        outline.joints.push_back(joint);
        outline.links.push_back({joint.child, links_.at(joint.child)});
      }
    }
    if (outline.links.size() == links_.size()) return outline;
    std::set<std::string> reached;
    for (const UrdfOutline::Link& link : outline.links) reached.insert(link.name);
    for (const std::string& name : link_order_)
      if (!reached.count(name))
        throw InputError("{}:{}: link '{}' is part of a cycle of joints; links must be a tree", path_,
                         links_.at(name), name);
    return outline;
  }

  std::string path_;
  tinyxml2::XMLDocument document_;
  XMLElement* robot_;
  std::map<std::string, int> links_;  // name -> line
  std::vector<std::string> link_order_;
  std::map<std::string, std::string> parent_joint_;  // link -> the joint it hangs on
  std::map<std::string, std::vector<UrdfOutline::Joint>> children_;
};

}  // namespace

UrdfOutline read_outline(const std::filesystem::path& path, const std::string& text) {
  return Reader(path, text).read();
}

}  // namespace hbr
