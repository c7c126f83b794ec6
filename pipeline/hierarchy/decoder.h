// What a genome asks of the layer below, command by command.
#pragma once

#include <Eigen/Core>
#include <optional>

namespace hbr::inline hierarchy {

// The pen is put down there before the first command.
struct PenPlacement {
  Eigen::Vector2d place = Eigen::Vector2d::Zero();  // m
  float width = 0;                                  // of the pen, a gene in [0, 1]
};

class Decoder {
 public:
  virtual ~Decoder() = default;
  virtual int command_size() const = 0;  // dimensions of each command
  virtual int max_commands() const = 0;  // of the longest genome
  // Whether a command is a displacement of the pen from where it is [m], which layer 1 carries out, instead
  // of a point of the descriptor space of the layer below.
  virtual bool relative() const { return false; }
  // Writes the commands of a genome [count x command_size] and returns how many they are: as many as there
  // may be at most, unless genomes have different lengths; 0 where the genome asks for what can't be.
  // Thread-safe.
  virtual int decode(const float* genome, int length, double* commands) const = 0;
  // Whether what a genome asks for begins with the pen's being put down somewhere, or goes on from wherever
  // it is.
  virtual bool places() const { return false; }
  // Where, if it is the genome that says so and not what it commands.
  virtual std::optional<PenPlacement> placement(const float* /*genome*/) const { return std::nullopt; }
  // Whether commands are displaced on the paper as a whole, and how far command k is [m]: it moves the places
  // at which the layers below put the pen down.
  virtual bool displaces() const { return false; }
  virtual Eigen::Vector2d displacement(const float* /*genome*/, int /*k*/) const {
    return Eigen::Vector2d::Zero();
  }
};

}  // namespace hbr::inline hierarchy
