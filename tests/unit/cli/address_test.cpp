#include "services/cli/address.hpp"

#include <gtest/gtest.h>

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

TEST(Address, PathsAndQueriesKeepTheirShapeForAnyNames) {
    EXPECT_EQ(path_of({"runs", "a b/../c"}), "/v1/runs/a%20b%2F..%2Fc");
    EXPECT_EQ(query_of({{"phase", "mpm_solver"}, {"fields", ""}, {"transfer_time", "1+1&x"}}),
              "?phase=mpm_solver&transfer_time=1%2B1%26x");
    EXPECT_EQ(query_of({{"fields", ""}}), "");
}

}  // namespace breach::cli
