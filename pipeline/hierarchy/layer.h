// A finished level of a hierarchy: it obeys commands, each a point of its descriptor space, without the
// caller's knowing how (paper, section 3).
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>

namespace hbr::inline hierarchy {

class Executions;
// Some executions of a batch, by their indices in ascending order.
using Group = std::span<const std::int32_t>;

class Layer {
 public:
  virtual ~Layer() = default;
  // Elites that it has to choose from.
  virtual Eigen::Index size() const = 0;
  // Dimensions of a command, and between what its coordinates there are elites.
  virtual int command_size() const = 0;
  virtual float low() const { return 0; }
  virtual float high() const { return 1; }
  // Which elites answer to n commands, coordinate d of command i in commands[d][i]: those whose descriptors
  // are nearest. Thread-safe.
  virtual void nearest(int n, const float* const* commands, std::int32_t* elites) const = 0;
  // Has execution group[i] do what elites[i / repeat] stands for, from where it is: as many executions after
  // one another do the same. Thread-safe.
  virtual void perform(Executions& executions, Group group, const std::int32_t* elites,
                       int repeat = 1) const = 0;
};

}  // namespace hbr::inline hierarchy
