// What made the artifacts, and how long it took, from the manifests beside them. Times, hosts and versions
// are no part of an artifact, so the report's stage leaves a page without them; publishing copies that page
// and fills them in.
#pragma once

#include <filesystem>
#include <string>

namespace hbr::inline reports {

// HTML: versions, compilers, hosts; time, processor time and memory of each stage and of each variation; the
// graph of the stages (by dot).
std::string provenance_html(const std::filesystem::path& out);

// Copies the folder `page` (an artifact of the report stage) to `report`, with the provenance of `out` in
// index.html in place of the mark "<!-- provenance -->". What stood at `report` is replaced when the copy is
// complete, and left alone where it would be the same; also where only the provenance would be another and
// nothing can be written there, which a line on stderr says. Throws InputError where there is no page, the
// mark is missing, or a manifest of what the page was made from is not as a run left it.
void publish_report(const std::filesystem::path& page, const std::filesystem::path& out,
                    const std::filesystem::path& report);

}  // namespace hbr::inline reports
