// Elements of a URDF with their places: every value is read where its line is known, and what is wrong is
// told with file, line, value and what was expected.
#pragma once

#include <tinyxml2.h>

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "pipeline/core/check.h"

namespace hbr::inline robots {

using tinyxml2::XMLElement;

// Magnitudes beyond which sums and squares overflow; nothing is that large, but for limits: some write 1e16
// for "none".
inline constexpr double kMostLength = 1e6, kMostWeight = 1e15, kMostLimit = 1e18;

class UrdfText {
 public:
  // Throws InputError where `text`, the contents of `path` in UTF-8, is not XML with a <robot>.
  UrdfText(std::string path, const std::string& text);

  const XMLElement& robot() const { return *robot_; }
  const std::string& path() const { return path_; }

  // "arm.urdf:12"
  std::string place(const XMLElement& element) const;
  // "<origin> of link 'base'", for an element in it; "link 'base'" for the link itself.
  static std::string what(const XMLElement& element);

  // A name: there, not empty, in one line. Throws InputError otherwise.
  std::string name(const XMLElement& element, const char* attribute) const;

  // Numbers of an attribute; `otherwise` where the element (which may be null) or its attribute is not there.
  // Throws InputError for anything but as many finite numbers of at most this magnitude.
  double number(const XMLElement* element, const char* attribute, double otherwise,
                double most = kMostLength) const;
  Eigen::Vector3d three(const XMLElement* element, const char* attribute, const Eigen::Vector3d& otherwise,
                        double most = kMostLength) const;
  // Of <origin> in the element; the identity without one.
  Eigen::Isometry3d origin(const XMLElement& element) const;

  // What was read otherwise than it stands there, told in a line.
  template <class... Args>
  void odd(const XMLElement& element, fmt::format_string<Args...> text, Args&&... args) {
    add_oddity(element, fmt::format(text, std::forward<Args>(args)...));
  }
  // One line for each text and kind of element, with the first's place.
  std::vector<std::string> oddities() const;

  template <class... Args>
  [[noreturn]] void refuse(const XMLElement& element, fmt::format_string<Args...> text,
                           Args&&... args) const {
    throw InputError("{}: {} {}", place(element), what(element),
                     fmt::format(text, std::forward<Args>(args)...));
  }

 private:
  struct Oddity {
    std::string kind, line;
    int more;  // of its kind
  };
  void add_oddity(const XMLElement& element, const std::string& text);

  std::string path_;
  tinyxml2::XMLDocument document_;
  const XMLElement* robot_;
  std::vector<Oddity> oddities_;
};

// The finite numbers of a text, which blanks or line breaks separate; empty where it holds anything else.
std::vector<double> numbers_in(std::string_view text);

}  // namespace hbr::inline robots
