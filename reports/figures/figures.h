// The report's figures, in the paper's order. Each says in `absent` what is missing where a profile did not
// make it.
#pragma once

#include <vector>

#include "reports/figures/artifacts.h"
#include "reports/figures/statistics_view.h"
#include "reports/plot/figure.h"

namespace hbr {

// What figures are drawn from: pictures from the artifacts, numbers from the statistics alone, so that
// figure, table and text agree.
struct Evidence {
  Artifacts artifacts;
  StatisticsView statistics;
};

Figure points_figure(const Evidence& evidence);         // layer 1: size and mean fitness
Figure searches_figure(const Evidence& evidence);       // layer 1 by other containers and selectors
Figure autoencoder_figure(const Evidence& evidence);    // Fig. notation, bottom: learning, latent space
Figure digits_figure(const Evidence& evidence);         // Fig. main_res
Figure continuum_figure(const Evidence& evidence);      // the digits along a walk through the latent space
Figure surest_digits_figure(const Evidence& evidence);  // the arm drawing
Figure judge_figure(const Evidence& evidence);          // what the classifier says of the digits
Figure fooling_figure(const Evidence& evidence);        // the network's error against the judge's confidence
Figure substitution_figure(const Evidence& evidence);   // Fig. transfer a
Figure transfer_figure(const Evidence& evidence);       // Fig. transfer b
Figure coverage_figure(const Evidence& evidence);       // the arm's points in robots' reach
Figure posture_figure(const Evidence& evidence);        // each robot drawing
Figure dynamics_figure(const Evidence& evidence);       // digits replayed by servos
Figure tuned_figure(const Evidence& evidence);          // digits evolved on over the robot
Figure lines_figure(const Evidence& evidence);          // Fig. res_line a
Figure arcs_figure(const Evidence& evidence);           // Fig. res_line b
Figure arc_quality_figure(const Evidence& evidence);    // arcs re-executed from fresh starts

Figure numbers_figure(const Evidence& evidence);  // beyond the paper: layer 5
Figure layers_figure(const Evidence& evidence);   // the profile's own layers

// All of them, in this order.
std::vector<Figure> all_figures(const Evidence& evidence);

// An inline SVG: for each class that the judge finds among HBR's digits the `rows` best ones; "" without
// them.
std::string hero_picture(const Artifacts& artifacts, int rows);

}  // namespace hbr
