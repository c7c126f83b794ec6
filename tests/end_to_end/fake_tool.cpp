// The tool behind the Makefile, with the fake experiment in place of the real one.
#include "pipeline/artifact/profile.h"
#include "pipeline/artifact/tool.h"
#include "tests/end_to_end/fake_experiment.h"

int main(int argc, char** argv) {
  return hbr::tool_main(argc, argv, [](const std::filesystem::path& profile) {
    return hbr::fake_graph(hbr::read_profile<hbr::FakeProfile>(profile));
  });
}
