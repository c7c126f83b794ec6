// The left leg, hanging down: .1 m to the knee, .1029 m to the ankle, .04511 m to the sole.
#include "models/nao/nao_paint.h"
#include "models/nao/nao_shells.h"

namespace hbr::inline nao {

using namespace nao;

std::vector<Mesh> nao_pelvis() { return {joint(at(-.004, -.010, .012, ellipsoid({.030, .030, .030}, 2.6)))}; }

std::vector<Mesh> nao_hip() { return {joint(at(-.008, 0, -.002, rounded_box({.050, .046, .044}, .014)))}; }

std::vector<Mesh> nao_thigh() {
  return {
      white(loft({{-.088, {.028, .027}, 2.8, {.003, .002}},
                  {-.060, {.033, .031}, 3.0, {.003, .002}},
                  {-.022, {.037, .035}, 3.0, {.002, .002}},
                  {.002, {.034, .032}, 2.8, {.000, .002}}},
                 {.012, .5}, {.022, .7})),
      accent(at(.003, .026, -.040, ellipsoid({.026, .014, .043}, 2.8))),
  };
}

std::vector<Mesh> nao_shin() {
  return {
      joint(along_y(cylinder(.026, .050, .007))),
      white(loft({{-.096, {.027, .029}, 2.8, {.000, .001}},
                  {-.068, {.032, .033}, 2.8, {-.002, .001}},
                  {-.034, {.035, .034}, 2.8, {-.002, .001}},
                  {-.010, {.029, .030}, 2.6, {.002, .001}}},
                 {.008, .3}, {.022, .9})),
      accent(at(.019, .001, -.048, ellipsoid({.017, .023, .036}, 2.8))),
  };
}

std::vector<Mesh> nao_ankle() { return {joint(at(-.002, 0, -.004, rounded_box({.044, .044, .042}, .014)))}; }

std::vector<Mesh> nao_foot() {
  return {
      dark(loft({{-.0435, {.079, .045}, 3, {.024, .005}}, {-.0385, {.080, .046}, 3, {.024, .005}}},
                {.0016, .03}, {.0016, .03})),
      white(loft({{-.038, {.077, .043}, 3.0, {.024, .005}},
                  {-.024, {.070, .041}, 2.8, {.021, .004}},
                  {-.010, {.052, .036}, 2.6, {.010, .003}},
                  {.006, {.036, .031}, 2.4, {-.002, .001}}},
                 {.001, .02}, {.008, .35})),
      accent(at(.067, .006, -.0285, ellipsoid({.036, .036, .0135}, 2.8))),
  };
}

}  // namespace hbr::inline nao
