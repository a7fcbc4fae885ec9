#include "services/cli/address.hpp"

#include <gtest/gtest.h>

#include "core/words/loopback.hpp"

namespace breach::cli {

TEST(Address, IsOriginAndPrefix) {
    const auto plain = address_from("http://127.0.0.1:8470");
    ASSERT_TRUE(plain);
    EXPECT_EQ(plain->origin, "http://127.0.0.1:8470");
    EXPECT_EQ(plain->prefix, "");
    const auto behind_a_proxy = address_from("https://[::1]:443/breach//");
    ASSERT_TRUE(behind_a_proxy);
    EXPECT_EQ(behind_a_proxy->origin, "https://[::1]:443");
    EXPECT_EQ(behind_a_proxy->prefix, "/breach");
}

TEST(Address, RefusesWhatIsNoHttpAddress) {
    for (const char* wrong : {"", "localhost:8470", "ftp://host", "http://", "http://host:port",
                              "http://user@host", "http://host/?a=b", "http://ho st"})
        EXPECT_FALSE(address_from(wrong)) << wrong;
}

TEST(Address, IsOfThisMachineOnlyAsAWholeLoopbackAddress) {
    for (const char* own :
         {"localhost", "localhost.", "LocalHost:8470", "127.0.0.1", "127.0.0.1.", "127.255.3.4:80",
          "[::1]", "[::1]:65535", "[0:0:0:0:0:0:0:1]", "[::ffff:127.0.0.1]", "[::FFFF:7f00:1]:1"})
        EXPECT_TRUE(words::is_loopback_authority(own)) << own;
    for (const char* other : {"",
                              ":8470",
                              "127.attacker.example",
                              "localhost.attacker.example",
                              "127.1",
                              "127.0.0",
                              "127.0.0.1.2",
                              "127.0.0.1.attacker.example:8470",
                              "127.0.0.256",
                              "127.0.0.01",
                              "0x7f.0.0.1",
                              "2130706433",
                              "128.0.0.1",
                              "0.0.0.0",
                              "localhost..",
                              "localhosts",
                              "::1",
                              "[::1",
                              "[::1]x",
                              "[::2]",
                              "[::]",
                              "[127.0.0.1]",
                              "[localhost]",
                              "[::ffff:128.0.0.1]",
                              "[::1%lo]",
                              "localhost:",
                              "localhost:80x",
                              "localhost:80:80",
                              "user@localhost",
                              "localhost:80@evil.example",
                              "localhost:123456",
                              " localhost",
                              "localhost/",
                              "[::1]:80]"})
        EXPECT_FALSE(words::is_loopback_authority(other)) << other;
    EXPECT_FALSE(words::is_loopback(std::string_view("127.0.0.1\0.evil.example", 23)));
}

TEST(Address, PathsAndQueriesKeepTheirShapeForAnyNames) {
    EXPECT_EQ(path_of({"runs", "a b/../c"}), "/v1/runs/a%20b%2F..%2Fc");
    EXPECT_EQ(query_of({{"phase", "mpm_solver"}, {"fields", ""}, {"transfer_time", "1+1&x"}}),
              "?phase=mpm_solver&transfer_time=1%2B1%26x");
    EXPECT_EQ(query_of({{"fields", ""}}), "");
}

}  // namespace breach::cli
