// The state of a training between two epochs, and its file.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "models/autoencoder/adam.h"
#include "models/autoencoder/network.h"
#include "models/autoencoder/trainer.h"

namespace hbr::net {

struct TrainingState {
  TrainingState(const AutoencoderSettings& settings, Seed seed, std::vector<std::int64_t> all);

  Network network;
  Adam adam;
  std::vector<std::int64_t> samples;  // the training set: indices, ascending
  std::vector<EpochReport> epochs;    // done so far
  std::array<double, 10> kept_per_class;
};

// `identity` says what is trained on what, so that no other training goes on from this file. Replaces the
// file at once.
void write_checkpoint(const std::filesystem::path& path, const std::string& identity,
                      const TrainingState& state);

// Throws InputError where the file is damaged or belongs to another training; `state` is then as before.
void read_checkpoint(const std::filesystem::path& path, const std::string& identity, TrainingState& state);

}  // namespace hbr::net
