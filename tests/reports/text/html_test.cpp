#include "reports/text/html.h"

#include <gtest/gtest.h>

namespace hbr {
namespace {

TEST(Html, EscapesWhatMarkupIsMadeOf) {
  EXPECT_EQ(escape_html("a < b & \"c\" > 'd' é"), "a &lt; b &amp; &quot;c&quot; &gt; &#39;d&#39; é");
}

TEST(Html, AddressesHoldNothingThatMeansMoreThere) {
  EXPECT_EQ(escape_url("a/B-1_2.~png"), "a/B-1_2.~png");
  EXPECT_EQ(escape_url("arm#2 50%?\"é:.png"), "arm%232%2050%25%3F%22%C3%A9%3A.png");
}

// The vectors of RFC 4648.
TEST(Html, EncodesBase64) {
  const std::pair<const char*, const char*> cases[] = {{"", ""},
                                                       {"f", "Zg=="},
                                                       {"fo", "Zm8="},
                                                       {"foo", "Zm9v"},
                                                       {"foob", "Zm9vYg=="},
                                                       {"fooba", "Zm9vYmE="},
                                                       {"foobar", "Zm9vYmFy"}};
  for (const auto& [bytes, text] : cases)
    EXPECT_EQ(data_uri(bytes, "image/png"), std::string("data:image/png;base64,") + text);
  EXPECT_EQ(data_uri("\xff\xfe\xfd", "a/b"), "data:a/b;base64,//79");
}

TEST(Html, TablesNameTheirRowsAndColumns) {
  EXPECT_EQ(html_table("what", {"a", "b"}, {{"1", "2"}}, "wide"),
            "<div class=\"scroll\"><table class=\"wide\"><caption>what</caption>\n<thead><tr><th "
            "scope=\"col\">a</th><th scope=\"col\">b</th></tr></thead>\n<tbody>\n<tr><th "
            "scope=\"row\">1</th><td>2</td></tr>\n</tbody></table></div>\n");
}

}  // namespace
}  // namespace hbr
