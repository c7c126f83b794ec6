// The accuracy of layers of lines and of the reference (paper, section 5.3).
#include "pipeline/artifact/run_settings.h"
#include "stages/layers/read_stack.h"
#include "stages/studies/line_accuracy.h"

namespace hbr::inline stages {
namespace {

struct AccuracySlice : RunTable {
  int requests = 0;
};
template <class Fields>
void describe(Fields& f, AccuracySlice& s) {
  describe_run(f, s);
  f.number("requests", s.requests, Range{1, 1e7}, "lines asked for");
}

// All inputs but layer 1 are contenders.
void run(StageRun& stage) {
  const auto s = stage.settings_as<AccuracySlice>();
  StackOnBody below = read_stack(stage, "below");
  const PointLayer& points = below.stack.points();
  Workers workers(stage.threads());
  Hdf5Writer file(stage.output());
  stage.write_settings(file);
  for (const std::string& input : stage.inputs()) {
    if (input == "below1") continue;
    const StoredLayer contender = read_layer(stage, input, below);
    const Frame& frame = contender.model->frame();
    const LineRequests requests =
        draw_line_requests(s.requests, points, frame.longest_line, Rng(seed_of(stage, s)));
    if (contender.kind == "lines_from_start") {
      const ReferenceErrors errors =
          squared_reference_errors(requests, points, frame, contender.elites, workers);
      file.write("reference_endpoint/squared_error", errors.endpoint);
      file.write("reference_displacement/squared_error", errors.displacement);
    } else {
      const auto lines = contender.model->finished(contender.elites);
      file.write(input + "/squared_error", squared_line_errors(requests, points, frame, *lines));
    }
  }
  file.close();
}

}  // namespace
}  // namespace hbr::inline stages

int main(int argc, char** argv) { return hbr::stage_main(argc, argv, "Accuracy of the lines", hbr::run); }
