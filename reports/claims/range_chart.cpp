#include "reports/claims/range_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "reports/text/html.h"

namespace hbr::inline reports {
namespace {

constexpr double kWidth = 170, kHeight = 18, kAir = 0.12, kRadius = 4.5;
constexpr double kFarApart = 30;  // greatest over least of what is shown on a logarithmic axis

// From a number to a place between the edges.
class Scale {
 public:
  explicit Scale(const std::vector<double>& shown) {
    const auto [least, greatest] = std::ranges::minmax(shown);
    logarithmic_ = least > 0 && greatest > kFarApart * least;
    low_ = at(least), high_ = at(greatest);
    double air = kAir * (high_ - low_);
    if (air <= 0) air = std::max(std::abs(high_), 1.0);
    low_ -= air, high_ += air;
  }
  double operator()(double value) const {
    const double share = (at(value) - low_) / (high_ - low_);
    return kRadius + std::clamp(share, 0.0, 1.0) * (kWidth - 2 * kRadius);
  }

 private:
  double at(double value) const { return logarithmic_ ? std::log10(value) : value; }

  bool logarithmic_ = false;
  double low_ = 0, high_ = 1;
};

}  // namespace

std::string range_chart(const nlohmann::json& check) {
  const double x = check.at("x");
  std::vector<double> shown{x};
  for (const char* range : {"reproduced", "partly"})
    for (const nlohmann::json& end : check.at(range))
      if (!end.is_null()) shown.push_back(end);
  const bool interval = check.contains("interval");
  if (interval)
    for (const nlohmann::json& end : check.at("interval")) shown.push_back(end);
  const Scale scale(shown);
  const auto band = [&](const char* range, const char* css) {
    const nlohmann::json &low = check.at(range).at(0), &high = check.at(range).at(1);
    const double from = low.is_null() ? 0 : scale(low), to = high.is_null() ? kWidth : scale(high);
    return fmt::format("<rect class=\"{}\" x=\"{:.1f}\" y=\"4\" width=\"{:.1f}\" height=\"{}\"/>", css, from,
                       std::max(to - from, 2.0), kHeight - 8);
  };
  return fmt::format(
      "<svg class=\"range\" viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{} where {} is asked\">"
      "<path class=\"axis\" d=\"M0 {}H{}\"/>{}{}{}<circle cx=\"{:.1f}\" cy=\"{}\" r=\"{}\"/></svg>",
      kWidth, kHeight, escape_html(check.at("figure").get<std::string>()),
      escape_html(check.at("asked").get<std::string>()), kHeight / 2, kWidth, band("partly", "in-part"),
      band("reproduced", "asked"),
      interval
          ? fmt::format("<path class=\"interval\" d=\"M{:.1f} {}H{:.1f}\"/>",
                        scale(check.at("interval").at(0)), kHeight / 2, scale(check.at("interval").at(1)))
          : "",
      scale(x), kHeight / 2, kRadius);
}

}  // namespace hbr::inline reports
