#include "core/base/printable.h"

#include "tests/support/catch.hpp"

using namespace pl;

TEST_CASE("Text of any language stays as it is") {
    for (const char* text : {"", "a b\n\tc", "\xC3\xA9\xC2\xA0", "\xE2\x82\xAC \xED\x9F\xBF \xEE\x80\x80",
                             "\xF0\x9F\x98\x80\xF4\x8F\xBF\xBF"})
        CHECK(printable(text) == text);
}

TEST_CASE("What a terminal would obey is replaced") {
    const std::string r = "\xEF\xBF\xBD";
    CHECK(printable("\x1b]0;OWNED\x07\x1b[31mred") == r + "]0;OWNED" + r + r + "[31mred");
    CHECK(printable("a\rb\x7f") == "a" + r + "b" + r);
    CHECK(printable(std::string_view("\0", 1)) == r);
    // The control sequence introducer beyond ASCII, and as a byte alone.
    CHECK(printable("\xC2\x9B"
                    "31m") == r + "31m");
    CHECK(printable("\x9B"
                    "31m") == r + "31m");
}

TEST_CASE("Bytes that are no UTF-8 are replaced one by one") {
    const std::string r = "\xEF\xBF\xBD";
    CHECK(printable("\xC0\x9B") == r + r);          // too long a form
    CHECK(printable("\xE0\x82\x9B") == r + r + r);  // the same
    CHECK(printable("\xED\xA0\x80") == r + r + r);  // half of a pair of UTF-16
    CHECK(printable("\xF4\x90\x80\x80") == r + r + r + r);
    CHECK(printable("\xF0\x8F\x80\x80") == r + r + r + r);
    CHECK(printable("\xFF") == r);
    CHECK(printable("\xC3") == r);
    CHECK(printable("\xC3(") == r + "(");
    CHECK(printable("\xE2\x82") == r + r);
}

TEST_CASE("Names are fields of CSV, text of pages and of LaTeX") {
    CHECK(csv_text("door") == "door");
    CHECK(csv_text("a,b") == "\"a,b\"");
    CHECK(csv_text("say \"a\"") == "\"say \"\"a\"\"\"");
    CHECK(csv_text("=1+1") == "'=1+1");  // no formula
    CHECK(markup_text("<a href='x'>\"&\"") == "&lt;a href=&#39;x&#39;&gt;&quot;&amp;&quot;");
    CHECK(markup_text("").empty());
    CHECK(latex_text("a_b & 5 % \\x") == "a\\_b \\& 5 \\% \\textbackslash{}x");
}
