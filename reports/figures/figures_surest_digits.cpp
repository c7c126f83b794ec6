// The arm drawing its digits, in motion where the page can move.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/core/check.h"
#include "reports/figures/figures.h"
#include "reports/plot/picture.h"

namespace hbr::inline reports {
namespace {

constexpr int kFrames = 30;       // poses of an animation, evenly along the stroke
constexpr double kSeconds = 5;    // of a round: drawing, then a rest
constexpr double kDrawing = 0.8;  // share of it that is drawing
constexpr double kStrokesCell = 240, kStrokesGap = 8;

struct Point {
  double x, y;  // m
};
using Points = std::vector<Point>;

struct Stroke {
  int label;
  bool good;
  Points pen;               // where the pen goes
  std::vector<Points> arm;  // the arm at each of these, from its base to the pen
};

Points arm_at(const float* joints, const std::vector<float>& links) {
  Points arm{{0, 0}};
  double angle = 0;
  for (std::size_t k = 0; k < links.size(); ++k) {
    angle += joints[k];
    arm.push_back({arm.back().x + links[k] * std::cos(angle), arm.back().y + links[k] * std::sin(angle)});
  }
  return arm;
}

std::vector<Stroke> read_strokes(const std::filesystem::path& path) {
  const Hdf5Reader file(path);
  const auto label = file.read<std::uint8_t>("label").values, good = file.read<std::uint8_t>("good").values;
  const auto points = file.read<std::int32_t>("points").values;
  const auto pen = file.read<float>("pen").values, joints = file.read<float>("joints").values,
             links = file.read<float>("links").values;
  std::size_t all = 0;
  for (const std::int32_t n : points) all += n < 1 ? pen.size() : static_cast<std::size_t>(n);
  if (label.size() != points.size() || good.size() != points.size() || pen.size() != 2 * all ||
      links.empty() || joints.size() != all * links.size())
    throw InputError("{}: label, good, points, pen and joints do not describe the same strokes",
                     path.string());
  std::vector<Stroke> strokes;
  std::size_t at = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    Stroke stroke{label[i], good[i] != 0, {}, {}};
    for (std::int32_t k = 0; k < points[i]; ++k, ++at) {
      stroke.pen.push_back({pen[2 * at], pen[2 * at + 1]});
      stroke.arm.push_back(arm_at(&joints[at * links.size()], links));
    }
    strokes.push_back(std::move(stroke));
  }
  return strokes;
}

// Where the pen is after each share of the whole length; the poses between two elites are theirs in turn.
std::vector<std::size_t> frames_of(const Points& pen) {
  std::vector<double> length{0};
  for (std::size_t k = 1; k < pen.size(); ++k)
    length.push_back(length.back() + std::hypot(pen[k].x - pen[k - 1].x, pen[k].y - pen[k - 1].y));
  std::vector<std::size_t> frames;
  for (int f = 0; f < kFrames; ++f) {
    const auto found = std::ranges::lower_bound(length, length.back() * f / (kFrames - 1.0));
    frames.push_back(std::min<std::size_t>(found - length.begin(), pen.size() - 1));
  }
  return frames;
}

// Metres to a cell that holds the base, the stroke and all poses.
class View {
 public:
  explicit View(const Stroke& stroke) {
    Point low{0, 0}, high{0, 0};
    for (const Points& arm : stroke.arm)
      for (const Point& p : arm) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y)};
      }
    middle_ = {(low.x + high.x) / 2, (low.y + high.y) / 2};
    scale_ = 0.88 * kStrokesCell / std::max({high.x - low.x, high.y - low.y, 1e-6});
  }
  std::string operator()(const Points& line) const {
    std::string text;
    for (const Point& p : line) text += fmt::format("{:.1f},{:.1f} ", x(p), y(p));
    if (!text.empty()) text.pop_back();
    return text;
  }
  double x(const Point& p) const { return kStrokesCell / 2 + scale_ * (p.x - middle_.x); }
  double y(const Point& p) const { return kStrokesCell / 2 - scale_ * (p.y - middle_.y); }

 private:
  Point middle_{};
  double scale_ = 1;
};

