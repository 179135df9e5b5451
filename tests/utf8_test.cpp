#include <gtest/gtest.h>

#include "core/scene/scene.h"

namespace boxwood {
namespace {

TEST(Utf8, KeepsWhatIsValidAndReplacesEachOtherByte) {
    const std::string bad = "\xef\xbf\xbd";
    EXPECT_EQ(to_utf8("na\xc3\xafve \xe2\x82\xac \xf0\x9f\x98\x80"),
              "na\xc3\xafve \xe2\x82\xac \xf0\x9f\x98\x80");
    EXPECT_EQ(to_utf8("caf\xe9!"), "caf" + bad + "!");
    EXPECT_EQ(to_utf8("\xc0\xaf"), bad + bad);                      // overlong
    EXPECT_EQ(to_utf8("\xed\xa0\x80"), bad + bad + bad);            // surrogate
    EXPECT_EQ(to_utf8("\xf4\x90\x80\x80"), bad + bad + bad + bad);  // above U+10FFFF
    EXPECT_EQ(to_utf8("a\xe2\x82"), "a" + bad + bad);               // cut short
}

}  // namespace
}  // namespace boxwood
