#include "pipeline/drawing/draw.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "pipeline/core/check.h"

namespace hbr::inline drawing {
namespace {

constexpr double kBoxPixels = 20;      // side of the box that MNIST's digits fill
constexpr double kMassCentre = 14.5;   // middle of pixel 14, counted from the image's edge
constexpr double kLeastExtent = 1e-3;  // m; a smaller path shrinks to a dot rather than being blown up

struct Path {
  const float* xy;  // [points x 2]
  Eigen::Index points;
};

// Metres to pixels, counted from the image's left and upper edge; y points down in the image.
struct View {
  double scale;               // px per m
  double origin_x, origin_y;  // m, the point that lands at (at_x, at_y)
  double at_x, at_y;          // px

  float x(float metres) const { return static_cast<float>((metres - origin_x) * scale + at_x); }
  float y(float metres) const { return static_cast<float>((origin_y - metres) * scale + at_y); }
};

// The ink of a path, from the distance of sub-pixel centres to it.
//
// Distances to a polyline are exact and cheap where a general polygon fill is neither, and a sub-pixel's
// share of ink is nearly linear in the distance to the edge.
class Ink {
 public:
  Ink(const Path& path, const View& view, double width_px)
      : reach_(static_cast<float>(width_px / 2 * kSub) + 0.5f) {
    find_rows(path, view);
    std::fill(row(y_begin_), row(y_end_), kFar);
    float x = view.x(path.xy[0]) * kSub - 0.5f, y = view.y(path.xy[1]) * kSub - 0.5f;
    if (path.points == 1) add(x, y, x, y);
    for (Eigen::Index i = 1; i < path.points; ++i) {
      const float to_x = view.x(path.xy[2 * i]) * kSub - 0.5f,
                  to_y = view.y(path.xy[2 * i + 1]) * kSub - 0.5f;
      add(x, y, to_x, to_y);
      x = to_x;
      y = to_y;
    }
    // Without std::clamp, whose references keep the loop from being vectorised.
    const float reach = reach_;
    for (float* value = row(y_begin_); value != row(y_end_); ++value) {
      float share = reach - std::sqrt(*value);
      share = share < 0 ? 0 : share;
      *value = share > 1 ? 1 : share;
    }
  }

  // Mean ink of each pixel.
  void pixels(float* image) const {
    for (int y = 0; y < kImageSide; ++y) {
      std::array<float, kRow> column{};
      for (int i = std::max(y * kSub, y_begin_); i < std::min((y + 1) * kSub, y_end_); ++i)
        for (int x = 0; x < kRow; ++x) column[x] += row(i)[x];
      for (int x = 0; x < kImageSide; ++x) {
        float sum = 0;
        for (int i = 0; i < kSub; ++i) sum += column[x * kSub + i];
        image[y * kImageSide + x] = sum * (1.0f / (kSub * kSub));
      }
    }
  }

  // Centre of mass in pixels from the image's left and upper edge; the image's middle where there is no ink.
  std::array<double, 2> centre_of_mass() const {
    std::array<float, kRow> column{}, moment{};
    for (int y = y_begin_; y < y_end_; ++y)
      for (int x = 0; x < kRow; ++x) {
        const float ink = row(y)[x];
        column[x] += ink;
        moment[x] += ink * (static_cast<float>(y) + 0.5f);
      }
    double mass = 0, mass_x = 0, mass_y = 0;
    for (int x = 0; x < kSize; ++x) {
      mass += column[x];
      mass_x += column[x] * (x + 0.5);
      mass_y += moment[x];
    }
    if (mass <= 0) return {kImageSide / 2.0, kImageSide / 2.0};
    return {mass_x / mass / kSub, mass_y / mass / kSub};
  }

 private:
  static constexpr int kSub = 2;  // sub-pixels along a pixel's side
  static constexpr int kSize = kImageSide * kSub;
  static constexpr int kLanes = 16;  // sub-pixels of a row that are worked on together
  static constexpr int kRow = (kSize + kLanes - 1) / kLanes * kLanes;
  static constexpr float kFar = 1e12f;

  float* row(int y) { return squared_.data() + y * kRow; }
  const float* row(int y) const { return squared_.data() + y * kRow; }

  // The rows that the path's ink reaches.
  void find_rows(const Path& path, const View& view) {
    float low = view.y(path.xy[1]), high = low;
    for (Eigen::Index i = 1; i < path.points; ++i) {
      const float y = view.y(path.xy[2 * i + 1]);
      low = y < low ? y : low;
      high = y > high ? y : high;
    }
    y_begin_ = first(low * kSub - 0.5f);
    y_end_ = std::max(last(high * kSub - 0.5f), y_begin_);
  }

