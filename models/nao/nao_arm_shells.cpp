// The left arm, stretched forward along x: .105 m to the elbow, .05595 m to the wrist, .05775 m to the hand.
#include "models/nao/nao_paint.h"
#include "models/nao/nao_shells.h"

namespace hbr::inline nao {

using namespace nao;

std::vector<Mesh> nao_shoulder() {
  return {joint(at(0, -.016, 0, along_y(cylinder(.024, .046, .006)))), joint(ellipsoid({.027, .024, .027}))};
}

std::vector<Mesh> nao_upper_arm() {
  return {
      // shoulder pad
      accent(at(.002, .006, .004, ellipsoid({.037, .029, .036}, 2.4))),
      white(along_x(loft({{.016, {.023, .026}, 2.6, {.004, .000}},
                          {.045, {.023, .025}, 2.8, {.009, .000}},
                          {.078, {.020, .021}, 2.6, {.014, .000}}},
                         {.012, .4}, {.010, .5}))),
  };
}

std::vector<Mesh> nao_elbow() {
  return {joint(at(-.014, 0, 0, along_x(cylinder(.0170, .034, .005)))), joint(ellipsoid({.021, .020, .021}))};
}

std::vector<Mesh> nao_forearm() {
  return {
      white(along_x(loft({{.000, {.021, .021}, 2.4},
                          {.018, {.024, .025}, 2.6, {.001, 0}},
                          {.040, {.024, .025}, 2.6, {.001, 0}}},
                         {.018, .9}, {.008, .25}))),
      accent(at(.024, .012, .000, ellipsoid({.022, .0165, .021}, 2.6))),
  };
}

std::vector<Mesh> nao_hand() {
  return {
      joint(at(-.002, 0, 0, along_x(cylinder(.0175, .024, .004)))),
      accent(at(.010, 0, 0, along_x(torus(.0168, .0042)))),
      white(along_x(loft({{.014, {.018, .016}, 2.8},
                          {.026, {.022, .015}, 3.0, {.000, .001}},
                          {.037, {.020, .012}, 3.0, {.000, .001}}},
                         {.006, .5}, {.007, .7}))),
  };
}

// In the gripper's frame, whose origin is the point that the hand brings somewhere: it lies between the tips.
std::vector<Mesh> nao_fingers() {
  std::vector<Mesh> meshes;
  for (const double y : {.0115, -.0115}) {
    meshes.push_back(joint(rod({-.018, y, .014}, {-.002, y, .012}, .0062)));
    meshes.push_back(joint(rod({-.002, y, .012}, {.004, y * .62, .0015}, .0054)));
  }
  meshes.push_back(joint(rod({-.030, 0, .004}, {-.016, 0, -.002}, .0064)));
  meshes.push_back(joint(rod({-.016, 0, -.002}, {-.006, 0, -.001}, .0054)));
  return meshes;
}

}  // namespace hbr::inline nao
