// A profile: every number of an experiment. profiles/paper.toml has all keys; the others say what they
// change.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "models/autoencoder/trainer.h"
#include "models/simbody/robot_settings.h"
#include "stages/data_settings.h"
#include "stages/descriptor_settings.h"
#include "stages/robot_tasks.h"
#include "stages/settings.h"

namespace hbr {

struct Replications {
  int lines = 0;
  int digits = 0;
};
template <class Fields>
void describe(Fields& f, Replications& s) {
  f.number("lines", s.lines, Range{1, 999}, "of all that concerns layers 1 to 3");
  f.number("digits", s.digits, Range{0, 999},
           "of the digits and their transfer; at most as many as of the lines");
}

struct SharedSearch : SearchTable {};
template <class Fields>
void describe(Fields& f, SharedSearch& s) {
  describe_search(f, s);
}

struct LayerTable : SearchTable {  // one repertoire
};
template <class Fields>
void describe(Fields& f, LayerTable& s) {
  describe_generations(f, s);
  describe_archive(f, s);
}

struct GenerationsTable : SearchTable {};  // a baseline: spacing and epsilon of the layer it is compared with
template <class Fields>
void describe(Fields& f, GenerationsTable& s) {
  describe_generations(f, s);
}

struct LineVariant {
  std::string name;
  int samples = 0;
  SearchTable search;
};
template <class Fields>
void describe(Fields& f, LineVariant& s) {
  f.text("name", s.name, "the stage is layer2_NAME");
  f.number("samples", s.samples, Range{1, 1e5}, "N: starts of the stochastic descriptor");
  describe_generations(f, s.search);
}

struct Layer2Table {
  SearchTable archive;
  std::vector<LineVariant> variants;
};
template <class Fields>
void describe(Fields& f, Layer2Table& s) {
  describe_archive(f, s.archive);
  f.tables("variants", s.variants, "what is compared");
}

struct ArcVariant : ArcVariantTable {
  SearchTable search;
};
template <class Fields>
void describe(Fields& f, ArcVariant& s) {
  describe(f, static_cast<ArcVariantTable&>(s));
  describe_generations(f, s.search);
}

struct Layer3Table {
  SearchTable archive;
  std::string lines;
  ArcReadingTable reading;
  std::vector<ArcVariant> variants;
};
template <class Fields>
void describe(Fields& f, Layer3Table& s) {
  describe_archive(f, s.archive);
  f.text("lines", s.lines, "the layer-2 variant below");
  describe(f, s.reading);
  f.tables("variants", s.variants, "what is compared");
}

struct FlatArcsTable : SearchTable {
  std::string start;
};
template <class Fields>
void describe(Fields& f, FlatArcsTable& s) {
  describe_generations(f, s);
  describe_flat_start(f, s.start);
}

struct Layer4Table {
  SearchTable search;
  std::string arcs;
  double line_spacing = 0;
  std::string out_of_range;
  double length_rate = 0;
  PencilTable pencil;
};
template <class Fields>
void describe(Fields& f, Layer4Table& s) {
  describe_generations(f, s.search);
  describe_archive(f, s.search);
  f.text("arcs", s.arcs, "the layer-3 variant below");
  f.number("line_spacing", s.line_spacing, Range{0, 10},
           "distance between the points of a line at which layer 1 is asked, m; 0: at its end alone");
  describe_out_of_range(f, s.out_of_range);
  f.number("length_rate", s.length_rate, Range{0, 1},
           "probability that a block of genes is added or removed");
  f.table("pencil", s.pencil, "from trace to image");
}

struct FlatDigitsTable : SearchTable {
  std::string pen;
  std::string start;
};
template <class Fields>
void describe(Fields& f, FlatDigitsTable& s) {
  describe_generations(f, s);
  describe_flat_pen(f, s.pen, s.start);
}

struct ExperimentsTable {
  int accuracy_requests = 0;
  int fresh_starts = 0;
  std::string substitution_variant;
};
template <class Fields>
void describe(Fields& f, ExperimentsTable& s) {
  f.number("accuracy_requests", s.accuracy_requests, Range{1, 1e7}, "lines asked of every layer-2 variant");
  f.number("fresh_starts", s.fresh_starts, Range{1, 1e5},
           "starts from which every stored arc is executed again");
  f.text("substitution_variant", s.substitution_variant,
         "layer-3 variant that is executed over both layers 1");
}

struct SearchVariant {
  std::string name;
  SearchTable search;
};
template <class Fields>
void describe(Fields& f, SearchVariant& s) {
  f.text("name", s.name, "the stage is layer1_search_NAME");
  describe_algorithm(f, s.search);
}

struct SearchesTable {
  int replications = 0;
  SearchTable search;
  int passive_cells = 0;
  std::vector<SearchVariant> variants;
};
template <class Fields>
void describe(Fields& f, SearchesTable& s) {
  f.number("replications", s.replications, Range{0, 999}, "of every search");
  describe_generations(f, s.search);
  f.number("passive_cells", s.passive_cells, Range{1, 1e4},
           "cells a side of the grid on which the repertoires are compared");
  f.tables("variants", s.variants, "what is compared");
}

// The same experiment with some keys changed: what it does not touch is not run again.
struct ProfileVariation {
  std::string name;
  std::string changes;
  nlohmann::json set;
};
template <class Fields>
void describe(Fields& f, ProfileVariation& s) {
  f.text("name", s.name, "of the make goal and of the folder below OUT");
  f.text("changes", s.changes, "which reading it changes, a sentence for the report");
  f.raw_table("set", s.set, "the keys of the profile that it changes, in their tables");
}

struct RobotPictureTable {
  int height = 0;
};
template <class Fields>
void describe(Fields& f, RobotPictureTable& s) {
  f.number("height", s.height, Range{60, 6000},
           "of the posture's picture, pixels; the strip's is in proportion");
}

struct Profile {
  std::string name;
  std::uint64_t seed = 0;
  Replications replications;
  DatasetSettings dataset;
  DescriptorTable descriptor;
  AutoencoderSettings autoencoder;
  JudgeSettings judge;
  StrokesTable random_strokes;
  ArmTable arm;
  double half_side = 0;
  double longest_line = 0;
  std::string line_range;
  SharedSearch search;
  LayerTable layer1;
  SearchesTable searches;
  Layer2Table layer2;
  GenerationsTable reference4d;
  Layer3Table layer3;
  FlatArcsTable flat_arcs;
  Layer4Table layer4;
  FlatDigitsTable flat_digits;
  ExperimentsTable experiments;
  PlaneSearchSettings robot_plane;
  LayerTable robot_layer1;
  TransferTable transfer;
  RobotPictureTable robot_picture;
  DynamicsTable dynamics;
  TuningTable tuning;
  std::vector<RobotSettings> robots;
  std::vector<ProfileVariation> variations;
};
template <class Fields>
void describe(Fields& f, Profile& s) {
  f.text("name", s.name, "as the report calls the profile");
  f.number("seed", s.seed, Range{0, 9007199254740991.0}, "master seed");
  f.table("replications", s.replications, "how often everything is repeated");
  f.table("dataset", s.dataset, "images that the digits shall resemble");
  f.table("descriptor", s.descriptor, "what places the digits and judges them in the search");
  f.table("autoencoder", s.autoencoder, "the network and its training");
  f.table("judge", s.judge, "the classifier that the search never sees");
  f.table("random_strokes", s.random_strokes, "its control");
  f.table("arm", s.arm, "the planar arm");
  f.number("half_side", s.half_side, Range{1e-3, 100}, "L: half the side of the drawing area, m");
  describe_line_range(f, s.longest_line, s.line_range);
  f.table("search", s.search, "what all searches share");
  f.table("layer1", s.layer1, "points, and their substitute");
  f.table("searches", s.searches, "points by other searches");
  f.table("layer2", s.layer2, "lines");
  f.table("reference4d", s.reference4d, "lines with a four-dimensional descriptor");
  f.table("layer3", s.layer3, "arcs");
  f.table("flat_arcs", s.flat_arcs, "arcs without a hierarchy");
  f.table("layer4", s.layer4, "digits");
  f.table("flat_digits", s.flat_digits, "digits without a hierarchy");
  f.table("experiments", s.experiments, "what is done with finished layers");
  f.table("robot_plane", s.robot_plane, "where the robots below draw");
  f.table("robot_layer1", s.robot_layer1, "points of the robots below");
  f.table("transfer", s.transfer, "to the robots below");
  f.table("robot_picture", s.robot_picture, "pictures of the robots below");
  f.table("dynamics", s.dynamics, "of the robots below");
  f.table("tuning", s.tuning, "of the arm's layers to the robots below");
  f.tables("robots", s.robots, "robots that the hierarchy is transferred to");
  f.tables("variations", s.variations, "other readings, run beside this one");
}

}  // namespace hbr
