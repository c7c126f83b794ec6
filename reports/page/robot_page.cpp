#include "reports/page/robot_page.h"

#include <fmt/format.h>

#include "reports/page/assets.h"
#include "reports/page/shape_pack.h"
#include "reports/text/html.h"
#include "reports/text/template.h"

namespace hbr::inline reports {

std::string robot_page(const RobotPage& page, const std::filesystem::path& three) {
  const bool turns = std::filesystem::exists(three / "three.module.min.js");
  std::string pictures;
  for (const auto& [file, shows] : page.pictures)
    pictures += fmt::format("<figure><img src=\"{}\" alt=\"{}\"><figcaption>{}</figcaption></figure>\n",
                            escape_url(file), escape_html(shows), escape_html(shows));
  TemplateContent content;
  content.values = {
      {"name", escape_html(page.name)},
      {"told", escape_html(page.told)},
      {"pictures", pictures},
      {"absent",
       turns ? "" : "<p>three.js could not be had, with which this page would show the robot turning.</p>"},
      {"packs", turns ? shape_pack("shown", page.shape) + three_pack(three) : ""},
      {"script", kRobotPageJs}};
  return fill_template(kRobotPageHtml, content);
}

}  // namespace hbr::inline reports
