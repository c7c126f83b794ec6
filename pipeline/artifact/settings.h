// Settings: a struct whose fields are described once, and from that description read strictly from a profile
// (TOML), written as canonical JSON (a stage's slice) and read back from it.
//
//   struct SearchSettings {
//     int generations = 0;
//     double spacing = 0;
//     std::string selector;
//   };
//   template <class Fields>
//   void describe(Fields& f, SearchSettings& s) {
//     f.number("generations", s.generations, Range{1, 1e9}, "generations of the search");
//     f.number("spacing", s.spacing, Range{1e-6, 1}, "l: least distance between elites, in descriptor
//     units"); f.choice("selector", s.selector, {"curiosity", "uniform"}, "how parents are drawn");
//   }
//
// Other kinds of field: f.flag(key, bool&, meaning), f.text(key, std::string&, meaning),
// f.numbers(key, std::vector<double>&, Range, meaning), f.texts(key, std::vector<std::string>&, meaning),
// f.table(key, Struct&, meaning) and f.tables(key, std::vector<Struct>&, meaning) for nested structs.
// number() takes int, std::int64_t, std::uint64_t or double members; an integer member refuses a fraction.
// Every key of a description is required and no other is allowed, so a profile says all there is to know.
#pragma once

namespace hbr {

struct Range {
  double low;   // inclusive
  double high;  // inclusive
};

}  // namespace hbr
