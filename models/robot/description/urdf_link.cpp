#include "models/robot/description/urdf_link.h"

#include <algorithm>
#include <cctype>

namespace hbr::inline robots {
namespace {

// Nothing where the material names no colour that is one.
std::optional<Eigen::Vector3f> colour_of(UrdfText& text, const XMLElement& material) {
  const XMLElement* e = material.FirstChildElement("color");
  if (!e) return {};
  const char* written = e->Attribute("rgba");
  const std::vector<double> rgba = numbers_in(written ? written : "");
  const auto within = [&](double most) {
    return std::ranges::all_of(rgba, [&](double x) { return x >= 0 && x <= most; });
  };
  if ((rgba.size() != 3 && rgba.size() != 4) || !within(255)) {
    text.odd(*e,
             "has rgba '{}', shown in a colour of ours; expected 4 numbers from 0 to 1, such as 1 0.5 0 1",
             written ? written : "");
    return {};
  }
  const Eigen::Vector3f colour = Eigen::Vector3d(rgba.data()).cast<float>();
  if (within(1)) return colour;
  text.odd(*e, "has rgba '{}', taken as parts of 255; expected numbers from 0 to 1: divide them by 255",
           written);
  return colour / 255;
}

std::optional<Eigen::Vector3f> colour_of(UrdfText& text, const XMLElement& visual, const Colours& colours) {
  const XMLElement* material = visual.FirstChildElement("material");
  if (!material) return {};
  if (const auto own = colours.own.find(material); own != colours.own.end()) return own->second;
  const char* name = material->Attribute("name");
  if (const auto known = colours.named.find(name ? name : ""); known != colours.named.end())
    return known->second;
  if (material->FirstChildElement("texture"))
    text.odd(*material,
             "'{}' has a texture, which is not drawn, and no colour: shown in one of ours; add "
             "<color rgba=\"...\"/>",
             name ? name : "");
  else if (!material->FirstChildElement("color"))
    text.odd(*material, "'{}' has no colour, here or elsewhere in the file: shown in one of ours",
             name ? name : "");
  return {};
}

// The shape's kind and size; nothing where it is none that a URDF knows.
std::optional<std::pair<Visual::Kind, Eigen::Vector3d>> shape_of(const UrdfText& text, const XMLElement& e) {
  const std::string_view kind = e.Name();
  const auto length = [&](const char* attribute) { return text.number(&e, attribute, 0); };
  if (kind == "mesh") return {{Visual::Kind::mesh, text.three(&e, "scale", {1, 1, 1})}};
  if (kind == "box") return {{Visual::Kind::box, text.three(&e, "size", {0, 0, 0})}};
  if (kind == "sphere") return {{Visual::Kind::sphere, Eigen::Vector3d::Constant(length("radius"))}};
  const Eigen::Vector3d round(length("radius"), length("radius"), length("length"));
  if (kind == "cylinder") return {{Visual::Kind::cylinder, round}};
  if (kind == "capsule") return {{Visual::Kind::capsule, round}};
  return {};
}

std::optional<Visual> visual_of(UrdfText& text, const XMLElement& visual, const Colours& colours) {
  const XMLElement* geometry = visual.FirstChildElement("geometry");
  const XMLElement* shape = geometry ? geometry->FirstChildElement() : nullptr;
  if (!shape) {
    text.odd(visual, "has no shape: left out; expected <geometry> with a mesh, box, cylinder or sphere");
    return {};
  }
  const auto read = shape_of(text, *shape);
  if (!read) {
    text.odd(*shape, "is no shape of a URDF: left out; expected a mesh, box, cylinder or sphere");
    return {};
  }
  const auto& [kind, size] = *read;
  if (kind == Visual::Kind::mesh ? (size.array() == 0).any() : !(size.array() > 0).all()) {
    text.odd(*shape, "has the {} {:g} {:g} {:g}: left out; expected more than 0",
             kind == Visual::Kind::mesh ? "scale" : "size", size[0], size[1], size[2]);
    return {};
  }
  Visual out{kind, text.origin(visual), {}, size, colour_of(text, visual, colours)};
  if (kind == Visual::Kind::mesh) {
    const char* file = shape->Attribute("filename");
    out.mesh = file ? file : "";
    if (out.mesh.empty()) {
      text.odd(*shape, "has no filename: left out");
      return {};
    }
    if (std::ranges::any_of(out.mesh, [](unsigned char c) { return std::iscntrl(c); }))
      text.refuse(*shape, "has a control character in its filename '{}'; expected a name in one line",
                  out.mesh);
  }
  return out;
}

void read_inertial(UrdfText& text, const XMLElement& element, Link& link) {
  const XMLElement *mass = element.FirstChildElement("mass"), *inertia = element.FirstChildElement("inertia");
  Inertial out{text.number(mass, "value", 0, kMostWeight), {}, {}};
  const auto moment = [&](const char* name) { return text.number(inertia, name, 0, kMostWeight); };
  // Read before they are put in: Eigen's list of coefficients may not be left by an exception.
  const double xx = moment("ixx"), xy = moment("ixy"), xz = moment("ixz"), yy = moment("iyy"),
               yz = moment("iyz"), zz = moment("izz");
  out.inertia << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  const Eigen::Isometry3d frame = text.origin(element);
  out.centre = frame.translation();
  out.inertia = (frame.linear() * out.inertia * frame.linear().transpose()).eval();
  if (out.mass > 0)
    link.inertial = out;
  else if (out.mass < 0)
    text.odd(*mass, "is {:g} kg: the <inertial> is left out; expected more than 0", out.mass);
  else  // nothing at all is a mere frame: many programs write one so
    link.weightless_inertia = !out.inertia.isZero(0);
}

// Nobody here runs into a URDF's <collision>, but who has one wants to know.
void look_at_collision(UrdfText& text, const XMLElement& collision) {
  const XMLElement* geometry = collision.FirstChildElement("geometry");
  const XMLElement* shape = geometry ? geometry->FirstChildElement() : nullptr;
  constexpr std::string_view kKnown[] = {"mesh", "box", "cylinder", "sphere"};
  if (shape && std::ranges::find(kKnown, shape->Name()) == std::end(kKnown))
    text.odd(*shape, "is no shape of a URDF: the <collision> is left out");
}

}  // namespace

Colours read_colours(UrdfText& text) {
  Colours colours;
  const auto read_all_in = [&](const XMLElement& above) {
    for (auto* e = above.FirstChildElement("material"); e; e = e->NextSiblingElement("material"))
      if (const auto colour = colour_of(text, *e)) {
        colours.own.emplace(e, *colour);
        if (const char* name = e->Attribute("name")) colours.named.emplace(name, *colour);
      }
  };
  read_all_in(text.robot());
  for (auto* link = text.robot().FirstChildElement("link"); link; link = link->NextSiblingElement("link"))
    for (auto* e = link->FirstChildElement("visual"); e; e = e->NextSiblingElement("visual")) read_all_in(*e);
  return colours;
}

Link read_link(UrdfText& text, const XMLElement& element, const Colours& colours) {
  Link link;
  link.name = element.Attribute("name");
  if (auto* e = element.FirstChildElement("inertial")) read_inertial(text, *e, link);
  for (auto* e = element.FirstChildElement("visual"); e; e = e->NextSiblingElement("visual"))
    if (auto visual = visual_of(text, *e, colours)) link.visuals.push_back(std::move(*visual));
  for (auto* e = element.FirstChildElement("collision"); e; e = e->NextSiblingElement("collision"))
    look_at_collision(text, *e);
  return link;
}

}  // namespace hbr::inline robots
