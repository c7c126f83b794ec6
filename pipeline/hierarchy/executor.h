// Executes genomes of a layer through the layer below.
#pragma once

#include "pipeline/core/random.h"
#include "pipeline/hierarchy/executions.h"
#include "pipeline/hierarchy/plans.h"

namespace hbr::inline hierarchy {

// Where executions begin that go on from wherever the pen is: at elites of layer 1 drawn uniformly, or at
// those nearest to where joint angles drawn uniformly bring the pen. They are drawn anew for every genome, or
// are the same for all (`common`).
struct Starts {
  const Robot* moved = nullptr;  // by drawn joint angles; none: elites are drawn
  bool common = false;
};

class Executor {
 public:
  // Every genome is executed `repeats` times, from as many starts; or from where the genome puts the pen
  // down, where it does. All have to outlive it.
  Executor(const PointLayer& points, const Layer& below, const Decoder& decoder, int repeats, Way way,
           Starts starts = {});

  // The same with as many executions of each genome, from starts that are drawn anew for it even where those
  // of the search are common: what the search selected on would flatter what it kept.
  Executor fresh(int repeats) const;

  int repeats() const { return repeats_; }
  const Way& way() const { return way_; }
  // Whether a genome does the same whatever the seed.
  bool repeatable() const { return decoder_.places() || starts_.common; }
  const PointLayer& points() const { return points_; }
  const Decoder& decoder() const { return decoder_; }
  // Executes rows [begin, end) of some genomes, lengths[row] genes long (nullptr: all), the executions of one
  // genome one after the other. Row i draws its starts from seed.child(i), unless they are common. possible[i
  // - begin] tells whether the genome asks for what can be; where it does not, nothing is executed.
  // Thread-safe.
  void execute(const Rows& genomes, const std::int32_t* lengths, Eigen::Index begin, Eigen::Index end,
               Seed seed, Executions& executions, std::uint8_t* possible) const;

 private:
  void start(Eigen::Index begin, int genomes, Seed seed, Executions& executions) const;
  void draw_starts(Seed seed, std::int32_t* elites) const;

  const PointLayer& points_;
  const Layer& below_;
  const Decoder& decoder_;
  int repeats_;
  Way way_;
  Starts starts_;
};

}  // namespace hbr::inline hierarchy
