// What the names of artifacts and of statistics mean.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

namespace hbr::inline statistics {

// "layer2_n10/03.h5" is {layer2, n10, 3}, "nao_transfer/00.h5" {transfer, nao, 0}, "judge.h5" {judge, "",
// -1}. A robot's layer 1 is a variant of layer 1. A layer that a profile calls otherwise, as "spirals/01.h5",
// is {layers, spirals, 1}.
struct ArtifactName {
  std::string head;     // one of the names in FORMAT.md, without variant or robot
  std::string variant;  // may be empty
  int replication = -1;

  std::string prefix() const { return variant.empty() ? head : head + "." + variant; }
};

// `layers` are the profile's. Throws InputError where the name is none of them and has none of the forms of
// FORMAT.md.
ArtifactName parse_artifact_name(const std::string& name, const std::set<std::string>& layers = {});

// Whether a profile may call a layer so: not where its artifacts would be taken for those of another stage,
// or make would do something else.
bool can_be_a_layers_name(const std::string& name);

// What make can be asked for besides stages and variations: `targets` in the Makefile.
const std::set<std::string>& goals_of_make();

// Searches whose course is kept: layers, reference and flat baselines.
bool is_search(const std::string& head);

// Unit and meaning, in words for tables and axes.
struct Meaning {
  std::string unit;  // "" for a pure number, shares in [0, 1] included; "%" for what is already in per cent
  std::string text;
};

// Nothing where no statistic can have that name: the vocabulary that claims are checked against.
//   layer2.n10.size    accuracy.reference_endpoint    transfer.nao.absolute    judge.test_accuracy
std::optional<Meaning> meaning_of(const std::string& name);

}  // namespace hbr::inline statistics
