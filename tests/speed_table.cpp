// speed_table ROWS KEEP RESULT...: prints the table of the benchmarks' results; KEEP is the file that keeps
// it, or
// "", where only some of the benchmarks were run.
#include <fmt/format.h>

#include "pipeline/artifact/content.h"
#include "pipeline/artifact/program.h"
#include "pipeline/core/check.h"
#include "reports/kept/speed.h"

int main(int argc, char** argv) {
  return hbr::guarded_main("speed_table", [&] {
    if (argc < 4) throw hbr::InputError("expected ROWS KEEP RESULT...");
    const std::string keep = argv[2];
    const nlohmann::json speed = hbr::condense_speed(argv[1], {argv + 3, argv + argc}, !keep.empty());
    if (!keep.empty()) hbr::write_file(keep, speed.dump(1) + "\n");
    fmt::print("{}", hbr::speed_markdown(speed));
    return 0;
  });
}
