// What the stages of the hierarchy are told: the tables of a profile and the slices cut from it. A slice
// holds only what its stage depends on.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "pipeline/artifact/settings.h"
#include "pipeline/qd/containers.h"
#include "pipeline/qd/named.h"
#include "pipeline/qd/neighbour_grid.h"
#include "pipeline/qd/selectors.h"

namespace hbr {

struct ArmTable {
  std::vector<double> links;
  double joint_limit = 0;
};
template <class Fields>
void describe(Fields& f, ArmTable& s) {
  f.numbers("links", s.links, Range{1e-3, 10}, "lengths of the links, base first, m");
  f.number("joint_limit", s.joint_limit, Range{1e-3, 3.2}, "every joint turns in [-limit, limit], rad");
}

struct SearchTable {
  std::int64_t generations = 0;
  int batch = 0;
  std::int64_t record_every = 0;
  std::string container;
  double spacing = 0;
  double epsilon = 0;
  int neighbours = 0;
  int grid_cells = 0;
  int cvt_cells = 0;
  std::string selector;
  std::string curiosity_credit;
  double mutation_rate = 0;
  double mutation_eta = 0;
};

// Which elites are kept and which are bred from.
template <class Fields>
void describe_algorithm(Fields& f, SearchTable& s) {
  f.choice("container", s.container, names_of(container_kinds()),
           ("which elites are kept: " + meanings_of(container_kinds())).c_str());
  f.choice("selector", s.selector, names_of(selector_kinds()),
           ("how parents are drawn: " + meanings_of(selector_kinds())).c_str());
}
// The part of a search that all layers share, [search] in a profile.
template <class Fields>
void describe_search(Fields& f, SearchTable& s) {
  f.number("batch", s.batch, Range{1, 1e6}, "children of a generation (pop_size)");
  f.number("record_every", s.record_every, Range{1, 1e9}, "generations between two rows of progress");
  describe_algorithm(f, s);
  f.number("neighbours", s.neighbours, Range{1, kMaxNeighbours},
           "k: neighbours that the novelty score averages");
  f.number("grid_cells", s.grid_cells, Range{1, 1e4}, "cells a side of the grid container");
  f.number("cvt_cells", s.cvt_cells, Range{1, 1e6}, "cells of the cvt container");
  f.choice("curiosity_credit", s.curiosity_credit, {"parent", "published"},
           "whom a child counts for: its own parent, or that of some sibling as in the published program");
  f.number("mutation_rate", s.mutation_rate, Range{0, 1}, "probability that a gene mutates");
  f.number("mutation_eta", s.mutation_eta, Range{0, 1000}, "eta_m of the polynomial mutation");
}
// The part of each layer.
template <class Fields>
void describe_archive(Fields& f, SearchTable& s) {
  f.number("spacing", s.spacing, Range{1e-4, 10},
           "l: distance beyond which a solution is novel, descriptor units");
  f.number("epsilon", s.epsilon, Range{0, 0.99}, "of the epsilon-dominance");
}
template <class Fields>
void describe_generations(Fields& f, SearchTable& s) {
  f.number("generations", s.generations, Range{1, 1e9}, "generations, the random one included");
}
template <class Fields>
void describe(Fields& f, SearchTable& s) {
  describe_search(f, s);
  describe_archive(f, s);
  describe_generations(f, s);
}

// What every slice begins with.
struct RunTable {
  std::uint64_t seed = 0;
  int replication = 0;
};
template <class Fields>
void describe_run(Fields& f, RunTable& s) {
  f.number("seed", s.seed, Range{0, 9007199254740991.0}, "master seed");
  f.number("replication", s.replication, Range{0, 999}, "replication");
}

// The arm, its drawing area and the longest line.
struct ArmSlice : RunTable {
  ArmTable arm;
  double half_side = 0;
};
template <class Fields>
void describe_arm(Fields& f, ArmSlice& s) {
  describe_run(f, s);
  f.table("arm", s.arm, "the planar arm");
  f.number("half_side", s.half_side, Range{1e-3, 100}, "L: half the side of the drawing area, m");
}
struct LinesSlice : ArmSlice {
  double longest_line = 0;
  std::string line_range;
};
template <class Fields>
void describe_line_range(Fields& f, double& longest_line, std::string& line_range) {
  f.number("longest_line", longest_line, Range{1e-3, 100}, "rho: longest displacement of a line, m");
  f.choice("line_range", line_range, {"disc", "square"}, "of radius rho, or of side 2 rho");
}
template <class Fields>
void describe_lines(Fields& f, LinesSlice& s) {
  describe_arm(f, s);
  describe_line_range(f, s.longest_line, s.line_range);
}

// What an arc's descriptor and fitness mean.
struct ArcReadingTable {
  std::string centre;
  std::string joint_term;
};
template <class Fields>
void describe(Fields& f, ArcReadingTable& s) {
  f.choice("centre", s.centre, {"circle", "centroid"}, "C: of the fitted circle, or the mean of the points");
  f.choice("joint_term", s.joint_term, {"mean", "pooled"},
           "J: mean of the way-points' joint variances, or the variance of all their joints together");
}
struct ArcsSlice : LinesSlice {
  ArcReadingTable reading;
};
template <class Fields>
void describe_arcs(Fields& f, ArcsSlice& s) {
  describe_lines(f, s);
  f.table("reading", s.reading, "of an arc's descriptor and fitness");
}

struct PointsEvolution : ArmSlice {
  std::string cost;
  SearchTable search;
};
template <class Fields>
void describe(Fields& f, PointsEvolution& s) {
  describe_arm(f, s);
  f.choice("cost", s.cost, {"joint_variance", "few_joints"}, "what layer 1 minimises");
  f.table("search", s.search, "the search");
}

struct LinesEvolution : LinesSlice {  // layer 2 and the 4D reference, which takes one sample
  int samples = 0;
  SearchTable search;
};
template <class Fields>
void describe(Fields& f, LinesEvolution& s) {
  describe_lines(f, s);
  f.number("samples", s.samples, Range{1, 1e5}, "N: starts of the stochastic descriptor");
  f.table("search", s.search, "the search");
}

struct ArcsEvolution : ArcsSlice {
  std::string controller;
  int samples = 0;
  SearchTable search;
};
template <class Fields>
void describe(Fields& f, ArcsEvolution& s) {
  describe_arcs(f, s);
  f.choice("controller", s.controller, {"lines", "turn"},
           "ten genes (five lines) or three (heading, length, turn)");
  f.number("samples", s.samples, Range{1, 1e5}, "N: starts of the stochastic descriptor");
  f.table("search", s.search, "the search");
}

struct FlatArcsEvolution : ArcsSlice {
  std::string start;
  SearchTable search;
};
template <class Fields>
void describe_flat_start(Fields& f, std::string& start) {
  f.choice("start", start, {"straight", "first", "random"},
           "of the arc: the straight arm, its own first configuration, or one drawn at random");
}
template <class Fields>
void describe(Fields& f, FlatArcsEvolution& s) {
  describe_arcs(f, s);
  describe_flat_start(f, s.start);
  f.table("search", s.search, "the search");
}

struct PencilTable {
  std::string framing;
  double thinnest_px = 0;
  double thickest_px = 0;
};
template <class Fields>
void describe(Fields& f, PencilTable& s) {
  f.choice("framing", s.framing, {"box", "workspace"}, "which part of the plane the image shows");
  f.number("thinnest_px", s.thinnest_px, Range{0.5, 14}, "pen width of gene 0, pixels");
  f.number("thickest_px", s.thickest_px, Range{0.5, 14}, "pen width of gene 1, pixels");
}

// How a digit's genome becomes an image over a hierarchy: also what transfer needs.
struct DigitsSlice : LinesSlice {
  std::string controller;
  double line_spacing = 0;
  std::string out_of_range;
  PencilTable pencil;
};
template <class Fields>
void describe_out_of_range(Fields& f, std::string& out_of_range) {
  f.choice(
      "out_of_range", out_of_range, {"radius", "axes", "reject"},
      "of a triplet whose centre is farther than L: brought back along its direction, its coordinates one "
      "by one, or no digit");
}
template <class Fields>
void describe_digits(Fields& f, DigitsSlice& s) {
  describe_lines(f, s);
  f.choice("controller", s.controller, {"lines", "turn"}, "of the layer-3 repertoire in use");
  f.number("line_spacing", s.line_spacing, Range{0, 10},
           "distance between the points of a line at which layer 1 is asked, m; 0: at its end alone");
  describe_out_of_range(f, s.out_of_range);
  f.table("pencil", s.pencil, "from trace to image");
}

struct DigitsEvolution : DigitsSlice {
  double length_rate = 0;
  SearchTable search;
};
template <class Fields>
void describe(Fields& f, DigitsEvolution& s) {
  describe_digits(f, s);
  f.number("length_rate", s.length_rate, Range{0, 1}, "probability that a triplet is added or removed");
  f.table("search", s.search, "the search");
}

struct FlatDigitsEvolution : ArmSlice {
  std::string pen;
  std::string start;
  PencilTable pencil;
  double length_rate = 0;
  SearchTable search;
};
template <class Fields>
void describe_flat_pen(Fields& f, std::string& pen, std::string& start) {
  f.choice("pen", pen, {"straight", "joints"},
           "between configurations: straight from tip to tip, or all joints turning evenly");
  f.choice("start", start, {"first", "straight_arm"},
           "of the pen: the first configuration, or the straight arm");
}
template <class Fields>
void describe(Fields& f, FlatDigitsEvolution& s) {
  describe_arm(f, s);
  describe_flat_pen(f, s.pen, s.start);
  f.table("pencil", s.pencil, "from trace to image");
  f.number("length_rate", s.length_rate, Range{0, 1}, "probability that a set is added or removed");
  f.table("search", s.search, "the search");
}

struct SearchesSlice {
  int passive_cells = 0;
  double worst_fitness = 0;
};
template <class Fields>
void describe(Fields& f, SearchesSlice& s) {
  f.number("passive_cells", s.passive_cells, Range{1, 1e4},
           "cells a side of the grid that all repertoires are projected onto");
  f.number("worst_fitness", s.worst_fitness, Range{-1e9, 0}, "a fitness that no elite falls short of");
}

struct AccuracySlice : LinesSlice {
  int requests = 0;
};
template <class Fields>
void describe(Fields& f, AccuracySlice& s) {
  describe_lines(f, s);
  f.number("requests", s.requests, Range{1, 1e7}, "lines asked for");
}

// One layer-3 repertoire executed anew.
struct ArcVariantTable {
  std::string name;
  std::string controller;
  int samples = 0;
};
template <class Fields>
void describe(Fields& f, ArcVariantTable& s) {
  f.text("name", s.name, "variant");
  f.choice("controller", s.controller, {"lines", "turn"},
           "ten genes (five lines) or three (heading, length, turn)");
  f.number("samples", s.samples, Range{1, 1e5}, "N: starts of the stochastic descriptor");
}
struct ArcQualitySlice : ArcsSlice {
  int fresh_starts = 0;
  std::vector<ArcVariantTable> variants;
};
template <class Fields>
void describe(Fields& f, ArcQualitySlice& s) {
  describe_arcs(f, s);
  f.number("fresh_starts", s.fresh_starts, Range{1, 1e5},
           "starts from which every stored arc is executed again");
  f.tables("variants", s.variants, "the layer-3 repertoires");
}

struct SubstitutionSlice : ArcsSlice {
  ArcVariantTable variant;
};
template <class Fields>
void describe(Fields& f, SubstitutionSlice& s) {
  describe_arcs(f, s);
  f.table("variant", s.variant, "the layer-3 repertoire that is executed over both layers");
}

}  // namespace hbr
