// Builds paths for the server. Ids and names come from users and may hold any character, so each
// part is encoded; a name with a slash must not become another route.
#include "services/cli/address.hpp"

#include <cctype>
#include <regex>

namespace breach::cli {

/// Byte by byte, so that UTF-8 needs no care. isalnum() depends on the locale; this program never
/// sets one, so only ASCII letters and digits pass.
std::string percent_encoded(std::string_view text) {
    constexpr std::string_view digits = "0123456789ABCDEF";
    std::string encoded;
    for (const char each : text) {
        const auto byte = static_cast<unsigned char>(each);
        if (std::isalnum(byte) != 0 || each == '-' || each == '.' || each == '_' || each == '~') {
            encoded += each;
        } else {
            encoded += '%';
            encoded += digits[byte >> 4];
            encoded += digits[byte & 15];
        }
    }
    return encoded;
}

std::optional<Address> address_from(const std::string& url) {
    // No user name, query or fragment: a token comes from a file, and paths are added here. An IPv6
    // address stands in brackets, as its colons would look like a port.
    static const std::regex shape(
        R"((https?://(?:[A-Za-z0-9._-]+|\[[0-9A-Fa-f:.]+\])(?::[0-9]{1,5})?)(/[^?#\s]*)?)");
    std::smatch match;
    if (!std::regex_match(url, match, shape)) return std::nullopt;
    Address address{match[1], match[2]};
    // A service may be behind a proxy below a path; the prefix goes before /v1.
    while (address.prefix.ends_with('/')) address.prefix.pop_back();
    return address;
}

std::string path_of(std::initializer_list<std::string_view> parts) {
    std::string path = "/v1";
    for (const std::string_view part : parts) path.append("/").append(percent_encoded(part));
    return path;
}

/// In all option structs an empty text means "not given", so that callers need no conditions.
std::string query_of(std::initializer_list<std::pair<std::string_view, std::string>> pairs) {
    std::string query;
    for (const auto& [name, value] : pairs) {
        if (value.empty()) continue;
        query += query.empty() ? '?' : '&';
        query.append(name).append("=").append(percent_encoded(value));
    }
    return query;
}

}  // namespace breach::cli
