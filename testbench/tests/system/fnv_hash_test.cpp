// The same hashes everywhere: values of the authors of FNV.
#include "testbench/system/fnv_hash.h"

#include <gtest/gtest.h>

namespace phongpipe {
namespace {

std::uint64_t hash_of(std::string_view text) {
  FnvHash hash;
  hash.add(text);
  return hash.value();
}

TEST(FnvHash, PublishedValues) {
  EXPECT_EQ(hash_of(""), 0xcbf29ce484222325U);
  EXPECT_EQ(hash_of("a"), 0xaf63dc4c8601ec8cU);
  EXPECT_EQ(hash_of("foobar"), 0x85944171f73967e8U);
  EXPECT_EQ(hash_of("\xff"), (0xcbf29ce484222325U ^ 0xffU) * 0x100000001b3U);  // bytes have no sign
}

}  // namespace
}  // namespace phongpipe
