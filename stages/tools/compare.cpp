// compare A B FOLDER: in what two runs differ, as FOLDER/index.html. No stage: it makes no artifact.
#include <fmt/format.h>

#include "pipeline/artifact/content.h"
#include "pipeline/artifact/program.h"
#include "pipeline/core/check.h"
#include "reports/compare/compare_page.h"

int main(int argc, char** argv) {
  return hbr::guarded_main("compare", [&] {
    if (argc != 4) throw hbr::InputError("expected three folders: compare A B FOLDER");
    for (int k : {1, 2})
      if (*argv[k] == '\0')
        throw hbr::InputError("{0} is empty; expected the folder of a run, as in {0}=out/reduced",
                              k == 1 ? "A" : "B");
    const std::string page = compare_page(hbr::read_compared_run(argv[1]), hbr::read_compared_run(argv[2]));
    const std::filesystem::path folder = argv[3];
    std::filesystem::create_directories(folder);
    hbr::write_whole(folder / "index.html", page);
    fmt::print("{}\n", (folder / "index.html").string());
    return 0;
  });
}
