// Torso, neck and head.
#include "models/nao/nao_paint.h"
#include "models/nao/nao_shells.h"

namespace hbr::inline nao {

using namespace nao;

std::vector<Mesh> nao_torso() {
  const Eigen::Vector3d ahead(1, 0, 0);
  return {
      // chest, narrow at the waist
      white(loft({{-.052, {.040, .046}, 3.0, {-.004, 0}},
                  {-.015, {.046, .055}, 3.2, {-.002, 0}},
                  {.035, {.053, .067}, 3.4, {.000, 0}},
                  {.080, {.052, .071}, 3.4, {-.002, 0}},
                  {.104, {.044, .062}, 3.0, {-.004, 0}}},
                 {.012, .30}, {.018, .55})),
      joint(loft({{-.085, {.030, .040}, 3}, {-.055, {.034, .040}, 3}}, {.010, .4}, {.005, .3})),
      // battery
      white(at(-.047, 0, .035, rounded_box({.034, .094, .110}, .014))),
      accent(at(-.061, 0, .035, rounded_box({.014, .066, .078}, .006))),
      // collar, button, sonars
      accent(at(-.004, 0, .1185, torus(.031, .0065))),
      accent(at(.0525, 0, .050, facing(ahead, torus(.0145, .0032)))),
      white(at(.0520, 0, .050, facing(ahead, cylinder(.0125, .008, .003)))),
      dark(at(.0515, .036, .078, facing({1, .18, 0}, cylinder(.0095, .006, .002)))),
      dark(at(.0515, -.036, .078, facing({1, -.18, 0}, cylinder(.0095, .006, .002)))),
      dark(at(.0460, .030, .018, facing({1, .18, 0}, cylinder(.0075, .010, .002)))),
      dark(at(.0460, -.030, .018, facing({1, -.18, 0}, cylinder(.0075, .010, .002)))),
  };
}

std::vector<Mesh> nao_neck() { return {joint(at(0, 0, -.016, cylinder(.022, .056, .006)))}; }

std::vector<Mesh> nao_head() {
  const Eigen::Vector3d side(0, 1, 0);
  std::vector<Mesh> meshes = {
      // helmet and face
      white(loft({{.022, {.046, .050}, 2.4, {.000, 0}},
                  {.045, {.055, .058}, 2.5, {.001, 0}},
                  {.070, {.056, .059}, 2.5, {.000, 0}},
                  {.088, {.050, .054}, 2.4, {-.003, 0}}},
                 {.020, 1}, {.026, 1})),
      white(at(.021, 0, .050, ellipsoid({.043, .049, .040}, 2.3))),
      // crest with its three touch sensors
      accent(at(-.007, 0, .062, ellipsoid({.0575, .017, .0545}, 2.2))),
      // mouth and the cameras beside it
      dark(at(.0605, 0, .0285, facing(side, capsule(.0036, .016)))),
      dark(at(.0480, 0, .0880, facing({1, 0, .5}, cylinder(.0046, .010, .002)))),
  };
  for (const double left : {1., -1.}) {
    const Eigen::Vector3d looks(1, .36 * left, .04);
    const auto eye = [&](double forward, Mesh mesh) {
      return at(.0570 + forward, left * (.0215 + .36 * forward), .0595, facing(looks, std::move(mesh)));
    };
    meshes.push_back(dark(eye(-.0015, cylinder(.0155, .010, .003))));
    meshes.push_back(coloured(eye(.0035, torus(.0122, .0024)), kEye));
    meshes.push_back(white(eye(-.0005, ellipsoid({.0100, .0100, .0048}))));
    meshes.push_back(dark(eye(.0024, ellipsoid({.0056, .0056, .0034}))));
    // ears
    meshes.push_back(accent(at(-.002, left * .0585, .060, facing(side, cylinder(.0265, .014, .004)))));
    meshes.push_back(white(at(-.002, left * .0648, .060, facing(side, torus(.0175, .0030)))));
    meshes.push_back(white(at(-.002, left * .0640, .060, facing(side, cylinder(.0085, .008, .003)))));
  }
  return meshes;
}

}  // namespace hbr::inline nao
