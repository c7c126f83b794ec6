#include "models/robot/description/urdf_tree.h"

#include <fmt/ranges.h>

#include "pipeline/core/settings.h"

namespace hbr::inline robots {
namespace {

// Elements of the robot by their names.
std::map<std::string, const XMLElement*> named(const UrdfText& text, const char* kind) {
  std::map<std::string, const XMLElement*> result;
  for (auto* e = text.robot().FirstChildElement(kind); e; e = e->NextSiblingElement(kind)) {
    const auto [earlier, is_new] = result.emplace(text.name(*e, "name"), e);
    if (!is_new)
      throw InputError("{}: a second {}; the first is in line {}; expected names of their own",
                       text.place(*e), UrdfText::what(*e), earlier->second->GetLineNum());
  }
  return result;
}

void refuse_xacro(const UrdfText& text, const XMLElement& above) {
  for (auto* e = above.FirstChildElement(); e; e = e->NextSiblingElement()) {
    if (std::string_view(e->Name()).starts_with("xacro:"))
      throw InputError(
          "{}: <{}>: this is a xacro, not yet a URDF; expected what `xacro FILE > robot.urdf` makes of it",
          text.place(*e), e->Name());
    refuse_xacro(text, *e);
  }
}

class Tree {
 public:
  explicit Tree(const UrdfText& text) : text_(text), links_(named(text, "link")) {
    if (links_.empty())
      throw InputError("{}: the robot has no <link>; expected at least one", text.place(text.robot()));
    named(text, "joint");
    for (auto* e = text.robot().FirstChildElement("joint"); e; e = e->NextSiblingElement("joint")) {
      const XMLElement *parent = end(*e, "parent"), *child = end(*e, "child");
      const auto [other, only_parent] = hangs_on_.emplace(child, e);
      if (!only_parent)
        throw InputError("{}: {} is the child of two joints, '{}' and '{}'; links must be a tree",
                         text.place(*e), UrdfText::what(*child), other->second->Attribute("name"),
                         e->Attribute("name"));
      children_[parent].push_back({child, e, -1});
    }
  }

  UrdfTree ordered() const {
    UrdfTree tree;
    tree.nodes.push_back({root(), nullptr, -1});
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
      const auto children = children_.find(tree.nodes[i].link);
      if (children == children_.end()) continue;
      for (UrdfTree::Node node : children->second) {
        node.parent = static_cast<int>(i);
        tree.nodes.push_back(node);
      }
    }
    std::map<const XMLElement*, bool> reached;
    for (const UrdfTree::Node& node : tree.nodes) reached[node.link] = true;
    for (auto* e = text_.robot().FirstChildElement("link"); e; e = e->NextSiblingElement("link"))
      if (!reached.count(e)) refuse_cycle(*e);
    return tree;
  }

 private:
  const XMLElement* end(const XMLElement& joint, const char* side) const {
    const XMLElement* element = joint.FirstChildElement(side);
    if (!element) text_.refuse(joint, "has no <{0}>; expected <{0} link=\"...\"/>", side);
    const std::string name = text_.name(*element, "link");
    const auto found = links_.find(name);
    if (found == links_.end()) {
      std::vector<std::string> names;
      for (const auto& [link, ignored] : links_) names.push_back(link);
      throw InputError("{}: the {} of {} is link '{}', which is not in the file: the chain is broken{}",
                       text_.place(*element), side, UrdfText::what(joint), name, did_you_mean(name, names));
    }
    return found->second;
  }

  const XMLElement* root() const {
    std::vector<std::string> names;
    const XMLElement* found = nullptr;
    for (auto* e = text_.robot().FirstChildElement("link"); e; e = e->NextSiblingElement("link")) {
      if (hangs_on_.count(e)) continue;
      found = e;
      names.emplace_back(e->Attribute("name"));
    }
    if (names.size() > 1)
      throw InputError("{}: {} links hang on no joint ('{}'); expected one root: join them by fixed joints",
                       text_.place(*found), names.size(), fmt::join(names, "', '"));
    if (!found) refuse_cycle(*text_.robot().FirstChildElement("link"));
    return found;
  }

  [[noreturn]] void refuse_cycle(const XMLElement& link) const {
    text_.refuse(link, "is part of a cycle of joints, or hangs on one; links must be a tree");
  }

  const UrdfText& text_;
  std::map<std::string, const XMLElement*> links_;
  std::map<const XMLElement*, const XMLElement*> hangs_on_;  // link -> its joint
  std::map<const XMLElement*, std::vector<UrdfTree::Node>> children_;
};

}  // namespace

UrdfTree read_tree(const UrdfText& text) {
  refuse_xacro(text, text.robot());
  return Tree(text).ordered();
}

}  // namespace hbr::inline robots
