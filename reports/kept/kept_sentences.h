// Sentences of the READMEs whose figures are kept runs': placed by machine, so that prose quotes what is
// kept.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "reports/kept/kept_run.h"

namespace hbr::inline reports {

// A blank stands for any white space, so that the file may break its lines anywhere. A place is {{RUN PLACE}}
// or, of a run's variation, {{RUN/VARIATION PLACE}}, words before and behind it. PLACE is as in
// reports/kept/kept_figures.h, or claim:ID:N:FIELD: of the claim's check N, from 1, by its rules as they are
// now, the figure, p (adjusted as it is where it decides), a12, or would_tell, how many replications might.
struct KeptSentence {
  std::string file;  // a path below the repository
  std::string text;  // a sentence or a part of one, as it stands in the file but for its places
};

// `text`, of that file, with the figures of the file's sentences in the places of those that stood there;
// `rules` is reports/claims.toml. Throws InputError where a sentence does not stand there just once, or a run
// is not kept or has not measured what a place asks for.
std::string with_sentences(std::string text, const std::string& file,
                           const std::vector<KeptSentence>& sentences,
                           const std::map<std::string, KeptRun>& kept, const std::filesystem::path& rules);

}  // namespace hbr::inline reports