  // Lowers the squared distances to those to the segment a-b, where it is near enough to matter: column by
  // column of kLanes, in the rows that its ink can reach there.
  void add(float ax, float ay, float bx, float by) {
    const int x_end = last(std::max(ax, bx));
    const float ex = bx - ax, ey = by - ay;
    const float length2 = ex * ex + ey * ey;
    const float inverse = length2 > 0 ? 1 / length2 : 0;
    for (int x = first(std::min(ax, bx)); x < x_end; x += kLanes) {
      float from_y = ay, to_y = by;
      if (std::abs(ex) > kLanes) {  // only a part of the segment is within reach of the column
        const auto y_at = [&](float column) { return ay + std::clamp((column - ax) / ex, 0.f, 1.f) * ey; };
        from_y = y_at(static_cast<float>(x) - reach_);
        to_y = y_at(static_cast<float>(x + kLanes) + reach_);
      }
      lower(std::min(x, kRow - kLanes), first(std::min(from_y, to_y)), last(std::max(from_y, to_y)), ax, ay,
            ex, ey, inverse);
    }
  }

  void lower(int x, int y_begin, int y_end, float ax, float ay, float ex, float ey, float inverse) {
    std::array<float, kLanes> dx, dx_ex;
    for (int lane = 0; lane < kLanes; ++lane) {
      dx[lane] = static_cast<float>(x + lane) - ax;
      dx_ex[lane] = dx[lane] * ex;
    }
    for (int y = y_begin; y < y_end; ++y) {
      const float dy = static_cast<float>(y) - ay, dy_ey = dy * ey;
      float* squared = row(y) + x;
      for (int lane = 0; lane < kLanes; ++lane) {
        float along = (dx_ex[lane] + dy_ey) * inverse;
        along = along < 0 ? 0 : along;
        along = along > 1 ? 1 : along;
        const float rx = dx[lane] - along * ex, ry = dy - along * ey;
        const float distance2 = rx * rx + ry * ry;
        squared[lane] = distance2 < squared[lane] ? distance2 : squared[lane];
      }
    }
  }

  // The sub-pixels [first, last) that ink between two coordinates can reach.
  int first(float low) const {
    return static_cast<int>(std::clamp(std::ceil(low - reach_), 0.0f, float{kSize}));
  }
  int last(float high) const {
    return static_cast<int>(std::clamp(std::floor(high + reach_) + 1, 0.0f, float{kSize}));
  }

  float reach_;                  // sub-pixels; where the ink has faded to nothing
  int y_begin_ = 0, y_end_ = 0;  // the rows that the ink reaches; the others of squared_ have no value
  alignas(64) std::array<float, kSize * kRow> squared_;  // squared distance, then ink
};

struct Box {
  float left, right, low, high;  // m
};

Box bounding_box(const Path& path) {
  Box box{path.xy[0], path.xy[0], path.xy[1], path.xy[1]};
  float check = 0;
  for (Eigen::Index i = 0; i < path.points; ++i) {
    const float x = path.xy[2 * i], y = path.xy[2 * i + 1];
    box.left = std::min(box.left, x);
    box.right = std::max(box.right, x);
    box.low = std::min(box.low, y);
    box.high = std::max(box.high, y);
    check += 0 * x + 0 * y;
  }
  HBR_CHECK(check == 0, "a pen point that is not finite, among {}", path.points);
  return box;
}

// Where, on one axis, the box's centre must be for the ink's centre of mass to be at its place: given both
// when the box's centre was in the middle. The ink, `size` px, stays inside the image.
double centred(double mass, double size) {
  const double middle = kImageSide / 2.0, room = std::max(0.0, (kImageSide - size) / 2);
  return middle + std::clamp(kMassCentre - mass, -room, room);
}

View box_view(const Path& path, double width_px) {
  const Box box = bounding_box(path);
  const double width = double{box.right} - box.left, height = double{box.high} - box.low;
  View view{};
  view.scale = (kBoxPixels - width_px) / std::max({width, height, kLeastExtent});
  view.origin_x = (double{box.left} + box.right) / 2;
  view.origin_y = (double{box.low} + box.high) / 2;
  view.at_x = view.at_y = kImageSide / 2.0;

  const auto [mass_x, mass_y] = Ink(path, view, width_px).centre_of_mass();
  view.at_x = centred(mass_x, width * view.scale + width_px);
  view.at_y = centred(mass_y, height * view.scale + width_px);
  return view;
}

}  // namespace

Framing framing_named(const std::string& name) {
  if (name == "box") return Framing::box;
  if (name == "workspace") return Framing::workspace;
  throw InputError("framing is '{}'; expected box or workspace", name);
}

void draw(const float* pen_xy, Eigen::Index points, double pen_width_px, Framing framing,
          double workspace_half_side_m, float* image) {
  HBR_CHECK(points >= 1 && pen_width_px > 0 && pen_width_px < kBoxPixels, "points = {}, width = {}", points,
            pen_width_px);
  const Path path{pen_xy, points};
  View view;
  if (framing == Framing::box) {
    view = box_view(path, pen_width_px);
  } else {
    HBR_CHECK(workspace_half_side_m > 0, "half side = {}", workspace_half_side_m);
    bounding_box(path);  // for its check
    view = {kImageSide / (2 * workspace_half_side_m), 0, 0, kImageSide / 2.0, kImageSide / 2.0};
  }
  Ink(path, view, pen_width_px).pixels(image);
}

void image_to_bytes(const float* image, std::uint8_t* bytes) {
  for (int i = 0; i < kImagePixels; ++i)
    bytes[i] = static_cast<std::uint8_t>(std::lround(std::clamp(image[i], 0.0f, 1.0f) * 255.0f));
}

}  // namespace hbr::inline drawing
