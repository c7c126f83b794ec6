// publish PAGE OUT REPORT: the page that the report stage left, with times, hosts and versions from the
// manifests of OUT, as the folder REPORT. No stage: what it writes depends on when and where.
#include "pipeline/artifact/program.h"
#include "pipeline/core/check.h"
#include "reports/page/provenance.h"

int main(int argc, char** argv) {
  return hbr::guarded_main("publish", [&] {
    if (argc != 4) throw hbr::InputError("expected three folders: publish PAGE OUT REPORT");
    hbr::publish_report(argv[1], argv[2], argv[3]);
    return 0;
  });
}
