// The server's address, and URLs of its paths.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace breach::cli {

struct Address {
    std::string origin;  ///< "http://127.0.0.1:8470"
    std::string prefix;  ///< "" or "/breachline": a proxy may put the server below a path
};

/// Nothing when the text is no http or https address.
std::optional<Address> address_from(const std::string& url);

/// "a b/c" -> "a%20b%2Fc" (RFC 3986)
std::string percent_encoded(std::string_view text);

/// {"runs", "a b"} -> "/v1/runs/a%20b"
std::string path_of(std::initializer_list<std::string_view> parts);

/// {{"after", "3"}} -> "?after=3"; pairs with an empty value are left out.
std::string query_of(std::initializer_list<std::pair<std::string_view, std::string>> pairs);

}  // namespace breach::cli