// The file, and the page where nobody starts the motion, show the finished stroke with the arm at its end.
std::string cell(const Stroke& stroke) {
  const View view(stroke);
  const std::vector<std::size_t> frames = frames_of(stroke.pen);
  const std::string timing = fmt::format(
      "begin=\"indefinite\" dur=\"{}s\" repeatCount=\"indefinite\" calcMode=\"linear\"", kSeconds);
  std::string poses, times;
  for (int f = 0; f < kFrames; ++f) {
    poses += view(stroke.arm[frames[f]]) + ";";
    times += fmt::format("{:.4f};", kDrawing * f / (kFrames - 1.0));
  }
  const std::string last = view(stroke.arm.back());
  std::string body;
  for (const std::size_t ghost : {std::size_t{0}, stroke.arm.size() / 3, 2 * stroke.arm.size() / 3})
    body += fmt::format(
        "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\" "
        "stroke-linejoin=\"round\" stroke-opacity=\"0.6\"/>\n",
        view(stroke.arm[ghost]), hex(Colour::faint));
  body += fmt::format(
      "<polyline points=\"{}\" pathLength=\"1\" fill=\"none\" stroke=\"{}\" stroke-width=\"7\" "
      "stroke-linejoin=\"round\" stroke-linecap=\"round\"><animate attributeName=\"stroke-dasharray\" "
      "values=\"0 1;1 0;1 0\" keyTimes=\"0;{};1\" {}/></polyline>\n",
      view(stroke.pen), hex(stroke.good ? Colour::ink : Colour::grey), kDrawing, timing);
  body += fmt::format(
      "<polyline points=\"{0}\" fill=\"none\" stroke=\"{1}\" stroke-width=\"3.5\" stroke-linejoin=\"round\" "
      "stroke-linecap=\"round\"><animate attributeName=\"points\" values=\"{2}{0}\" keyTimes=\"{3}1\" "
      "{4}/></polyline>\n",
      last, hex(Colour::blue), poses, times, timing);
  body += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"6\" fill=\"{}\"/>\n", view.x({0, 0}),
                      view.y({0, 0}), hex(Colour::blue));
  return body + svg_text(std::to_string(stroke.label), 4, 18, 16, Colour::grey, Align::left);
}

}  // namespace

Figure surest_digits_figure(const Evidence& evidence) {
  Figure figure{.id = "surest_digits", .title = "The arm at work"};
  figure.caption =
      "For each class, the digit of the first replication that the judge is most certain of, drawn by the "
      "arm "
      "through all four layers; grey if the judge does not call it good. Classes that were not found are "
      "left out. The circle is the arm’s base, pale lines are its earlier poses.";
  const auto files = evidence.artifacts.replications("surest_digits");
  const std::vector<Stroke> strokes = files.empty() ? std::vector<Stroke>{} : read_strokes(files[0]);
  if (strokes.empty()) {
    figure.absent = "This run has no digits whose strokes could be shown.";
    return figure;
  }
  constexpr int kColumns = 5;
  std::string body;
  for (std::size_t i = 0; i < strokes.size(); ++i) {
    const auto column = static_cast<double>(i % kColumns), row = static_cast<double>(i / kColumns);
    body += fmt::format("<g class=\"moving\" transform=\"translate({},{})\">\n{}</g>\n",
                        column * (kStrokesCell + kStrokesGap), row * (kStrokesCell + kStrokesGap),
                        cell(strokes[i]));
    for (std::size_t k = 0; k < strokes[i].pen.size(); ++k) {
      figure.tables["strokes"].add({{"class", static_cast<double>(strokes[i].label)},
                                    {"point", static_cast<double>(k)},
                                    {"x_m", strokes[i].pen[k].x},
                                    {"y_m", strokes[i].pen[k].y}});
    }
  }
  const double rows = std::ceil(static_cast<double>(strokes.size()) / kColumns);
  figure.panels.push_back(
      {"Digits as strokes",
       Drawing{kColumns * (kStrokesCell + kStrokesGap) - kStrokesGap,
               rows * (kStrokesCell + kStrokesGap) - kStrokesGap, body,
               "For each class that was found its digit, with the arm’s poses while it draws."},
       6});
  return figure;
}

}  // namespace hbr::inline reports
