#include "reports/page/provenance.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <map>
#include <set>
#include <system_error>
#include <vector>

#include "pipeline/artifact/content.h"
#include "pipeline/artifact/families.h"
#include "pipeline/artifact/progress.h"
#include "pipeline/artifact/temporary.h"
#include "pipeline/core/check.h"
#include "pipeline/core/file_error.h"
#include "reports/kept/costs.h"
#include "reports/kept/lineage.h"
#include "reports/kept/scaling.h"
#include "reports/plot/colour.h"
#include "reports/plot/external.h"
#include "reports/plot/figure.h"
#include "reports/plot/svg.h"
#include "reports/text/format.h"
#include "reports/text/html.h"

namespace hbr::inline reports {
namespace {

namespace fs = std::filesystem;
constexpr const char* kMark = "<!-- provenance -->";
constexpr int kTries = 10;  // to put a report where others do so, too

// "version", "compiler", ... -> what occurs
std::map<std::string, std::set<std::string>> words_of(const std::map<std::string, Manifest>& manifests) {
  std::map<std::string, std::set<std::string>> words;
  for (const auto& [output, manifest] : manifests)
    for (const char* word : {"version", "compiler", "architecture", "host"})
      words[word].insert(manifest.run.value(word, "unknown"));
  return words;
}

// Without the variations', which are the same again.
std::string graph_html(const std::map<std::string, Manifest>& manifests,
                       const std::map<std::string, StageCost>& costs) {
  std::map<std::string, std::set<std::string>> needs;  // of stages
  for (const auto& [output, manifest] : manifests) {
    if (!manifest.slice.variation.empty()) continue;
    std::set<std::string>& needed = needs[manifest.slice.stage];
    for (const auto& [name, input] : manifest.slice.inputs)
      if (const Slice& need = manifests.at(input).slice; need.variation.empty()) needed.insert(need.stage);
  }
  std::vector<StageBox> stages;
  for (const auto& [stage, needed] : needs) stages.push_back({stage, "", costs.at(stage).artifacts, needed});
  Drawing drawing =
      parse_svg(run_program({"dot", "-Tsvg"},
                            stages_as_dot(stages, {hex(Colour::grey), hex(Colour::ink), "transparent"})),
                "stages");
  drawing.shows = fmt::format(
      "The {} stages of the run, those that do the same in one box; arrows lead from what a "
      "stage hands on to what uses it.",
      stages.size());
  return "<div class=\"scroll graph\">" + inline_svg(drawing, "stages-graph", "The graph of stages") +
         "</div>\n";
}

// What more processors would make of it.
std::string scaling_html(const std::map<std::string, Manifest>& manifests) {
  const std::vector<Job> jobs = jobs_of(manifests);
  const double alone = makespan(jobs, 1);
  std::vector<std::vector<std::string>> rows;
  for (const int processors : {1, 2, 4, 8, 16, 64}) {
    const double seconds = makespan(jobs, processors);
    rows.push_back({fmt::format("{}", processors), duration_text(seconds),
                    fmt::format("{:.0f} %", seconds > 0 ? 100 * alone / (processors * seconds) : 100)});
  }
  double longest = 0;
  std::string chain;
  for (const std::size_t job : critical_path(jobs)) {
    longest += jobs[job].seconds;
    chain += (chain.empty() ? "<code>" : ", <code>") + escape_html(jobs[job].stage) + "</code>";
  }
  return html_table(
             "This run on more processors, by a model: each takes the next stage that can begin, and works "
             "on it alone for as long as that stage’s processor time",
             {"Processors", "Time", "At work"}, rows) +
         fmt::format(
             "<p>No number of processors is faster than {}, the longest chain of stages that wait for each "
             "other: {}.</p>\n",
             duration_text(longest), chain);
}

// What of this page stands at `report`.
enum class Published { nothing, with_other_provenance, all };
Published published(const fs::path& page, const std::string& before, const std::string& provenance,
                    const std::string& after, const fs::path& report) {
  try {
    if (!fs::is_directory(report)) return Published::nothing;
    std::map<std::string, std::string> files = content_of(page).files, there = content_of(report).files;
    const std::string html = read_whole(report / "index.html");
    files.erase("index.html");
    there.erase("index.html");
    if (files != there || !html.starts_with(before) || !html.ends_with(after)) return Published::nothing;
    return html == before + provenance + after ? Published::all : Published::with_other_provenance;
  } catch (const InputError&) {
    return Published::nothing;  // writing it anew mends it, or says what is wrong
  }
}

// Why nothing can be put into the folder; "" where that can be tried.
std::string can_not_write(const fs::path& folder) {
  const int refused = ::faccessat(AT_FDCWD, folder.empty() ? "." : folder.c_str(), W_OK, AT_EACCESS);
  return refused == 0 ? "" : std::generic_category().message(errno);
}

}  // namespace

std::string provenance_html(const fs::path& out) {
  const std::map<std::string, Manifest> manifests = lineage(out, "page");
  const std::map<std::string, StageCost> costs = stage_costs(manifests);
  std::string html = "<dl>\n";
  std::vector<std::vector<std::string>> rows;
  for (const auto& [word, texts] : words_of(manifests)) {
    std::string all;
    for (const std::string& text : texts) all += (all.empty() ? "" : ", ") + escape_html(text);
    html += fmt::format("<dt>{}</dt><dd><code>{}</code></dd>\n", word, all);
  }
  double longest = 1e-9;
  for (const auto& [name, stage] : costs) longest = std::max(longest, stage.seconds);
  for (const auto& [name, stage] : costs)
    rows.push_back({fmt::format("<code>{}</code>", escape_html(name)), fmt::format("{}", stage.artifacts),
                    fmt::format("{} <span class=\"bar\" style=\"width:{:.1f}rem\"></span>",
                                duration_text(stage.seconds), 8 * stage.seconds / longest),
                    duration_text(stage.cpu_seconds), format_number(std::round(stage.memory / 1e6)) + " MB",
                    format_number(stage.disk / 1e6) + " MB"});
  const StageCost whole = whole_cost(costs);
  return html +
         fmt::format("<dt>time</dt><dd>{} of all stages one after the other, {} of processors</dd></dl>\n",
                     duration_text(whole.seconds), duration_text(whole.cpu_seconds)) +
         html_table("Time, memory and disk of each stage, over its artifacts",
                    {"Stage", "Artifacts", "Time", "Processor time", "Most memory", "On disk"}, rows) +
         scaling_html(manifests) + graph_html(manifests, costs);
}

void publish_report(const fs::path& page, const fs::path& out, const fs::path& report) {
  const std::string html = read_whole(page / "index.html");
  const std::size_t mark = html.find(kMark);
  if (mark == std::string::npos)
    throw InputError("{} has no place for the provenance; was it made by the report stage?",
                     (page / "index.html").string());
  const std::string before = html.substr(0, mark), after = html.substr(mark + std::string(kMark).size()),
                    provenance = provenance_html(out);
  const Published there = published(page, before, provenance, after, report);
  if (there == Published::all) return;  // which a folder that can only be read would refuse
  if (const std::string why = can_not_write(report.parent_path());
      there == Published::with_other_provenance && !why.empty()) {
    fmt::print(
        stderr,
        "{} stays as it is: its folder can't be written ({}), and only what it tells of its making would "
        "be told otherwise, as where another Graphviz draws the stages\n",
        report.string(), why);
    return;
  }

  // Under names of this process's own: another make may publish at the same time, and then the later one
  // stands.
  const Temporary copy(temporary_beside(report, "new")), old(temporary_beside(report, "old"));
  fs::copy(page, copy.path, fs::copy_options::recursive);
  write_file(copy.path / "index.html", before + provenance + after);
  std::error_code taken;
  for (int tries = 0; tries < kTries; ++tries) {
    if (fs::exists(report)) fs::rename(report, old.path, taken);
    fs::rename(copy.path, report, taken);
    if (!taken) return;
    fs::remove_all(old.path);
  }
  throw file_error(report, "can't put the report there", taken.value());
}

}  // namespace hbr::inline reports
