// The report's figures. Each says in `absent` what is missing where a profile did not
// make it.
#pragma once

#include <vector>

#include "reports/figures/artifacts.h"
#include "reports/figures/statistics_view.h"
#include "reports/plot/figure.h"

namespace hbr::inline reports {

// What figures are drawn from: pictures from the artifacts, numbers from the statistics alone, so that
// figure, table and text agree.
struct Evidence {
  Artifacts artifacts;
  StatisticsView statistics;
};

Figure points_figure(const Evidence& evidence);         // layer 1: size and mean fitness
Figure surest_digits_figure(const Evidence& evidence);  // the arm drawing
Figure autoencoder_figure(const Evidence& evidence);    // Fig. notation, bottom: learning, latent space
Figure digits_figure(const Evidence& evidence);         // Fig. main_res
Figure continuum_figure(const Evidence& evidence);      // the digits along a walk through the latent space
Figure judge_figure(const Evidence& evidence);          // what the classifier says of the digits
Figure turns_figure(const Evidence& evidence);          // how sharply strokes turn, good digits and others
Figure confusion_figure(const Evidence& evidence);      // rare classes beside those that the network confuses
Figure fooling_figure(const Evidence& evidence);        // the network's error against the judge's confidence
Figure substitution_figure(const Evidence& evidence);   // Fig. transfer a
Figure lines_figure(const Evidence& evidence);          // Fig. res_line a
Figure arcs_figure(const Evidence& evidence);           // Fig. res_line b
Figure arc_quality_figure(const Evidence& evidence);    // arcs re-executed from fresh starts

// Beyond the paper.
Figure searches_figure(const Evidence& evidence);  // layer 1 by other containers and selectors
Figure numbers_figure(const Evidence& evidence);   // layer 5
Figure layers_figure(const Evidence& evidence);    // the profile's own layers

// All of these.
std::vector<Figure> all_figures(const Evidence& evidence);

// Of one robot beside the arm, by its name in the profile, which begins their ids: "nao_posture".
Figure posture_figure(const Evidence& evidence, const std::string& robot);   // drawing
Figure transfer_figure(const Evidence& evidence, const std::string& robot);  // Fig. transfer b
Figure coverage_figure(const Evidence& evidence, const std::string& robot);  // the arm's points in its reach
Figure dynamics_figure(const Evidence& evidence, const std::string& robot);  // digits replayed by servos
Figure tuned_figure(const Evidence& evidence, const std::string& robot);     // layers evolved on over it

// An inline SVG: for each class that the judge finds among HBR's digits the `rows` best ones; "" without
// them.
std::string best_digits_picture(const Artifacts& artifacts, int rows);

}  // namespace hbr::inline reports
