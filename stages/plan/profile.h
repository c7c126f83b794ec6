// A profile: every number of an experiment. profiles/paper.toml has all keys; the others say what they
// change.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "models/autoencoder/trainer.h"
#include "models/robot/plane/robot_settings.h"
#include "pipeline/artifact/run_settings.h"
#include "stages/layers/body.h"
#include "stages/layers/search_settings.h"
#include "stages/learned/data_settings.h"
#include "stages/learned/descriptor_settings.h"
#include "stages/robots/robot_tasks.h"

namespace hbr::inline stages {

struct Replications {
  int lines = 0;
  int digits = 0;
};
template <class Fields>
void describe(Fields& f, Replications& s) {
  f.number("lines", s.lines, Range{1, kMaxReplications}, "of all that concerns layers 1 to 3");
  f.number("digits", s.digits, Range{0, kMaxReplications},
           "of the digits and their transfer; at most as many as of the lines");
}

// What is done with finished layers, which are named here.
struct AccuracyTable {
  int requests = 0;
  std::vector<std::string> layers;
};
template <class Fields>
void describe(Fields& f, AccuracyTable& s) {
  f.number("requests", s.requests, Range{1, 1e7}, "lines asked of every layer");
  f.texts("layers", s.layers, "layers of lines that are compared, all built on the same one");
}

struct ArcQualityTable {
  int fresh_starts = 0;
  std::vector<std::string> layers;
};
template <class Fields>
void describe(Fields& f, ArcQualityTable& s) {
  f.number("fresh_starts", s.fresh_starts, Range{1, 1e5},
           "starts from which every stored arc is executed again");
  f.texts("layers", s.layers, "layers of arcs, all built on the same one");
}

struct SubstitutionTable {
  std::string layer;
  std::string substitute;
};
template <class Fields>
void describe(Fields& f, SubstitutionTable& s) {
  f.text("layer", s.layer, "of arcs, executed over its own layer 1 and the substitute");
  f.text("substitute", s.substitute, "the layer of points that takes the place of its own");
}

struct DigitsTable {
  std::string hierarchy;
  std::string flat;
};
template <class Fields>
void describe(Fields& f, DigitsTable& s) {
  f.text("hierarchy", s.hierarchy, "the layer of digits that is judged, drawn by the arm and transferred");
  f.text("flat", s.flat, "the one that it is held against");
}

struct NumbersTable {
  std::string layer;
};
template <class Fields>
void describe(Fields& f, NumbersTable& s) {
  f.text("layer", s.layer, "the layer of numbers that is read, by the arm and by the robots; empty: none");
}

struct ExplorerTable {
  int replications = 0;
  int executions = 0;
};
template <class Fields>
void describe(Fields& f, ExplorerTable& s) {
  f.number(
      "replications", s.replications, Range{0, kMaxReplications},
      "of the digits that the report's explorer shows, the first ones; each makes the page larger by 0.5 "
      "to 2 MB");
  f.number("executions", s.executions, Range{1, 100}, "of each line and arc there, from random starts");
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
  std::string layer;
  SearchTable search;
  int passive_cells = 0;
  std::vector<SearchVariant> variants;
};
template <class Fields>
void describe(Fields& f, SearchesTable& s) {
  f.number("replications", s.replications, Range{0, kMaxReplications}, "of every search");
  f.text("layer", s.layer, "of points, which is evolved by other searches");
  describe_generations(f, s.search);
  f.number("passive_cells", s.passive_cells, Range{1, 1e4},
           "cells a side of the grid on which the repertoires are compared");
  f.tables("variants", s.variants, "what is compared");
}

struct RobotPointsTable : SearchTable {};
template <class Fields>
void describe(Fields& f, RobotPointsTable& s) {
  describe_generations(f, s);
  describe_archive(f, s);
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

// Readings of what the paper leaves open, taken together.
struct OptionValue {
  std::string name;
  nlohmann::json set;
};
template <class Fields>
void describe(Fields& f, OptionValue& s) {
  f.text("name", s.name, "as the report calls it");
  f.raw_table("set", s.set, "the keys of the profile that it changes, in their tables; of the first none");
}
struct StudiedOption {
  std::string id;
  std::vector<OptionValue> values;
};
template <class Fields>
void describe(Fields& f, StudiedOption& s) {
  f.text("id", s.id, "of a reading in reports/readings.toml");
  f.tables("values", s.values, "the first is the profile's own");
}
struct ReadingsTable {
  int combinations = 0;
  std::vector<StudiedOption> options;
};
template <class Fields>
void describe(Fields& f, ReadingsTable& s) {
  f.number("combinations", s.combinations, Range{0, 1e4},
           "of the readings' values that are run: a balanced choice of all; 0: all");
  f.tables("options", s.options, "readings that are combined");
}

struct RobotPictureTable {
  int height = 0;
};
template <class Fields>
void describe(Fields& f, RobotPictureTable& s) {
  f.number("height", s.height, Range{60, 6000},
           "of the posture's picture, pixels; the strip's is in proportion");
}

// A robot, and what only its dynamics ask for.
struct RobotRow : RobotSettings {
  std::vector<GearSettings> gears;
};
template <class Fields>
void describe(Fields& f, RobotRow& s) {
  describe(f, static_cast<RobotSettings&>(s));
  f.optional_tables("gears", s.gears, "friction and play of joints that draw; none where a joint has none");
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
  nlohmann::json defaults, layers;  // see layer_rows.h
  std::vector<std::string> leave_out;
  SearchesTable searches;
  AccuracyTable accuracy;
  ArcQualityTable arc_quality;
  SubstitutionTable substitution;
  DigitsTable digits;
  NumbersTable numbers;
  ExplorerTable explorer;
  PlaneSearchSettings robot_plane;
  RobotPointsTable robot_layer1;
  TransferTable transfer;
  RobotPictureTable robot_picture;
  RobotShapeTable robot_shape;
  DynamicsTable dynamics;
  TuningTable tuning;
  std::vector<RobotRow> robots;
  std::vector<ProfileVariation> variations;
  ReadingsTable readings;
};
template <class Fields>
void describe(Fields& f, Profile& s) {
  f.text("name", s.name, "as the report calls the profile");
  describe_seed(f, s.seed);
  f.table("replications", s.replications, "how often everything is repeated");
  f.table("dataset", s.dataset, "images that the digits shall resemble");
  f.table("descriptor", s.descriptor, "what places the digits and judges them in the search");
  f.table("autoencoder", s.autoencoder, "the network and its training");
  f.table("judge", s.judge, "the classifier that the search never sees");
  f.table("random_strokes", s.random_strokes, "its control");
  f.table("arm", s.arm, "the planar arm");
  f.raw_table("defaults", s.defaults, "what layers have in common");
  f.raw_table("layers", s.layers, "the layers");
  f.texts("leave_out", s.leave_out, "layers that are not evolved");
  f.table("searches", s.searches, "points by other searches");
  f.table("accuracy", s.accuracy, "of the lines");
  f.table("arc_quality", s.arc_quality, "of the stored arcs");
  f.table("substitution", s.substitution, "of layer 1");
  f.table("digits", s.digits, "which digits are looked at");
  f.table("numbers", s.numbers, "which numbers are looked at");
  f.table("explorer", s.explorer, "what the report lets its readers explore");
  f.table("robot_plane", s.robot_plane, "where the robots below draw");
  f.table("robot_layer1", s.robot_layer1, "points of the robots below");
  f.table("transfer", s.transfer, "to the robots below");
  f.table("robot_picture", s.robot_picture, "pictures of the robots below");
  f.table("robot_shape", s.robot_shape, "of the arm and the robots below in three dimensions");
  f.table("dynamics", s.dynamics, "of the robots below");
  f.table("tuning", s.tuning, "of the arm's layers to the robots below");
  f.tables("robots", s.robots, "robots that the hierarchy is transferred to");
  f.tables("variations", s.variations, "other readings, run beside this one");
  f.table("readings", s.readings, "other readings, taken together");
}

}  // namespace hbr::inline stages
