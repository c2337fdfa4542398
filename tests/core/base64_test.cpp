#include "core/base64.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace pstrips {
namespace {

struct Pair {
  std::string_view bytes, digits;
};
const Pair kPairs[] = {{"", ""},
                       {"f", "Zg=="},
                       {"fo", "Zm8="},
                       {"foo", "Zm9v"},
                       {"foob", "Zm9vYg=="},
                       {"fooba", "Zm9vYmE="},
                       {"foobar", "Zm9vYmFy"},
                       {"\xff\xff\xff", "////"},
                       {"\xfb\xef\xbe", "++++"}};

std::string parsed(std::string_view digits, Base64 form) {
  const auto bytes = parse_base64(digits, form);
  return bytes ? std::string(as_text(*bytes)) : "nothing";
}

TEST(Base64Text, IsThatOfTheStandard) {
  for (const auto& [bytes, digits] : kPairs) {
    EXPECT_EQ(base64(as_bytes(bytes)), digits);
    EXPECT_EQ(parsed(digits, Base64::strict), bytes);
    EXPECT_EQ(parsed(digits, Base64::lenient), bytes);
    const std::string_view bare = digits.substr(0, digits.find('='));
    EXPECT_EQ(parsed(bare, Base64::lenient), bytes);
    if (bare != digits) {
      EXPECT_EQ(parsed(bare, Base64::strict), "nothing");
    }
  }
}

TEST(Base64Text, ComesBack) {
  EXPECT_TRUE(rc::check([](const std::vector<std::uint8_t>& numbers) {
    const auto bytes = std::as_bytes(std::span(numbers));
    for (const Base64 form : {Base64::strict, Base64::lenient}) {
      const auto back = parse_base64(base64(bytes), form);
      RC_ASSERT(back && std::ranges::equal(*back, bytes));
    }
  }));
}

TEST(Base64Text, IsRefusedWhereItIsNone) {
  for (const std::string_view digits :
       {"Z", "Zm9vY", "Z===", "====", "=", "Zm=9", "Zm9v=", "Zg==Zg==", "Zm 9", "Zm9\n", "Z-9v"})
    EXPECT_EQ(parsed(digits, Base64::strict), "nothing") << digits;
  for (const std::string_view digits : {"Z", "Zm9vY", "Z===", "Zm=9", "Zg==Zg==", "Zm 9", "Z-9v"})
    EXPECT_EQ(parsed(digits, Base64::lenient), "nothing") << digits;
}

TEST(Base64Text, HasOneWayToWriteAValue) {
  EXPECT_EQ(parsed("Zh==", Base64::strict), "nothing");
  EXPECT_EQ(parsed("Zm9=", Base64::strict), "nothing");
  EXPECT_EQ(parsed("Zh==", Base64::lenient), "f");
  EXPECT_EQ(parsed("Zm9", Base64::lenient), "fo");
}

}  // namespace
}  // namespace pstrips
